// SPDX-License-Identifier: Apache-2.0
// Sky and ground, with the clouds laid over them in the same pass.
import {AIR_GLSL} from '../air';
import {displayColor} from '../color';
import type {Camera} from '../camera';
import {axesOf} from '../camera';
import {clamp, type Vec3} from '../math';
import type {Daylight} from '../pack/daylight';
import {SHADOW_CELLS, type Area} from '../pack/ground_shadow';
import {SKY_COLUMNS, SKY_GLSL, SKY_ROWS, SkyTable} from '../pack/sky_table';
import {byteTexture, Mesh, Program, Target, type GL} from './gl';

/** Of the painted ground, across. */
const PAINTED_PIXELS = 1536;
/** How far the ground reaches. */
const GROUND_METERS = 2_500_000;

/**
 * `behindClouds(color, depth)`: a colour with the clouds over it. The cloud picture may be coarser than the screen: near the edges of
 * mountains the texels count most whose ground is as far away as the pixel's own.
 */
const CLOUDS_GLSL = (terrain: boolean) => `
uniform sampler2D u_clouds;
uniform vec2 u_screen;
${terrain ? 'uniform sampler2D u_cloudDepth;\nuniform float u_near;' : ''}
vec4 cloudsHere(float depth) {
  vec2 at = gl_FragCoord.xy / u_screen;
  ${
    terrain
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
`;

/** A lattice over the screen: the sky's colours change slowly enough to be known at its points. */
const SKY_VERTEX = `
layout(location = 0) in vec2 corner;
uniform vec3 u_right, u_up, u_forward, u_sunColor, u_sun;
${SKY_GLSL}
out vec3 v_sky;
void main() {
  vec3 way = normalize(u_forward + corner.x * u_right + corner.y * u_up);
  vec3 sky = skyAt(way);
  v_sky = sky + (1.0 - sky) * u_sunColor * (0.3 * pow(max(dot(way, u_sun), 0.0), 90.0));
  gl_Position = vec4(corner, 1.0, 1.0);
}`;

const SKY_FRAGMENT = (terrain: boolean) => `
in vec3 v_sky;
${CLOUDS_GLSL(terrain)}
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

const SUN_FRAGMENT = (terrain: boolean) => `
in vec2 v_corner;
${CLOUDS_GLSL(terrain)}
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

/** A disc about the point under the eye, out to the horizon. */
const FLAT_VERTEX = `
layout(location = 0) in vec3 place;
uniform mat4 u_clip;
uniform float u_ground, u_depth;
uniform vec3 u_area;
uniform vec4 u_mapArea;
${AIR_GLSL}
${SKY_GLSL}
out vec4 v_at;
out vec3 v_haze;
void main() {
  vec3 world = vec3(place.x + u_eye.x, u_ground, place.z + u_eye.z);
  gl_Position = u_clip * vec4(world, 1.0);
  v_at = vec4(((world.xz - u_area.xy) / vec2(u_area.z, u_depth) - u_mapArea.xy) / u_mapArea.zw, clarity(world), gl_Position.w);
  v_haze = hazeTowards(world - u_eye);
}`;

const FLAT_FRAGMENT = (terrain: boolean) => `
in vec4 v_at;
in vec3 v_haze;
uniform vec3 u_land;
uniform sampler2D u_painted;
${SHADED_GLSL}
${CLOUDS_GLSL(terrain)}
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

const RELIEF_FRAGMENT = `
in vec4 v_at;
in vec3 v_relief, v_haze;
uniform vec4 u_mapArea;
${PLACE_GLSL}
${SHADED_GLSL}
${CLOUDS_GLSL(true)}
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

const LINE_FRAGMENT = (terrain: boolean) => `
in float v_clarity;
in float v_grazing;
in float v_depth;
in vec3 v_haze;
uniform vec3 u_line;
uniform float u_opacity;
${CLOUDS_GLSL(terrain)}
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
  private readonly sky: Program;
  private readonly paint: Program;
  private readonly painted: Target;
  private isPainted = false;
  private readonly flat: Program;
  private readonly relief: Program | null;
  private readonly line: Program;
  private readonly disc: Program;
  private readonly lattice: Mesh;
  private readonly plain: Mesh;
  private readonly sunlight: WebGLTexture;
  private map: WebGLTexture;
  private mapPlace: [number, number, number, number] = [0, 0, 1, 1];
  private readonly empty: WebGLVertexArrayObject;

  constructor(private readonly gl: GL, private readonly area: Area, private readonly terrain: Mesh | null) {
    const withTerrain = terrain !== null;
    this.sky = new Program(gl, SKY_VERTEX, SKY_FRAGMENT(withTerrain));
    this.paint = new Program(gl, PAINT_VERTEX, PAINT_FRAGMENT);
    this.painted = new Target(gl, false);
    this.flat = new Program(gl, FLAT_VERTEX, FLAT_FRAGMENT(withTerrain));
    this.relief = withTerrain ? new Program(gl, RELIEF_VERTEX, RELIEF_FRAGMENT) : null;
    this.line = new Program(gl, LINE_VERTEX, LINE_FRAGMENT(withTerrain));
    this.disc = new Program(gl, SUN_VERTEX, SUN_FRAGMENT(withTerrain));
    this.lattice = lattice(gl);
    this.plain = plain(gl);
    this.sunlight = byteTexture(gl, 1, 1, Uint8Array.of(255));
    this.map = byteTexture(gl, 1, 1, Uint8Array.of(255));
    this.empty = gl.createVertexArray();
  }

  setDaylight(daylight: Daylight, sun: Vec3): void {
    const table = new SkyTable(daylight, sun);
    this.sunwards = table.sunwards;
    this.gl.deleteTexture(this.skyTable);
    this.skyTable = byteTexture(this.gl, SKY_COLUMNS, SKY_ROWS, table.colors, 4);
    this.soil = daylight.ground;
    this.land = displayColor(daylight.ground);
    const [r, g, b] = daylight.ground;
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
  drawDepth(clip: Float32Array, camera: Camera, exaggeration: number, clouds: Target): void {
    if (!this.relief || !this.terrain) return;
    this.gl.colorMask(false, false, false, false);
    this.drawTerrain(clip, camera, exaggeration, clouds, 1);
    this.gl.colorMask(true, true, true, true);
  }

  /** All of it, with the clouds over it, into what is bound. */
  draw(clip: Float32Array, camera: Camera, exaggeration: number, near: number, clouds: Target): void {
    const {gl} = this;
    const {right, up, forward} = axesOf(camera);
    const half = Math.tan(0.5 * camera.fieldRadians);
    const wide = (half * camera.widthPixels) / camera.heightPixels;
    gl.disable(gl.DEPTH_TEST);
    gl.depthMask(false);
    this.common(this.sky, camera, exaggeration, near, clouds);
    this.sky
      .set('u_right', right[0] * wide, right[1] * wide, right[2] * wide)
      .set('u_up', up[0] * half, up[1] * half, up[2] * half)
      .set('u_forward', ...forward)
      .set('u_sunColor', ...this.sunColor)
      .set('u_sun', ...this.sun);
    // Rows of the ground alone are left to it. The ground ends a little below the horizon.
    const lift = camera.eye[1] - this.area.groundMeters;
    const horizon = forward[1] < 0.999 ? Math.tan(Math.asin(forward[1]) + Math.max(0, lift) / GROUND_METERS + 0.002) / half : -2;
    const firstRow = camera.up[1] < 0.999 || Math.abs(forward[1]) > 0.7 ? 0 : Math.floor(clamp(0.5 - 0.5 * horizon, 0, 1) * gl.drawingBufferHeight);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, firstRow, gl.drawingBufferWidth, gl.drawingBufferHeight - firstRow);
    this.lattice.draw();
    this.drawSun(clip, camera, exaggeration, near, clouds);
    gl.disable(gl.SCISSOR_TEST);
    if (camera.eye[1] > this.area.groundMeters) {
      this.common(this.flat, camera, exaggeration, near, clouds);
      this.where(this.flat, clip);
      this.shade(this.flat);
      this.flat.set('u_land', ...this.land).texture('u_painted', 1, this.painted.color!);
      this.plain.draw();
    }
    if (this.terrain) {
      gl.depthMask(true);
      gl.clear(gl.DEPTH_BUFFER_BIT);
      this.drawTerrain(clip, camera, exaggeration, clouds, near);
    }
    this.drawLines(clip, camera, exaggeration, near, clouds);
  }

  private drawSun(clip: Float32Array, camera: Camera, exaggeration: number, near: number, clouds: Target): void {
    if (this.sun[1] < -0.02) return;
    const {gl} = this;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.common(this.disc, camera, exaggeration, near, clouds);
    this.disc.matrix('u_clip', clip).set('u_sun', ...this.sun);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }

  private drawTerrain(clip: Float32Array, camera: Camera, exaggeration: number, clouds: Target, near: number): void {
    const {gl} = this;
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    this.common(this.relief!, camera, exaggeration, near, clouds);
    this.where(this.relief!, clip);
    this.shade(this.relief!);
    this.places(this.relief!);
    this.relief!.set('u_sun', ...this.sun).set('u_soil', ...this.soil);
    this.terrain!.draw();
    gl.depthMask(false);
    gl.disable(gl.DEPTH_TEST);
  }

  private drawLines(clip: Float32Array, camera: Camera, exaggeration: number, near: number, clouds: Target): void {
    const {gl} = this;
    if (this.terrain) {
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.common(this.line, camera, exaggeration, near, clouds);
    this.line
      .matrix('u_clip', clip)
      .set('u_ground', this.area.groundMeters)
      .set('u_stretch', this.terrain ? exaggeration : 1);
    for (const {mesh, opacity, color} of this.lines) {
      if (opacity < this.faintest) continue;
      this.line.set('u_opacity', opacity).set('u_line', ...color);
      mesh.draw();
    }
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);
  }

  private common(program: Program, camera: Camera, exaggeration: number, near: number, clouds: Target): void {
    program
      .use()
      .set('u_eye', ...camera.eye)
      .set('u_exaggeration', exaggeration)
      .set('u_sunwards', ...this.sunwards)
      .texture('u_sky', 5, this.skyTable)
      .set('u_screen', this.gl.drawingBufferWidth, this.gl.drawingBufferHeight)
      .texture('u_clouds', 0, clouds.color);
    // A picture that is not there yet must not leave the last one bound: it may be the one that is drawn into.
    if (this.terrain) program.set('u_near', near).texture('u_cloudDepth', 4, clouds.depth);
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

/** Points over the whole screen. */
function lattice(gl: GL): Mesh {
  const [columns, rows] = [24, 18];
  const values: number[] = [];
  const indices: number[] = [];
  for (let j = 0; j <= rows; ++j)
    for (let i = 0; i <= columns; ++i) {
      values.push((2 * i) / columns - 1, (2 * j) / rows - 1);
      if (i === columns || j === rows) continue;
      const at = j * (columns + 1) + i;
      indices.push(at, at + 1, at + columns + 1, at + columns + 1, at + 1, at + columns + 2);
    }
  return new Mesh(gl, values, [2], indices);
}

/** Rings about the origin, finer near it: colours that are given at the corners are then right in between. */
function plain(gl: GL): Mesh {
  const [sectors, rings, first] = [28, 18, 60];
  const values = [0, 0, 0];
  const indices: number[] = [];
  for (let r = 0; r < rings; ++r)
    for (let s = 0; s < sectors; ++s) {
      const radius = first * Math.pow(GROUND_METERS / first, r / (rings - 1));
      const angle = (2 * Math.PI * s) / sectors;
      values.push(radius * Math.cos(angle), 0, radius * Math.sin(angle));
      const next = (s + 1) % sectors;
      const at = (ring: number, sector: number) => 1 + ring * sectors + sector;
      if (r === 0) indices.push(0, at(0, s), at(0, next));
      else indices.push(at(r - 1, s), at(r, s), at(r, next), at(r - 1, s), at(r, next), at(r - 1, next));
    }
  return new Mesh(gl, values, [3], indices);
}
