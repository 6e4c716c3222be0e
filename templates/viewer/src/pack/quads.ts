// SPDX-License-Identifier: Apache-2.0
// From puffs to what the GPU draws: a quad each that faces the eye, with its colour through the air.
import {clarity} from '../air';
import {displayValue, linearValue} from '../color';
import {focalPixels, type Camera} from '../camera';
import type {Lighting} from './lighting';
import type {Vec3} from '../math';
import type {PackView} from './pack_view';
import {COSINES, SINES, type CloudSet, type Selection} from './selection';

/** A corner: x, y, z (floats); red, green, blue, opacity (bytes). Quads have two words more: see `Shape`. */
export const CORNER_BYTES = 16;

/**
 * What is drawn of a puff. Triangles about the ellipse, for the moving view: least work for a software renderer. Quads with sprites, for the
 * picture at rest: lower left, lower right, upper left, upper right; their corners carry a word more, the place in the sprite (bytes, 0 or
 * 255) and its layer (a short).
 */
export type Shape = 'triangles' | 'quads';
export const bytesOf = (shape: Shape): number => (shape === 'triangles' ? 3 * CORNER_BYTES : 4 * (CORNER_BYTES + 4));

/** Where a sprite ends, in its deviations. */
export const REACH = 2.2;
/** Below this a quad is not seen. */
const FAINTEST = 0.004;

const LINEAR = Float32Array.from({length: 256}, (_, i) => linearValue(i / 255));
const DISPLAY = Float32Array.from({length: 1025}, (_, i) => 255 * displayValue(i / 1024));
const displayed = (linear: number): number => DISPLAY[Math.min(1024, Math.round(1024 * linear))];

export interface Quads {
  buffer: ArrayBuffer;
  /** Of a sky that moves, triangles alone: how far each corner goes in a second of the pack's time, x, y, z. */
  motions: ArrayBuffer | null;
  count: number;
  /** Pixels of the camera's picture that they cover together, each for itself. */
  fillPixels: number;
}

/** The ellipse, one deviation out, of a covariance seen along a direction: half-axes in the plane of right and up, the first nearer to `right`. */
export function shownAxes(xx: number, xy: number, yy: number, out: Float64Array): void {
  const middle = 0.5 * (xx + yy);
  const reach = Math.hypot(0.5 * (xx - yy), xy);
  if (reach < 0.02 * middle) {
    out[0] = Math.sqrt(Math.max(xx, 0));
    out[1] = 0;
    out[2] = 0;
    out[3] = Math.sqrt(Math.max(yy, 0));
    return;
  }
  // The half-angle form of the principal direction; within 45 degrees of `right` by the choice of the root.
  let angle = 0.5 * Math.atan2(2 * xy, xx - yy);
  let [first, second] = [middle + reach, middle - reach];
  if (Math.abs(angle) > Math.PI / 4) {
    angle -= (Math.sign(angle) * Math.PI) / 2;
    [first, second] = [second, first];
  }
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const [a, b] = [Math.sqrt(Math.max(first, 0)), Math.sqrt(Math.max(second, 0))];
  out[0] = a * cosine;
  out[1] = a * sine;
  out[2] = -b * sine;
  out[3] = b * cosine;
}

/** Turns lists of puffs into quads. Puffs that hold the eye keep the facing that they had when it came in (Wang 2004). */
export class QuadMaker {
  private locked = new Map<number, Vec3>();
  private readonly firstLayer: number[] = [];
  private readonly tilesOf: number[] = [];
  private dimmed: Float32Array = new Float32Array(0);
  // Of the puff that is being written: its place and covariance, the way to it, the cosine to the sun, and its half-axes.
  private x = 0;
  private y = 0;
  private z = 0;
  private xx = 0;
  private xy = 0;
  private xz = 0;
  private yy = 0;
  private yz = 0;
  private zz = 0;
  private away = 0;
  private area = 0;
  private towards = 0;
  private ax = 0;
  private ay = 0;
  private az = 0;
  private bx = 0;
  private by = 0;
  private bz = 0;
  private readonly axes = new Float64Array(4);
  private floats = new Float32Array(0);
  private words = new Uint32Array(0);
  private motions = new Float32Array(0);
  /** What it fades into. */
  private readonly haze = new Float64Array(3);

  constructor(private readonly pack: PackView, private readonly lighting: Lighting) {
    let layers = 0;
    for (let a = 0; a < pack.root.atlasesLength(); ++a) {
      const atlas = pack.root.atlases(a)!;
      this.firstLayer.push(layers);
      this.tilesOf.push(Math.max(1, atlas.columns() * atlas.rows()));
      layers += this.tilesOf[a];
    }
  }

  /** After the sun has moved: how much darker clouds in the shadow of others are. */
  lightChanged(): void {
    const {clouds} = this.pack;
    this.dimmed = new Float32Array(3 * clouds.count).fill(1);
    for (let i = 0; i < clouds.count; ++i) {
      const share = clouds.sunlight(i);
      if (share >= 1) continue;
      const {sun, other} = this.lighting.dimmings[clouds.archetype(i)];
      for (let k = 0; k < 3; ++k) {
        const all = sun[k] + other[k];
        this.dimmed[3 * i + k] = all > 0 ? (share * sun[k] + other[k]) / all : 1;
      }
    }
  }

  /** The selected puffs in the given order. */
  quadsOf(selection: Selection, order: Uint32Array, set: CloudSet, camera: Camera, shape: Shape): Quads {
    const bytes = bytesOf(shape);
    const buffer = new ArrayBuffer(bytes * order.length);
    this.floats = new Float32Array(buffer);
    this.words = new Uint32Array(buffer);
    const moves = shape === 'triangles' && set.velocities.length > 0;
    this.motions = new Float32Array(moves ? 9 * order.length : 0);
    const locked = new Map<number, Vec3>();
    const square = focalPixels(camera) ** 2;
    let count = 0;
    let fillPixels = 0;
    for (let i = 0; i < order.length; ++i) {
      const at = order[i];
      const cloud = selection.clouds[at];
      const puff = selection.puffs[at];
      const alpha = 1 - Math.exp(-this.pack.opticalDepths[puff] * set.clouds.factor(cloud));
      if (alpha < FAINTEST) continue;
      this.standPuff(cloud, puff, set, selection.widenings[at]);
      this.faceEye(camera, cloud, puff, locked);
      fillPixels += (this.area * square) / (this.away * this.away + this.area);
      const color = this.colorOf(cloud, puff, set, camera, alpha);
      if (shape === 'triangles') this.writeTriangle(count, color);
      else this.writeQuad(count, color, this.layerOf(cloud, puff, set));
      if (moves) this.writeMotion(count, cloud, set);
      ++count;
    }
    this.locked = locked;
    const motions = moves ? this.motions.buffer.slice(0, 36 * count) : null;
    return {buffer: count === order.length ? buffer : buffer.slice(0, bytes * count), motions, count, fillPixels};
  }

  /** Where the puff stands in drawn metres, and its covariance. */
  private standPuff(cloud: number, puff: number, {clouds, exaggeration: e}: CloudSet, widening: number): void {
    const {centers, covariances} = this.pack;
    const scale = clouds.scale(cloud);
    const yaw = clouds.yawStep(cloud);
    const c = COSINES[yaw];
    const s = SINES[yaw];
    const px = centers[3 * puff];
    const pz = centers[3 * puff + 2];
    this.x = clouds.floats[6 * cloud] + scale * (c * px + s * pz);
    this.y = e * (clouds.floats[6 * cloud + 1] + scale * centers[3 * puff + 1]);
    this.z = clouds.floats[6 * cloud + 2] + scale * (c * pz - s * px);
    const square = scale * scale * widening * widening;
    const k = 6 * puff;
    const xx = covariances[k];
    const xy = covariances[k + 1];
    const xz = covariances[k + 2];
    const yz = covariances[k + 4];
    const zz = covariances[k + 5];
    this.xx = square * (c * c * xx + 2 * c * s * xz + s * s * zz);
    this.xz = square * (c * s * (zz - xx) + (c * c - s * s) * xz);
    this.zz = square * (s * s * xx - 2 * c * s * xz + c * c * zz);
    this.xy = e * square * (c * xy + s * yz);
    this.yz = e * square * (c * yz - s * xy);
    this.yy = e * e * square * covariances[k + 3];
  }

  /** The direction to the puff, what lies at the horizon there, and the half-axes of the ellipse that it shows. */
  private faceEye(camera: Camera, cloud: number, puff: number, locked: Map<number, Vec3>): void {
    let dx = this.x - camera.eye[0];
    let dy = this.y - camera.eye[1];
    let dz = this.z - camera.eye[2];
    this.away = Math.sqrt(dx * dx + dy * dy + dz * dz);
    const radius = REACH * Math.sqrt(Math.max(this.xx, this.yy, this.zz));
    if (this.away < 0.5 * radius) {
      const key = cloud * 65536 + (puff & 65535);
      const facing = this.locked.get(key) ?? (this.away > 1e-3 ? [dx / this.away, dy / this.away, dz / this.away] : camera.forward);
      locked.set(key, facing);
      dx = facing[0];
      dy = facing[1];
      dz = facing[2];
    } else {
      dx /= this.away;
      dy /= this.away;
      dz /= this.away;
    }
    const level = Math.sqrt(dx * dx + dz * dz);
    const [sunX, sunZ] = this.lighting.sky.sunwards;
    this.lighting.sky.horizonTowards(level > 1e-4 ? (dx * sunX + dz * sunZ) / level : 0, this.haze);
    const rx = level > 1e-4 ? -dz / level : 1;
    const rz = level > 1e-4 ? dx / level : 0;
    const ux = -rz * dy;
    const uy = rz * dx - rx * dz;
    const uz = rx * dy;
    const mx = this.xx * ux + this.xy * uy + this.xz * uz;
    const my = this.xy * ux + this.yy * uy + this.yz * uz;
    const mz = this.xz * ux + this.yz * uy + this.zz * uz;
    const axes = this.axes;
    shownAxes(rx * rx * this.xx + 2 * rx * rz * this.xz + rz * rz * this.zz, rx * mx + rz * mz, ux * mx + uy * my + uz * mz, axes);
    this.towards = dx * this.lighting.direction[0] + dy * this.lighting.direction[1] + dz * this.lighting.direction[2];
    this.area = 4 * REACH * REACH * Math.abs(axes[0] * axes[3] - axes[1] * axes[2]);
    this.ax = REACH * (axes[0] * rx + axes[1] * ux);
    this.ay = REACH * axes[1] * uy;
    this.az = REACH * (axes[0] * rz + axes[1] * uz);
    this.bx = REACH * (axes[2] * rx + axes[3] * ux);
    this.by = REACH * axes[3] * uy;
    this.bz = REACH * (axes[2] * rz + axes[3] * uz);
  }

  /** Its colour through the air, and its opacity, as bytes in a word. */
  private colorOf(cloud: number, puff: number, {clouds, exaggeration: e}: CloudSet, camera: Camera, alpha: number): number {
    const archetype = clouds.archetype(cloud);
    const at = 4 * (this.lighting.firstColor(archetype, clouds.yawStep(cloud)) + puff - this.pack.archetypes[archetype].firstPuff);
    const {colors} = this.lighting;
    const beam = (colors[at + 3] / 255) * Math.max(0, this.towards);
    const through = clarity(this.away, camera.eye[1] / e, this.y / e);
    const sun = this.lighting.sunColor(archetype);
    let word = Math.round(255 * alpha) << 24;
    for (let i = 0; i < 3; ++i) {
      let shown = colors[at + i];
      const dim = this.dimmed[3 * cloud + i];
      if (dim < 1 || beam > 0.01) shown = displayed((LINEAR[shown] + beam * sun[i]) * dim);
      word |= Math.round(this.haze[i] + through * (shown - this.haze[i])) << (8 * i);
    }
    return word >>> 0;
  }

  private layerOf(cloud: number, puff: number, {clouds}: CloudSet): number {
    const {atlas} = this.pack.archetypes[clouds.archetype(cloud)];
    return this.firstLayer[atlas] + (this.pack.sprites[puff] % this.tilesOf[atlas]);
  }

  private writeCorner(word: number, across: number, upwards: number, color: number): void {
    this.floats[word] = this.x + across * this.ax + upwards * this.bx;
    this.floats[word + 1] = this.y + across * this.ay + upwards * this.by;
    this.floats[word + 2] = this.z + across * this.az + upwards * this.bz;
    this.words[word + 3] = color;
  }

  private writeTriangle(index: number, color: number): void {
    for (let corner = 0; corner < 3; ++corner) this.writeCorner(12 * index + 4 * corner, TRIANGLE[2 * corner], TRIANGLE[2 * corner + 1], color);
  }

  /** A corner goes with its cloud, and away from the cloud's origin as it grows. */
  private writeMotion(index: number, cloud: number, {clouds, velocities, exaggeration: e}: CloudSet): void {
    const growth = velocities[4 * cloud + 3];
    for (let corner = 0; corner < 3; ++corner)
      for (let k = 0; k < 3; ++k) {
        const stretch = k === 1 ? e : 1;
        const away = this.floats[12 * index + 4 * corner + k] - stretch * clouds.floats[6 * cloud + k];
        this.motions[9 * index + 3 * corner + k] = stretch * velocities[4 * cloud + k] + growth * away;
      }
  }

  private writeQuad(index: number, color: number, layer: number): void {
    for (let corner = 0; corner < 4; ++corner) {
      const word = 20 * index + 5 * corner;
      this.writeCorner(word, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, color);
      this.words[word + 4] = (corner & 1 ? 255 : 0) | (corner & 2 ? 255 << 8 : 0) | (layer << 16);
    }
  }
}

/** Corners of the triangle about the unit circle. */
export const TRIANGLE = [0, 2, -Math.sqrt(3), -1, Math.sqrt(3), -1];
