// SPDX-License-Identifier: Apache-2.0
// What a camera sees of a sky, each cloud in the detail that it needs: the rules of src/runtime/selection.cpp.
import {focalPixels, Frustum, INSIDE, OUTSIDE, type Camera} from '../camera';
import {YAW_STEPS, type ArchetypeInfo, type Clouds, type PackView} from './pack_view';

export interface Detail {
  /** Detail up to this size on the screen may be lost; more where more than `mostPuffs` would be left. */
  errorPixels: number;
  /** A cloud changes its level only this share of errorPixels beyond the limit. */
  hysteresis: number;
  /** About so many puffs are drawn at most: an even choice of them then stands for all. */
  mostPuffs: number;
}

export interface CloudSet {
  clouds: Clouds;
  /** Of a sky that moves: see Timeline. */
  velocities: Float32Array;
  slackMeters: number;
  /** 1 for clouds that are not shown. */
  hidden: Uint8Array;
  /** Heights are drawn so many times as large. */
  exaggeration: number;
}

const NEW = 255;
/** Where this many times too many puffs are left, the error grows by steps of such a factor. */
const MOST_THINNING = 16;
const COARSER = 1.5;
const MOST_ROUNDS = 12;

export class Selection {
  /** Cloud and puff of what was found, how much wider it is drawn, and a key that is smaller the farther it is. */
  clouds = new Uint32Array(1 << 12);
  puffs = new Uint32Array(1 << 12);
  widenings = new Float32Array(1 << 12);
  keys = new Uint16Array(1 << 12);
  count = 0;
  /** From the eye to the nearest cloud's sphere; Infinity if none is seen. */
  nearestMeters = Infinity;
  /** Clouds in view, and for each the pixels that a metre of it at scale 1 spans. */
  cloudCount = 0;
  private readonly inView: Uint32Array;
  private readonly pixels: Float32Array;
  private readonly levels: Uint8Array;

  constructor(private readonly pack: PackView) {
    this.levels = new Uint8Array(pack.clouds.count).fill(NEW);
    this.inView = new Uint32Array(pack.clouds.count);
    this.pixels = new Float32Array(pack.clouds.count);
  }

  select(set: CloudSet, camera: Camera, marginRadians: number, marginMeters: number, detail: Detail): void {
    this.findClouds(set, camera, new Frustum(camera, marginRadians, marginMeters));
    let error = detail.errorPixels;
    let count = this.chooseLevels(set, error, detail.hysteresis);
    for (let round = 0; count > MOST_THINNING * detail.mostPuffs && round < MOST_ROUNDS; ++round) {
      error *= COARSER;
      count = this.chooseLevels(set, error, 0);
    }
    this.count = 0;
    this.makeRoom(count);
    const share = Math.min(1, detail.mostPuffs / Math.max(1, count));
    for (let v = 0; v < this.cloudCount; ++v) this.addCloud(this.inView[v], set, camera, share);
  }

  /** Walks the tiles that the frustum meets. */
  private findClouds(set: CloudSet, camera: Camera, frustum: Frustum): void {
    this.cloudCount = 0;
    this.nearestMeters = Infinity;
    const focal = focalPixels(camera);
    const {floats, words} = this.pack.tiles;
    const {slackMeters: slack, exaggeration: e} = set;
    const waiting: [number, boolean][] = [[0, false]];
    while (waiting.length > 0) {
      const [tile, parentInside] = waiting.pop()!;
      const at = 10 * tile;
      let inside = parentInside;
      if (!inside) {
        const side = frustum.sideOfBox(
          floats[at] - slack, e * (floats[at + 1] - slack), floats[at + 2] - slack,
          floats[at + 3] + slack, e * (floats[at + 4] + slack), floats[at + 5] + slack,
        );
        if (side === OUTSIDE) continue;
        inside = side === INSIDE;
      }
      const [first, count, firstChild, children] = [words[at + 6], words[at + 7], words[at + 8], words[at + 9]];
      if (children > 0) for (let c = 0; c < children; ++c) waiting.push([firstChild + c, inside]);
      else for (let i = first; i < first + count; ++i) if (!set.hidden[i]) this.findCloud(i, inside, set, camera, focal, frustum);
    }
  }

  private findCloud(index: number, inside: boolean, set: CloudSet, camera: Camera, focal: number, frustum: Frustum): void {
    const {clouds, exaggeration: e} = set;
    if (clouds.factor(index) <= 0) return;
    const archetype = this.pack.archetypes[clouds.archetype(index)];
    const scale = clouds.scale(index);
    const radius = e * archetype.radiusMeters * scale;
    const x = clouds.floats[6 * index];
    const y = e * (clouds.floats[6 * index + 1] + archetype.middleMeters * scale);
    const z = clouds.floats[6 * index + 2];
    if (!inside && !frustum.meetsSphere(x, y, z, radius)) return;
    const toSphere = Math.hypot(x - camera.eye[0], y - camera.eye[1], z - camera.eye[2]) - radius;
    this.nearestMeters = Math.min(this.nearestMeters, toSphere);
    this.inView[this.cloudCount] = index;
    this.pixels[this.cloudCount++] = (scale * focal) / Math.max(toSphere, 1);
  }

  /** How many puffs the clouds in view have then. */
  private chooseLevels(set: CloudSet, errorPixels: number, hysteresis: number): number {
    let puffs = 0;
    for (let v = 0; v < this.cloudCount; ++v) {
      const index = this.inView[v];
      const archetype = this.pack.archetypes[set.clouds.archetype(index)];
      const level = chosenLevel(archetype, this.levels[index], this.pixels[v], errorPixels, hysteresis);
      this.levels[index] = level;
      puffs += archetype.levels[level].count;
    }
    return puffs;
  }

  /** An even choice of a cloud's puffs, each wider by nearly as much as keeps their area, as they overlap (Cook et al. 2007). */
  private addCloud(index: number, set: CloudSet, camera: Camera, share: number): void {
    const widening = Math.pow(share, -0.4);
    const least = Math.floor(share * 2 ** 32);
    const {clouds, exaggeration: e} = set;
    const {centers} = this.pack;
    const {first, count} = this.pack.archetypes[clouds.archetype(index)].levels[this.levels[index]];
    const scale = clouds.scale(index);
    const yaw = clouds.yawStep(index);
    const [cosine, sine] = [COSINES[yaw], SINES[yaw]];
    const x = clouds.floats[6 * index] - camera.eye[0];
    const y = e * clouds.floats[6 * index + 1] - camera.eye[1];
    const z = clouds.floats[6 * index + 2] - camera.eye[2];
    for (let p = first; p < first + count; ++p) {
      if (share < 1 && Math.imul(Math.imul(index + 1, 0x85ebca6b) ^ (p + 1), 0x9e3779b1) >>> 0 > least) continue;
      const cx = centers[3 * p];
      const cz = centers[3 * p + 2];
      const dx = x + scale * (cosine * cx + sine * cz);
      const dy = y + e * scale * centers[3 * p + 1];
      const dz = z + scale * (cosine * cz - sine * cx);
      this.clouds[this.count] = index;
      this.puffs[this.count] = p;
      this.widenings[this.count] = widening;
      this.keys[this.count++] = farFirst(dx * dx + dy * dy + dz * dz);
    }
  }

  private makeRoom(count: number): void {
    if (count <= this.keys.length) return;
    const size = 2 ** Math.ceil(Math.log2(count));
    this.clouds = new Uint32Array(size);
    this.puffs = new Uint32Array(size);
    this.widenings = new Float32Array(size);
    this.keys = new Uint16Array(size);
  }
}

/** The coarsest level whose error is small enough; from the current one it goes only once the limit is clearly passed. */
export function chosenLevel(archetype: Pick<ArchetypeInfo, 'levels'>, current: number, pixelsPerMeter: number, errorPixels: number, hysteresis: number): number {
  const {levels} = archetype;
  const isNew = current >= levels.length;
  const slack = isNew ? 0 : hysteresis;
  let level = isNew ? levels.length - 1 : current;
  while (level > 0 && levels[level].errorMeters * pixelsPerMeter > errorPixels * (1 + slack)) --level;
  if (isNew) return level;
  while (level + 1 < levels.length && levels[level + 1].errorMeters * pixelsPerMeter < errorPixels * (1 - slack)) ++level;
  return level;
}

/** Of the headings of clouds: counter-clockwise from above, a 16th of a turn a step. */
export const COSINES = Float64Array.from({length: YAW_STEPS}, (_, i) => Math.cos((2 * Math.PI * i) / YAW_STEPS));
export const SINES = Float64Array.from({length: YAW_STEPS}, (_, i) => Math.sin((2 * Math.PI * i) / YAW_STEPS));

const keyFloat = new Float32Array(1);
const keyBits = new Uint32Array(keyFloat.buffer);
const ONE_BITS = 0x3f800000;

/** A key of 16 bits that falls with the distance: the bits of a float above 1 rise nearly as its logarithm. */
export function farFirst(squaredMeters: number): number {
  keyFloat[0] = squaredMeters > 1 ? squaredMeters : 1;
  return 0xffff - Math.min(0xffff, (keyBits[0] - ONE_BITS) >>> 13);
}

/** The numbers of the keys in rising order of the keys; equal ones stay as they are. */
export function sortedByKey(keys: Uint16Array, count: number): Uint32Array {
  let from = new Uint32Array(count);
  let to = new Uint32Array(count);
  for (let i = 0; i < count; ++i) from[i] = i;
  for (const shift of [0, 8]) {
    const next = new Uint32Array(257);
    for (let i = 0; i < count; ++i) ++next[((keys[i] >> shift) & 255) + 1];
    for (let b = 1; b < 256; ++b) next[b] += next[b - 1];
    for (let i = 0; i < count; ++i) to[next[(keys[from[i]] >> shift) & 255]++] = from[i];
    [from, to] = [to, from];
  }
  return from;
}
