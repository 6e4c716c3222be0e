// SPDX-License-Identifier: Apache-2.0
import type {CloudExtent} from './cloud_extent';
import type {Frame} from './frame';
import {along, mixed, normalized, ramp, turnedAboutUp, UP, type Vec3} from './math';

export const VIEW_NAMES = ['overview', 'near', 'ground', 'top'] as const;
export type ViewName = (typeof VIEW_NAMES)[number];

export interface View {
  position: Vec3;
  target: Vec3;
}

/** Clouds are best seen from this far; a scene of a few hundred kilometres is entered at its middle. */
const NEAR_METERS = 22_000;
const OVERVIEW_METERS = 60_000;

const atHeight = (place: Vec3, y: number): Vec3 => [place[0], y, place[2]];

/**
 * The camera of a named view. `fieldOfView` is the smaller of the two opening angles, radians, so that a narrow
 * window sees as much as a wide one from farther away.
 */
export function viewNamed(name: ViewName, ground: number, sun: Vec3, frame: Frame, clouds: CloudExtent, fieldOfView: number): View {
  const [sunX, , sunZ] = sun;
  // The sun behind one shoulder shows lit and shaded sides.
  const looking = turnedAboutUp(normalized(Math.hypot(sunX, sunZ) < 1e-3 ? [0, 0, -1] : [-sunX, 0, -sunZ]), 0.7);
  const half = Math.tan(fieldOfView / 2);

  if (name === 'top') {
    const reach = 0.63 * frame.size;
    const target: Vec3 = [frame.centerX, ground, frame.centerZ];
    return {target, position: [frame.centerX, ground + reach / half, frame.centerZ + (reach / half) * 1e-3]};
  }
  if (name === 'ground') {
    const {heading, back} = observerPlace(clouds, looking);
    const position = atHeight(along(clouds.densest, -back, heading), ground + 30);
    return {position, target: atHeight(along(position, back, heading), ground + 0.25 * back)};
  }
  if (name === 'near') {
    const distance = Math.max(NEAR_METERS, 2.2 * (clouds.densestTop - ground), Math.min(25 * clouds.densestDeviation, 250_000));
    const target = atHeight(clouds.densest, ground + 0.5 * (clouds.densestTop - ground));
    return {target, position: from(target, looking, 0.2 + 0.2 * ramp(40_000, 400_000, distance), distance)};
  }
  const whole = (0.6 * clouds.spread) / half + 2 * clouds.top;
  const wide = ramp(150_000, 900_000, clouds.spread);
  const distance = whole < OVERVIEW_METERS ? whole : OVERVIEW_METERS + (whole - OVERVIEW_METERS) * wide;
  const target = atHeight(mixed(clouds.densest, clouds.center, Math.max(wide, ramp(80_000, 20_000, clouds.spread))), ground + 0.35 * clouds.top);
  // Over a wide scene from the south, as maps have it, and higher.
  const ahead = normalized(mixed(looking, [sunX > 0 ? -0.3 : 0.3, 0, -1], wide));
  return {target, position: from(target, ahead, 0.2 + 0.28 * wide, distance)};
}

/** Where an observer on the ground has the thickest clouds ahead and little overhead, the sun behind if possible. */
function observerPlace(clouds: CloudExtent, looking: Vec3): {heading: Vec3; back: number} {
  const nearest = Math.max(2.4 * clouds.densestTop, 10 * clouds.densestDeviation, 7_000);
  let best = {score: Infinity, heading: looking, back: nearest};
  for (let turn = -6; turn <= 6; ++turn)
    for (const factor of [1, 1.6, 2.5, 4]) {
      const heading = turnedAboutUp(looking, (turn * Math.PI) / 6);
      const place = along(clouds.densest, -factor * nearest, heading);
      const score = 3 * clouds.cover(place[0], place[2]) + 0.06 * Math.abs(turn) + 0.25 * factor;
      if (score < best.score) best = {score, heading, back: factor * nearest};
    }
  return best;
}

function from(target: Vec3, looking: Vec3, pitch: number, distance: number): Vec3 {
  return along(along(target, -Math.cos(pitch) * distance, looking), Math.sin(pitch) * distance, UP);
}
