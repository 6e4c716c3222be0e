// SPDX-License-Identifier: Apache-2.0
import {clamp} from '../math';
import type {Keyframe} from '../../dist/schema/cloudgen/pack/keyframe';
import {Clouds, type PackView} from './pack_view';

/** Shift x, y, z, growth and presence: a motion is five floats. */
const MOTION_FLOATS = 5;
const AT_REST = Float32Array.of(0, 0, 0, 1, 1);

/** A time between two keyframes, all in seconds from the pack's valid time. */
export interface Moment {
  seconds: number;
  from: number;
  to: number;
}

/** Reads the motions of a keyframe where they lie in the pack, cloud after cloud. */
class Motions {
  private readonly floats: Float32Array | null;
  private readonly named: Uint32Array | null;
  private next = 0;
  /** Of the cloud that was asked for last: where its motion starts in `values`. */
  values: Float32Array = AT_REST;
  at = 0;

  constructor(frame: Keyframe, bytes: ArrayBuffer) {
    const count = frame.motionsLength();
    this.floats = count > 0 ? new Float32Array(bytes, frame.motions(0)!.bb_pos, MOTION_FLOATS * count) : null;
    this.named = frame.cloudsArray();
  }

  /** Goes to the motion of a cloud after those that were asked for before; false where it is not there. */
  goTo(cloud: number): boolean {
    this.values = AT_REST;
    this.at = 0;
    let index = cloud;
    if (this.named) {
      while (this.next < this.named.length && this.named[this.next] < cloud) ++this.next;
      if (this.next === this.named.length || this.named[this.next] !== cloud) return false;
      index = this.next;
    }
    if (!this.floats) return true;
    this.values = this.floats;
    this.at = MOTION_FLOATS * index;
    return true;
  }
}

/**
 * The clouds of a pack at a time between its keyframes, as src/runtime/timeline.cpp has them: places and sizes run straight from one
 * to the next, and a cloud that comes or goes changes its optical depth.
 */
export class Timeline {
  clouds: Clouds;
  /** How far clouds go in a second of the pack's time, metres, and how much they grow, of the size they have: x, y, z, growth. */
  velocities: Float32Array = new Float32Array(0);
  /** The time that `clouds` are of, and those of the keyframes about it. */
  now: Moment = {seconds: 0, from: 0, to: 0};
  /** Clouds may have moved out of their tiles by so much. */
  slackMeters = 0;
  /** Seconds from the pack's valid time, one a keyframe. */
  readonly seconds: number[] = [];

  constructor(private readonly pack: PackView) {
    this.clouds = pack.clouds;
    const {root} = pack;
    for (let k = 0; k < root.keyframesLength(); ++k) this.seconds.push(root.keyframes(k)!.seconds());
    if (!this.moves) return;
    this.clouds = pack.clouds.copied();
    this.velocities = new Float32Array(4 * this.clouds.count);
    for (let k = 0; k < this.seconds.length; ++k) this.slackMeters = Math.max(this.slackMeters, this.slackOf(k));
    this.setTime(0);
  }

  get moves(): boolean {
    return this.seconds.length > 0;
  }

  /** Times before the first and after the last keyframe are taken there. */
  setTime(seconds: number): void {
    if (!this.moves) return;
    const time = clamp(seconds, this.seconds[0], this.seconds[this.seconds.length - 1]);
    let after = 0;
    while (after + 1 < this.seconds.length && this.seconds[after] < time) ++after;
    const before = Math.max(0, after - 1);
    this.now = {seconds: time, from: this.seconds[before], to: this.seconds[after]};
    const span = this.seconds[after] - this.seconds[before];
    const share = span > 0 ? (time - this.seconds[before]) / span : 1;
    const [from, to] = [this.motionsAt(before), this.motionsAt(after)];
    const still = this.pack.clouds.floats;
    const moved = this.clouds.floats;
    const perSecond = span > 0 ? 1 / span : 0;
    for (let i = 0; i < this.clouds.count; ++i) {
      const wasThere = from.goTo(i);
      const isThere = to.goTo(i) && wasThere;
      const a = from.values;
      const b = to.values;
      const p = from.at;
      const q = to.at;
      for (let k = 0; k < 3; ++k) {
        moved[6 * i + k] = still[6 * i + k] + a[p + k] + share * (b[q + k] - a[p + k]);
        this.velocities[4 * i + k] = (b[q + k] - a[p + k]) * perSecond;
      }
      const growth = a[p + 3] + share * (b[q + 3] - a[p + 3]);
      moved[6 * i + 4] = still[6 * i + 4] * growth;
      moved[6 * i + 5] = isThere ? still[6 * i + 5] * (a[p + 4] + share * (b[q + 4] - a[p + 4])) : 0;
      this.velocities[4 * i + 3] = growth > 0 ? ((b[q + 3] - a[p + 3]) * perSecond) / growth : 0;
    }
  }

  private motionsAt(keyframe: number): Motions {
    return new Motions(this.pack.root.keyframes(keyframe)!, this.pack.bytes);
  }

  private slackOf(keyframe: number): number {
    const {clouds, archetypes} = this.pack;
    const motions = this.motionsAt(keyframe);
    let slack = 0;
    for (let i = 0; i < clouds.count; ++i) {
      if (!motions.goTo(i)) continue;
      const {values, at} = motions;
      const info = archetypes[clouds.archetype(i)];
      const grown = Math.max(values[at + 3] - 1, 0) * clouds.scale(i) * (info.radiusMeters + Math.abs(info.middleMeters));
      slack = Math.max(slack, Math.hypot(values[at], values[at + 1], values[at + 2]) + grown);
    }
    return slack;
  }
}
