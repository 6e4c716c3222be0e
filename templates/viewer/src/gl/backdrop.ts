// SPDX-License-Identifier: Apache-2.0
// Sky and ground, with the clouds laid over them in the same pass.
import {AIR_GLSL} from '../air';
import {displayColor} from '../color';
import type {Camera} from '../camera';
import {axesOf} from '../camera';
import {along, clamp, scale, smoothStep, type Vec3} from '../math';
import type {Daylight} from '../pack/daylight';
import {SHADOW_CELLS, type Area} from '../pack/ground_shadow';
import {SKY_COLUMNS, SKY_GLSL, SKY_ROWS, SkyTable} from '../pack/sky_table';
import {byteTexture, Mesh, Program, Target, type GL} from './gl';

/** Of the painted ground, across. */
const PAINTED_PIXELS = 1536;
/** What a quarter moon adds to the ground at night, to an eye that is used to it. */
const MOONLIT_GROUND: Vec3 = [0.005, 0.007, 0.0105];
/** How far the ground reaches. */
const GROUND_METERS = 2_500_000;

/** With clouds laid over it, on flat ground or among mountains; or without. */
type Kind = 'flat' | 'hilly' | 'bare';

/**
 * `behindClouds(color, depth)`: a colour with the clouds over it. The cloud picture may be coarser than the screen: near the edges of
 * mountains the texels count most whose ground is as far away as the pixel's own.
 */
const CLOUDS_GLSL = (kind: Kind) => (kind === 'bare' ? BARE_GLSL : `
uniform sampler2D u_clouds;
uniform vec2 u_screen;
${kind === 'hilly' ? 'uniform sampler2D u_cloudDepth;\nuniform float u_near;' : ''}
vec4 cloudsHere(float depth) {
  vec2 at = gl_FragCoord.xy / u_screen;
  ${
    kind === 'hilly'
      ? `vec2 size = vec2(textureSize(u_clouds, 0));
  vec2 texel = at * size - 0.5;
  ivec2 low = ivec2(floor(texel));
  vec2 f = fract(texel);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      ivec2 p = clamp(low + ivec2(i, j), ivec2(0), ivec2(size) - 1);
      float nearness = 1.0 - texelFetch(u_cloudDepth, p, 0).r;
      float own = u_near / depth;
      float weight = (i == 0 ? 1.0 - f.x : f.x) * (j == 0 ? 1.0 - f.y : f.y) / (0.02 + abs(nearness - own) / max(own, 1e-7)) + 1e-6;
      sum += weight * texelFetch(u_clouds, p, 0);
      weights += weight;
    }
  return sum / weights;`
      : 'return texture(u_clouds, at);'
  }
}
vec3 behindClouds(vec3 color, float depth) {
  vec4 clouds = cloudsHere(depth);
  return color * (1.0 - clouds.a) + clouds.rgb;
}
`);

/** Where clouds are drawn over it afterwards. */
const BARE_GLSL = `
vec4 cloudsHere(float depth) { return vec4(0.0); }
vec3 behindClouds(vec3 color, float depth) { return color; }
`;

/** A lattice over the screen from a row upwards: the sky's colours change slowly enough to be known at its points. */
const SKY_VERTEX = `
layout(location = 0) in vec2 lattice;
uniform vec3 u_right, u_up, u_forward, u_sunColor, u_sun;
uniform float u_row;
${SKY_GLSL}
out vec3 v_sky;
void main() {
  // Rows are closer to each other near the horizon, where the sky changes most.
  vec2 corner = vec2(2.0 * lattice.x - 1.0, mix(u_row, 1.0, lattice.y * lattice.y));
  vec3 way = normalize(u_forward + corner.x * u_right + corner.y * u_up);
  vec3 sky = skyAt(way);
  v_sky = sky + (1.0 - sky) * u_sunColor * (0.3 * pow(max(dot(way, u_sun), 0.0), 90.0));
  gl_Position = vec4(corner, 1.0, 1.0);
}`;

const SKY_FRAGMENT = (kind: Kind) => `
in vec3 v_sky;
${CLOUDS_GLSL(kind)}
out vec4 color;
void main() {
  color = vec4(behindClouds(v_sky, 1e7), 1.0);
}`;

/** The sun's half degree is widened to one, as film and eye do by glare. */
const SUN_VERTEX = `
uniform mat4 u_clip;
uniform vec3 u_eye, u_sun;
out vec2 v_corner;
void main() {
  v_corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  vec3 right = normalize(vec3(-u_sun.z, 0.0, u_sun.x) + vec3(1e-5, 0.0, 0.0));
  vec3 up = cross(right, u_sun);
  gl_Position = u_clip * vec4(u_eye + 1e6 * (u_sun + 0.018 * (v_corner.x * right + v_corner.y * up)), 1.0);
}`;

const SUN_FRAGMENT = (kind: Kind) => `
in vec2 v_corner;
${CLOUDS_GLSL(kind)}
out vec4 color;
void main() {
  float disc = smoothstep(1.0, 0.45, length(v_corner)) * (1.0 - cloudsHere(1e7).a);
  color = vec4(disc);
}`;

/** What a place of the ground is: land (or sea), in the sun (or in shadow), inside of the scene's rectangle. */
const PLACE_GLSL = `
uniform sampler2D u_map, u_sunlight;
/** across: in widths and depths of the scene's rectangle. */
vec3 placeAt(vec2 inMap, vec2 across) {
  vec2 inside = step(abs(across - 0.5), vec2(0.5));
  float box = inside.x * inside.y;
  return vec3(texture(u_map, inMap).r, mix(1.0, texture(u_sunlight, across).r, box), box);
}
`;

/** Its colour; what is left in a shadow is light of the blue sky. */
const SHADED_GLSL = `
uniform vec3 u_sea, u_inShadow;
vec3 shaded(vec3 land, vec3 place) {
  return mix(u_sea, land, place.x) * mix(u_inShadow, vec3(1.0), place.y) * (0.88 + 0.12 * place.z);
}
`;

/** What the flat ground is, is painted once from above, into a texture: a frame then costs one look into it, whatever the sun. */
const PAINT_VERTEX = `
out vec2 v_at;
void main() {
  v_at = vec2(float((gl_VertexID & 1) * 2), float(gl_VertexID & 2));
  gl_Position = vec4(2.0 * v_at - 1.0, 0.0, 1.0);
}`;

const PAINT_FRAGMENT = `
in vec2 v_at;
uniform vec4 u_mapArea;
${PLACE_GLSL}
out vec4 color;
void main() {
  color = vec4(placeAt(v_at, u_mapArea.xy + v_at * u_mapArea.zw), 1.0);
}`;

/** A lattice over the screen from a row downwards, thrown on the ground. */
const FLAT_VERTEX = `
layout(location = 0) in vec2 lattice;
uniform mat4 u_clip;
uniform float u_ground, u_depth, u_row;
uniform vec3 u_right, u_up, u_forward;
uniform vec3 u_area;
uniform vec4 u_mapArea;
${AIR_GLSL}
${SKY_GLSL}
out vec4 v_at;
out vec3 v_haze;
void main() {
  vec3 way = u_forward + (2.0 * lattice.x - 1.0) * u_right + mix(u_row, -1.0, lattice.y * lattice.y) * u_up;
  vec3 world = u_eye + (u_eye.y - u_ground) / max(-way.y, 1e-7) * way;
  gl_Position = u_clip * vec4(world, 1.0);
  v_at = vec4(((world.xz - u_area.xy) / vec2(u_area.z, u_depth) - u_mapArea.xy) / u_mapArea.zw, clarity(world), gl_Position.w);
  v_haze = hazeTowards(way);
}`;

const FLAT_FRAGMENT = (kind: Kind) => `
in vec4 v_at;
in vec3 v_haze;
uniform vec3 u_land;
uniform sampler2D u_painted;
${SHADED_GLSL}
${CLOUDS_GLSL(kind)}
out vec4 color;
void main() {
  color = vec4(behindClouds(mix(v_haze, shaded(u_land, texture(u_painted, v_at.xy).rgb), v_at.z), v_at.w), 1.0);
}`;

const RELIEF_VERTEX = `
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 relief;
uniform mat4 u_clip;
uniform float u_ground, u_depth;
uniform vec3 u_area, u_sun, u_soil;
${AIR_GLSL}
${SKY_GLSL}
out vec4 v_at;
out vec3 v_relief, v_haze;
void main() {
  vec3 world = vec3(place.x, (place.y + u_ground) * u_exaggeration, place.z);
  gl_Position = u_clip * vec4(world, 1.0);
  v_at = vec4((world.xz - u_area.xy) / vec2(u_area.z, u_depth), clarity(world), gl_Position.w);
  v_haze = hazeTowards(world - u_eye);
  // As the other formats draw it: lighter with height, shaded by slopes.
  float facing = (u_sun.y - relief.x * u_sun.x - relief.y * u_sun.z) / length(vec3(relief.x, 1.0, relief.y));
  float lit = clamp(facing / max(u_sun.y, 0.15), 0.0, 1.8);
  vec3 linear = u_soil * mix(vec3(1.0), vec3(2.3, 1.6, 1.75), relief.z) * (0.45 + 0.55 * lit);
  v_relief = 1.055 * pow(clamp(linear, 0.0031308, 1.0), vec3(1.0 / 2.4)) - 0.055;
}`;

const RELIEF_FRAGMENT = (kind: Kind) => `
in vec4 v_at;
in vec3 v_relief, v_haze;
uniform vec4 u_mapArea;
${PLACE_GLSL}
${SHADED_GLSL}
${CLOUDS_GLSL(kind)}
out vec4 color;
void main() {
  vec3 place = placeAt((v_at.xy - u_mapArea.xy) / u_mapArea.zw, v_at.xy);
  color = vec4(behindClouds(mix(v_haze, shaded(v_relief, place), v_at.z), v_at.w), 1.0);
}`;

const LINE_VERTEX = `
layout(location = 0) in vec3 place;
uniform mat4 u_clip;
uniform float u_ground, u_stretch;
${AIR_GLSL}
${SKY_GLSL}
out float v_clarity;
out float v_grazing;
out float v_depth;
out vec3 v_haze;
void main() {
  vec3 world = vec3(place.x, (place.y + u_ground) * u_stretch, place.z);
  gl_Position = u_clip * vec4(world, 1.0);
  v_depth = gl_Position.w;
  v_clarity = clarity(world);
  vec3 way = world - u_eye;
  v_haze = hazeTowards(way);
  // Seen at a grazing angle many lines fall on one pixel: they fade before that.
  v_grazing = smoothstep(0.002, 0.03, abs(way.y) / length(way));
}`;

const LINE_FRAGMENT = (kind: Kind) => `
in float v_clarity;
in float v_grazing;
in float v_depth;
in vec3 v_haze;
uniform vec3 u_line;
uniform float u_opacity;
${CLOUDS_GLSL(kind)}
out vec4 color;
void main() {
  float opacity = u_opacity * v_grazing * (1.0 - cloudsHere(v_depth).a);
  color = vec4(mix(v_haze, u_line, v_clarity) * opacity, opacity);
}`;

export interface Lines {
  mesh: Mesh;
  opacity: number;
  color: Vec3;
}

/** Land and sea on a raster over a part of the ground: 255 is land. */
export interface LandMap {
  pixels: Uint8Array;
  width: number;
  height: number;
  /** Where it lies, in widths and depths of the area: left, top, width, height. */
  place: [number, number, number, number];
}

/** What is drawn: from where, and the picture of the clouds that is laid over it, if one is. */
export interface Sight {
  camera: Camera;
  clip: Float32Array;
  near: number;
  exaggeration: number;
  clouds: Target | null;
}

interface Programs {
  sky: Program;
  flat: Program;
  relief: Program | null;
  line: Program;
  disc: Program;
}

export class Backdrop {
  /** What is set by the sun. */
  private soil: Vec3 = [0, 0, 0];
  private land: Vec3 = [0, 0, 0];
  private sea: Vec3 = [0, 0, 0];
  private sunColor: Vec3 = [1, 1, 1];
  private sun: Vec3 = [0, 1, 0];
  private sunwards: [number, number] = [0, 1];
  private skyTable: WebGLTexture | null = null;
  lines: Lines[] = [];
  /** While the view moves, the faintest lines are left out: lines cost as much as triangles. */
  faintest = 0;
  /** A line is a pixel of the canvas wide: fainter where that is more than one of the screen. */
  lineOpacity = 1;
  private lineLight = 1;
  private readonly paint: Program;
  private readonly painted: Target;
  private isPainted = false;
  private readonly programs = new Map<Kind, Programs>();
  private readonly lattice: Mesh;
  private readonly sunlight: WebGLTexture;
  private map: WebGLTexture;
  private mapPlace: [number, number, number, number] = [0, 0, 1, 1];
  private readonly empty: WebGLVertexArrayObject;

  constructor(private readonly gl: GL, private readonly area: Area, private readonly terrain: Mesh | null) {
    this.paint = new Program(gl, PAINT_VERTEX, PAINT_FRAGMENT);
    this.painted = new Target(gl, false);
    this.lattice = lattice(gl);
    this.sunlight = byteTexture(gl, 1, 1, Uint8Array.of(255));
    this.map = byteTexture(gl, 1, 1, Uint8Array.of(255));
    this.empty = gl.createVertexArray();
  }

  setDaylight(daylight: Daylight, sun: Vec3): void {
    const table = new SkyTable(daylight, sun);
    this.sunwards = table.sunwards;
    this.gl.deleteTexture(this.skyTable);
    this.skyTable = byteTexture(this.gl, SKY_COLUMNS, SKY_ROWS, table.colors, 4);
    const night = smoothStep(0.02, -0.16, sun[1]);
    const [r, g, b] = (this.soil = along(daylight.ground, night, MOONLIT_GROUND));
    this.land = displayColor(this.soil);
    this.lineLight = 1 - 0.6 * night;
    this.sea = displayColor([0.32 * r + 0.02 * daylight.zenith[0], 0.5 * g + 0.03 * daylight.zenith[1], 0.75 * b + 0.06 * daylight.zenith[2]]);
    this.sunColor = displayColor(daylight.suns[0]);
    this.sun = sun;
  }

  setSunlight(light: Uint8Array): void {
    this.isPainted = false;
    const {gl} = this;
    gl.bindTexture(gl.TEXTURE_2D, this.sunlight);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, SHADOW_CELLS, SHADOW_CELLS, 0, gl.RED, gl.UNSIGNED_BYTE, light);
  }

  setLand(map: LandMap): void {
    this.isPainted = false;
    const {gl} = this;
    gl.deleteTexture(this.map);
    this.map = byteTexture(gl, map.width, map.height, map.pixels);
    this.mapPlace = map.place;
  }

  /** Only what hides clouds, into the depth of the target that is bound. */
  drawDepth(clip: Float32Array, camera: Camera, exaggeration: number): void {
    if (!this.terrain) return;
    this.gl.colorMask(false, false, false, false);
    this.drawTerrain({clip, camera, exaggeration, near: 1, clouds: null});
    this.gl.colorMask(true, true, true, true);
  }

  /** All of it into what is bound, with the clouds over it where there are any. */
  draw(sight: Sight): void {
    const {gl} = this;
    const {clip, camera} = sight;
    gl.disable(gl.DEPTH_TEST);
    gl.depthMask(false);
    const row = this.horizonRow(camera);
    if (row < 1) {
      const sky = this.begin('sky', sight);
      this.across(sky, camera, Math.max(-1, row - 0.004));
      sky.set('u_sunColor', ...this.sunColor).set('u_sun', ...this.sun);
      this.lattice.draw();
      this.drawSun(sight);
    }
    if (camera.eye[1] > this.area.groundMeters && row > -1) {
      const flat = this.begin('flat', sight);
      this.across(flat, camera, Math.min(1, row));
      this.where(flat, clip);
      this.shade(flat);
      flat.set('u_land', ...this.land).texture('u_painted', 1, this.painted.color!);
      this.lattice.draw();
    }
    if (this.terrain) {
      gl.depthMask(true);
      gl.clear(gl.DEPTH_BUFFER_BIT);
      this.drawTerrain(sight);
    }
    this.drawLines(sight);
  }

  /** The row of the screen, -1 to 1 upwards, in which the ground ends: a little below the horizon. */
  private horizonRow({eye, forward, fieldRadians}: Camera): number {
    const lift = Math.max(0, eye[1] - this.area.groundMeters);
    const below = Math.asin(clamp(forward[1], -1, 1)) + lift / GROUND_METERS + 1e-4;
    if (below <= -0.49 * Math.PI) return 2;
    return below >= 0.49 * Math.PI ? -2 : -Math.tan(below) / Math.tan(0.5 * fieldRadians);
  }

  /** Where the lattice lies. */
  private across(program: Program, camera: Camera, row: number): void {
    const {right, up, forward} = axesOf(camera);
    const half = Math.tan(0.5 * camera.fieldRadians);
    const wide = (half * camera.widthPixels) / camera.heightPixels;
    program
      .set('u_right', right[0] * wide, right[1] * wide, right[2] * wide)
      .set('u_up', up[0] * half, up[1] * half, up[2] * half)
      .set('u_forward', ...forward)
      .set('u_row', row);
  }

  private drawSun(sight: Sight): void {
    if (this.sun[1] < -0.02) return;
    const {gl} = this;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.begin('disc', sight).matrix('u_clip', sight.clip).set('u_sun', ...this.sun);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }

  private drawTerrain(sight: Sight): void {
    const {gl} = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    const relief = this.begin('relief', sight);
    this.where(relief, sight.clip);
    this.shade(relief);
    this.places(relief);
    relief.set('u_sun', ...this.sun).set('u_soil', ...this.soil);
    this.terrain!.draw();
    gl.depthMask(false);
    gl.disable(gl.DEPTH_TEST);
  }

  private drawLines(sight: Sight): void {
    const {gl} = this;
    if (this.terrain) {
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const line = this.begin('line', sight)
      .matrix('u_clip', sight.clip)
      .set('u_ground', this.area.groundMeters)
      .set('u_stretch', this.terrain ? sight.exaggeration : 1);
    for (const {mesh, opacity, color} of this.lines) {
      if (opacity < this.faintest) continue;
      line.set('u_opacity', opacity * this.lineOpacity).set('u_line', ...scale(color, this.lineLight));
      mesh.draw();
    }
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);
  }

  /** A program, with what they all ask for. */
  private begin(name: keyof Programs, {camera, exaggeration, near, clouds}: Sight): Program {
    const kind: Kind = !clouds ? 'bare' : this.terrain ? 'hilly' : 'flat';
    const program = this.programsOf(kind)[name]!
      .use()
      .set('u_eye', ...camera.eye)
      .set('u_exaggeration', exaggeration)
      .set('u_sunwards', ...this.sunwards)
      .texture('u_sky', 5, this.skyTable);
    if (!clouds) return program;
    program.set('u_screen', this.gl.drawingBufferWidth, this.gl.drawingBufferHeight).texture('u_clouds', 0, clouds.color);
    return kind === 'hilly' ? program.set('u_near', near).texture('u_cloudDepth', 4, clouds.depth) : program;
  }

  /** Made when they are first asked for. */
  private programsOf(kind: Kind): Programs {
    const {gl} = this;
    let programs = this.programs.get(kind);
    if (!programs) {
      programs = {
        sky: new Program(gl, SKY_VERTEX, SKY_FRAGMENT(kind)),
        flat: new Program(gl, FLAT_VERTEX, FLAT_FRAGMENT(kind)),
        relief: this.terrain ? new Program(gl, RELIEF_VERTEX, RELIEF_FRAGMENT(kind)) : null,
        line: new Program(gl, LINE_VERTEX, LINE_FRAGMENT(kind)),
        disc: new Program(gl, SUN_VERTEX, SUN_FRAGMENT(kind)),
      };
      this.programs.set(kind, programs);
    }
    return programs;
  }

  private where(program: Program, clip: Float32Array): void {
    const {area} = this;
    program
      .matrix('u_clip', clip)
      .set('u_ground', area.groundMeters)
      .set('u_area', area.lower[0], area.lower[1], area.width)
      .set('u_depth', area.depth)
      .set('u_mapArea', ...this.mapPlace);
  }

  private shade(program: Program): void {
    // A low sun casts long shadows that fade into the light of the sky.
    const share = 0.5 * clamp(this.sun[1] / 0.25, 0, 1);
    program.set('u_sea', ...this.sea).set('u_inShadow', 1 - share, 1 - 0.96 * share, 1 - 0.84 * share);
  }

  private places(program: Program): void {
    program.texture('u_map', 1, this.map).texture('u_sunlight', 2, this.sunlight);
  }

  /** Paints the flat ground; the caller's target is to be bound anew. */
  prepare(): void {
    if (this.isPainted) return;
    const {gl} = this;
    this.painted.resize(PAINTED_PIXELS, PAINTED_PIXELS);
    this.painted.bind();
    this.paint.use().set('u_mapArea', ...this.mapPlace);
    this.places(this.paint);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.bindVertexArray(null);
    this.isPainted = true;
  }
}

/** Points over a square of side 1. */
function lattice(gl: GL): Mesh {
  const [columns, rows] = [12, 10];
  const values: number[] = [];
  const indices: number[] = [];
  for (let j = 0; j <= rows; ++j)
    for (let i = 0; i <= columns; ++i) {
      values.push(i / columns, j / rows);
      if (i === columns || j === rows) continue;
      const at = j * (columns + 1) + i;
      indices.push(at, at + 1, at + columns + 1, at + columns + 1, at + 1, at + columns + 2);
    }
  return new Mesh(gl, values, [2], indices);
}
