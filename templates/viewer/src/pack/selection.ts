// SPDX-License-Identifier: Apache-2.0
// What a camera sees of a sky, each cloud in the detail that it needs: the rules of src/runtime/selection.cpp.
import {focalPixels, Frustum, INSIDE, OUTSIDE, type Camera} from '../camera';
import {YAW_STEPS, type ArchetypeInfo, type Clouds, type PackView} from './pack_view';

export interface Detail {
  /** Detail up to this size on the screen may be lost. */
  errorPixels: number;
  /** A cloud changes its level only this share of errorPixels beyond the limit. */
  hysteresis: number;
  /** More puffs than this are never drawn at once. */
  mostPuffs: number;
}

export interface CloudSet {
  clouds: Clouds;
  slackMeters: number;
  /** 1 for clouds that are not shown. */
  hidden: Uint8Array;
  /** Heights are drawn so many times as large. */
  exaggeration: number;
}

const NEW = 255;

export class Selection {
  /** Cloud and puff of what was found, and a key that is smaller the farther it is. */
  clouds = new Uint32Array(1 << 12);
  puffs = new Uint32Array(1 << 12);
  keys = new Uint16Array(1 << 12);
  count = 0;
  /** From the eye to the nearest cloud's sphere; Infinity if none is seen. */
  nearestMeters = Infinity;
  cloudCount = 0;
  private readonly levels: Uint8Array;
  private readonly turns: [number, number][] = Array.from({length: YAW_STEPS}, (_, i) => [
    Math.cos((2 * Math.PI * i) / YAW_STEPS),
    Math.sin((2 * Math.PI * i) / YAW_STEPS),
  ]);

  constructor(private readonly pack: PackView) {
    this.levels = new Uint8Array(pack.clouds.count).fill(NEW);
  }

  select(set: CloudSet, camera: Camera, marginRadians: number, marginMeters: number, detail: Detail): void {
    const frustum = new Frustum(camera, marginRadians, marginMeters);
    this.count = this.cloudCount = 0;
    this.nearestMeters = Infinity;
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
      else for (let i = first; i < first + count; ++i) if (!set.hidden[i]) this.visitCloud(i, inside, set, camera, frustum, detail);
    }
  }

  private visitCloud(index: number, inside: boolean, set: CloudSet, camera: Camera, frustum: Frustum, detail: Detail): void {
    const {clouds, exaggeration: e} = set;
    if (clouds.factor(index) <= 0) return;
    const archetype = this.pack.archetypes[clouds.archetype(index)];
    const scale = clouds.scale(index);
    const radius = e * archetype.radiusMeters * scale;
    const [x, y, z] = [clouds.floats[6 * index], clouds.floats[6 * index + 1], clouds.floats[6 * index + 2]];
    const middle = e * (y + archetype.middleMeters * scale);
    if (!inside && !frustum.meetsSphere(x, middle, z, radius)) return;
    const [eyeX, eyeY, eyeZ] = camera.eye;
    const toSphere = Math.hypot(x - eyeX, middle - eyeY, z - eyeZ) - radius;
    this.nearestMeters = Math.min(this.nearestMeters, toSphere);
    const level = this.chosenLevel(archetype, this.levels[index], (scale * focalPixels(camera)) / Math.max(toSphere, 1), detail);
    this.levels[index] = level;
    const {first, count} = archetype.levels[level];
    if (this.count + count > detail.mostPuffs) return;
    this.makeRoom(this.count + count);
    ++this.cloudCount;
    const [cosine, sine] = this.turns[clouds.yawStep(index)];
    const {centers} = this.pack;
    for (let p = first; p < first + count; ++p) {
      const [cx, cy, cz] = [centers[3 * p], centers[3 * p + 1], centers[3 * p + 2]];
      const dx = x + scale * (cosine * cx + sine * cz) - eyeX;
      const dy = e * (y + scale * cy) - eyeY;
      const dz = z + scale * (cosine * cz - sine * cx) - eyeZ;
      this.clouds[this.count] = index;
      this.puffs[this.count] = p;
      this.keys[this.count++] = farFirst(dx * dx + dy * dy + dz * dz);
    }
  }

  /** The coarsest level whose error is small enough; from the current one it goes only once the limit is clearly passed. */
  private chosenLevel(archetype: ArchetypeInfo, current: number, pixelsPerMeter: number, detail: Detail): number {
    const {levels} = archetype;
    const isNew = current >= levels.length;
    const slack = isNew ? 0 : detail.hysteresis;
    let level = isNew ? levels.length - 1 : current;
    while (level > 0 && levels[level].errorMeters * pixelsPerMeter > detail.errorPixels * (1 + slack)) --level;
    if (isNew) return level;
    while (level + 1 < levels.length && levels[level + 1].errorMeters * pixelsPerMeter < detail.errorPixels * (1 - slack)) ++level;
    return level;
  }

  private makeRoom(count: number): void {
    if (count <= this.keys.length) return;
    const size = 2 ** Math.ceil(Math.log2(count));
    const grown = <Array extends Uint32Array | Uint16Array>(made: Array, old: Array): Array => (made.set(old), made);
    this.clouds = grown(new Uint32Array(size), this.clouds);
    this.puffs = grown(new Uint32Array(size), this.puffs);
    this.keys = grown(new Uint16Array(size), this.keys);
  }
}

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
