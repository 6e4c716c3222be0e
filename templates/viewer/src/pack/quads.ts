// SPDX-License-Identifier: Apache-2.0
// From puffs to what the GPU draws: a quad each that faces the eye, with its colour through the air.
import {clarity} from '../air';
import {displayColor, displayValue, linearValue} from '../color';
import type {Camera} from '../camera';
import type {Lighting} from './lighting';
import {YAW_STEPS, type PackView} from './pack_view';
import type {CloudSet, Selection} from './selection';

/** A corner: x, y, z (floats); red, green, blue, opacity (bytes); place in the sprite across and up, 0 or 255, and its layer (a short). */
export const CORNER_BYTES = 20;
/** Lower left, lower right, upper left, upper right. */
export const QUAD_BYTES = 4 * CORNER_BYTES;
/** Where a sprite ends, in its deviations. */
export const REACH = 2.2;
/** Below this a quad is not seen. */
const FAINTEST = 0.004;

const LINEAR = Float32Array.from({length: 256}, (_, i) => linearValue(i / 255));
const DISPLAY = Float32Array.from({length: 1025}, (_, i) => 255 * displayValue(i / 1024));
const displayed = (linear: number): number => DISPLAY[Math.min(1024, Math.round(1024 * linear))];

export interface Quads {
  buffer: ArrayBuffer;
  count: number;
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
  private locked = new Map<number, [number, number, number]>();
  private readonly firstLayer: number[] = [];
  private readonly tilesOf: number[] = [];
  private dimmed: Float32Array = new Float32Array(0);

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

  /** The quads of the selected puffs in the given order. */
  quadsOf(selection: Selection, order: Uint32Array, set: CloudSet, camera: Camera): Quads {
    const {centers, covariances, opticalDepths, sprites} = this.pack;
    const {clouds, exaggeration: e} = set;
    const buffer = new ArrayBuffer(QUAD_BYTES * order.length);
    const floats = new Float32Array(buffer);
    const words = new Uint32Array(buffer);
    const rgba = new Uint8Array(4);
    const rgbaWord = new Uint32Array(rgba.buffer);
    const horizon = displayColor(this.lighting.daylight.horizon).map((value) => 255 * value);
    const [sunX, sunY, sunZ] = this.lighting.direction;
    const [eyeX, eyeY, eyeZ] = camera.eye;
    const eyeHeight = eyeY / e;
    const axes = new Float64Array(4);
    const locked = new Map<number, [number, number, number]>();
    let count = 0;
    for (const at of order) {
      const cloud = selection.clouds[at];
      const p = selection.puffs[at];
      const alpha = 1 - Math.exp(-opticalDepths[p] * clouds.factor(cloud));
      if (alpha < FAINTEST) continue;
      const scale = clouds.scale(cloud);
      const yaw = clouds.yawStep(cloud);
      const [c, s] = [COSINES[yaw], SINES[yaw]];
      const [px, py, pz] = [centers[3 * p], centers[3 * p + 1], centers[3 * p + 2]];
      const x = clouds.floats[6 * cloud] + scale * (c * px + s * pz);
      const height = clouds.floats[6 * cloud + 1] + scale * py;
      const y = e * height;
      const z = clouds.floats[6 * cloud + 2] + scale * (c * pz - s * px);
      // The covariance in the world.
      const k = 6 * p;
      const square = scale * scale;
      const [axx, axy, axz, ayy, ayz, azz] = [covariances[k], covariances[k + 1], covariances[k + 2], covariances[k + 3], covariances[k + 4], covariances[k + 5]];
      const cxx = square * (c * c * axx + 2 * c * s * axz + s * s * azz);
      const cxz = square * (c * s * (azz - axx) + (c * c - s * s) * axz);
      const czz = square * (s * s * axx - 2 * c * s * axz + c * c * azz);
      const cxy = e * square * (c * axy + s * ayz);
      const cyz = e * square * (c * ayz - s * axy);
      const cyy = e * e * square * ayy;
      // The direction to it.
      let [dx, dy, dz] = [x - eyeX, y - eyeY, z - eyeZ];
      const away = Math.sqrt(dx * dx + dy * dy + dz * dz);
      const radius = REACH * Math.sqrt(Math.max(cxx, cyy, czz));
      if (away < 0.5 * radius) {
        const key = cloud * 65536 + (p & 65535);
        const facing = this.locked.get(key) ?? (away > 1e-3 ? [dx / away, dy / away, dz / away] : camera.forward);
        locked.set(key, facing as [number, number, number]);
        [dx, dy, dz] = facing;
      } else {
        dx /= away;
        dy /= away;
        dz /= away;
      }
      const level = Math.sqrt(dx * dx + dz * dz);
      const [rx, rz] = level > 1e-4 ? [-dz / level, dx / level] : [1, 0];
      const [ux, uy, uz] = [-rz * dy, rz * dx - rx * dz, rx * dy];
      const xx = rx * rx * cxx + 2 * rx * rz * cxz + rz * rz * czz;
      const [mx, my, mz] = [cxx * ux + cxy * uy + cxz * uz, cxy * ux + cyy * uy + cyz * uz, cxz * ux + cyz * uy + czz * uz];
      shownAxes(xx, rx * mx + rz * mz, ux * mx + uy * my + uz * mz, axes);
      const info = this.pack.archetypes[clouds.archetype(cloud)];
      const color = 4 * (this.lighting.firstColor(clouds.archetype(cloud), yaw) + p - info.firstPuff);
      const towards = Math.max(0, dx * sunX + dy * sunY + dz * sunZ);
      const beam = (this.lighting.colors[color + 3] / 255) * towards;
      const through = clarity(away, eyeHeight, height);
      const sun = this.lighting.sunColor(clouds.archetype(cloud));
      for (let i = 0; i < 3; ++i) {
        let shown = this.lighting.colors[color + i];
        const dim = this.dimmed[3 * cloud + i];
        if (dim < 1 || beam > 0.01) shown = displayed((LINEAR[shown] + beam * sun[i]) * dim);
        rgba[i] = horizon[i] + through * (shown - horizon[i]);
      }
      rgba[3] = Math.round(255 * alpha);
      const layer = this.firstLayer[info.atlas] + (sprites[p] % this.tilesOf[info.atlas]);
      for (let corner = 0; corner < 4; ++corner) {
        const [across, upwards] = [corner & 1 ? REACH : -REACH, corner & 2 ? REACH : -REACH];
        const onRight = across * axes[0] + upwards * axes[2];
        const onUp = across * axes[1] + upwards * axes[3];
        const f = 20 * count + 5 * corner;
        floats[f] = x + onRight * rx + onUp * ux;
        floats[f + 1] = y + onUp * uy;
        floats[f + 2] = z + onRight * rz + onUp * uz;
        words[f + 3] = rgbaWord[0];
        words[f + 4] = (corner & 1 ? 255 : 0) | (corner & 2 ? 255 << 8 : 0) | (layer << 16);
      }
      ++count;
    }
    this.locked = locked;
    return {buffer: count === order.length ? buffer : buffer.slice(0, QUAD_BYTES * count), count};
  }
}

const COSINES = Float64Array.from({length: YAW_STEPS}, (_, i) => Math.cos((2 * Math.PI * i) / YAW_STEPS));
const SINES = Float64Array.from({length: YAW_STEPS}, (_, i) => Math.sin((2 * Math.PI * i) / YAW_STEPS));
