// SPDX-License-Identifier: Apache-2.0
import {clamp, mixed, type Vec3} from '../math';
import type {RuntimePack} from '../../dist/schema/cloudgen/pack/runtime-pack';
import type {Vec3 as PackVec3} from '../../dist/schema/cloudgen/pack/vec3';

/** Where the sun stands. Azimuth clockwise from north. */
export interface SunPlace {
  azimuthDegrees: number;
  elevationDegrees: number;
}

/** Colours under a sun, display-linear. */
export interface Daylight {
  zenith: Vec3;
  horizon: Vec3;
  ground: Vec3;
  ambient: Vec3;
  bounce: Vec3;
  /** The sun's, for each of the pack's sun heights. */
  suns: Vec3[];
}

const vec3 = (v: PackVec3): Vec3 => [v.x(), v.y(), v.z()];

/** Towards the sun. */
export function directionTo(sun: SunPlace): Vec3 {
  const azimuth = (sun.azimuthDegrees * Math.PI) / 180;
  const elevation = (sun.elevationDegrees * Math.PI) / 180;
  return [Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation), -Math.cos(azimuth) * Math.cos(elevation)];
}

/** Between the two entries of the pack's daylight about the sun's elevation. */
export function daylightUnder(pack: RuntimePack, elevationDegrees: number): Daylight {
  let above = 1;
  while (above + 1 < pack.daylightLength() && pack.daylight(above)!.elevationDegrees() < elevationDegrees) ++above;
  const a = pack.daylight(above - 1)!;
  const b = pack.daylight(above)!;
  const share = clamp((elevationDegrees - a.elevationDegrees()) / (b.elevationDegrees() - a.elevationDegrees()), 0, 1);
  const heights = pack.sunHeightsLength();
  const between = (from: PackVec3, to: PackVec3): Vec3 => mixed(vec3(from), vec3(to), share);
  return {
    zenith: between(a.zenith()!, b.zenith()!),
    horizon: between(a.horizon()!, b.horizon()!),
    ground: between(a.ground()!, b.ground()!),
    ambient: between(a.ambient()!, b.ambient()!),
    bounce: between(a.bounce()!, b.bounce()!),
    suns: Array.from({length: heights}, (_, h) => between(pack.sunColors((above - 1) * heights + h)!, pack.sunColors(above * heights + h)!)),
  };
}
