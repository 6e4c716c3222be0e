// SPDX-License-Identifier: Apache-2.0
import {clamp} from '../math';
import type {Keyframe} from '../../dist/schema/cloudgen/pack/keyframe';
import {Clouds, type PackView} from './pack_view';

/** The clouds of a pack at a time between its keyframes, as src/runtime/timeline.cpp has them. */
export class Timeline {
  clouds: Clouds;
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
    for (let k = 0; k < this.seconds.length; ++k)
      for (let i = 0; i < this.clouds.count; ++i) {
        const [x, y, z, growth] = motionOf(root.keyframes(k)!, i);
        const info = pack.archetypes[pack.clouds.archetype(i)];
        const grown = Math.max(growth - 1, 0) * pack.clouds.scale(i) * (info.radiusMeters + Math.abs(info.middleMeters));
        this.slackMeters = Math.max(this.slackMeters, Math.hypot(x, y, z) + grown);
      }
    this.setTime(0);
  }

  get moves(): boolean {
    return this.seconds.length > 0;
  }

  setTime(seconds: number): void {
    if (!this.moves) return;
    const time = clamp(seconds, this.seconds[0], this.seconds[this.seconds.length - 1]);
    let after = 0;
    while (after + 1 < this.seconds.length && this.seconds[after] < time) ++after;
    const before = Math.max(0, after - 1);
    const span = this.seconds[after] - this.seconds[before];
    const share = span > 0 ? (time - this.seconds[before]) / span : 1;
    const from = this.pack.root.keyframes(before)!;
    const to = this.pack.root.keyframes(after)!;
    const still = this.pack.clouds.floats;
    const moved = this.clouds.floats;
    for (let i = 0; i < this.clouds.count; ++i) {
      const a = motionOf(from, i);
      const b = motionOf(to, i);
      const between = (k: number) => a[k] + share * (b[k] - a[k]);
      for (let k = 0; k < 3; ++k) moved[6 * i + k] = still[6 * i + k] + between(k);
      moved[6 * i + 4] = still[6 * i + 4] * between(3);
      moved[6 * i + 5] = still[6 * i + 5] * between(4);
    }
  }
}

/** Shift x, y, z, growth and presence. */
function motionOf(frame: Keyframe, cloud: number): [number, number, number, number, number] {
  if (frame.motionsLength() === 0) return [0, 0, 0, 1, 1];
  const motion = frame.motions(cloud)!;
  const shift = motion.shift()!;
  return [shift.x(), shift.y(), shift.z(), motion.growth(), motion.presence()];
}
