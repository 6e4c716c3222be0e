// SPDX-License-Identifier: Apache-2.0
import {Vector3} from 'three/webgpu';
import type {CloudExtent} from './cloud_extent';
import type {Frame} from './frame';
import type {SceneData} from './scene_data';

export const VIEW_NAMES = ['overview', 'near', 'ground', 'top'] as const;
export type ViewName = (typeof VIEW_NAMES)[number];

export interface View {
  position: Vector3;
  target: Vector3;
}

const UP = new Vector3(0, 1, 0);
/** Clouds are best seen from this far; a scene of a few hundred kilometres is entered at its middle. */
const NEAR_METERS = 22_000;
const OVERVIEW_METERS = 60_000;

/** 0 below `low`, 1 above `high`. */
function ramp(low: number, high: number, value: number): number {
  return Math.min(1, Math.max(0, (value - low) / (high - low)));
}

/**
 * The camera of a named view. `fieldOfView` is the smaller of the two opening angles, radians, so that a narrow
 * window sees as much as a wide one from farther away.
 */
export function viewNamed(name: ViewName, data: SceneData, frame: Frame, clouds: CloudExtent, fieldOfView: number): View {
  const ground = data.groundHeightMeters;
  const [sunX, , sunZ] = data.sun.direction;
  const looking = new Vector3(-sunX, 0, -sunZ);
  if (looking.lengthSq() < 1e-6) looking.set(0, 0, -1);
  // The sun behind one shoulder shows lit and shaded sides.
  looking.normalize().applyAxisAngle(UP, 0.7);
  const half = Math.tan(fieldOfView / 2);

  if (name === 'top') {
    const reach = 0.63 * frame.size;
    const target = new Vector3(frame.centerX, ground, frame.centerZ);
    return {target, position: new Vector3(frame.centerX, ground + reach / half, frame.centerZ + reach * 1e-4)};
  }
  if (name === 'ground') {
    const {heading, back} = observerPlace(clouds, looking);
    const position = clouds.densest.clone().addScaledVector(heading, -back).setY(ground + 30);
    return {position, target: position.clone().addScaledVector(heading, back).setY(ground + 0.25 * back)};
  }
  if (name === 'near') {
    const distance = Math.max(NEAR_METERS, 2.2 * (clouds.densestTop - ground), Math.min(25 * clouds.densestDeviation, 250_000));
    const target = clouds.densest.clone().setY(ground + 0.5 * (clouds.densestTop - ground));
    return {target, position: from(target, looking, 0.2 + 0.2 * ramp(40_000, 400_000, distance), distance)};
  }
  const whole = (0.6 * clouds.spread) / half + 2 * clouds.top;
  const wide = ramp(150_000, 900_000, clouds.spread);
  const distance = whole < OVERVIEW_METERS ? whole : OVERVIEW_METERS + (whole - OVERVIEW_METERS) * wide;
  const target = clouds.densest.clone().lerp(clouds.center, Math.max(wide, ramp(80_000, 20_000, clouds.spread)));
  target.y = ground + 0.35 * clouds.top;
  // Over a wide scene from the south, as maps have it, and higher.
  const ahead = looking.lerp(new Vector3(sunX > 0 ? -0.3 : 0.3, 0, -1), wide).normalize();
  return {target, position: from(target, ahead, 0.2 + 0.28 * wide, distance)};
}

/** Where an observer on the ground has the thickest clouds ahead and little overhead, the sun behind if possible. */
function observerPlace(clouds: CloudExtent, looking: Vector3): {heading: Vector3; back: number} {
  const nearest = Math.max(2.4 * clouds.densestTop, 10 * clouds.densestDeviation, 7_000);
  let best = {score: Infinity, heading: looking, back: nearest};
  for (let turn = -6; turn <= 6; ++turn)
    for (const factor of [1, 1.6, 2.5, 4]) {
      const heading = looking.clone().applyAxisAngle(UP, (turn * Math.PI) / 6);
      const place = clouds.densest.clone().addScaledVector(heading, -factor * nearest);
      const score = 3 * clouds.cover(place.x, place.z) + 0.06 * Math.abs(turn) + 0.25 * factor;
      if (score < best.score) best = {score, heading, back: factor * nearest};
    }
  return best;
}

function from(target: Vector3, looking: Vector3, pitch: number, distance: number): Vector3 {
  return target
    .clone()
    .addScaledVector(looking, -Math.cos(pitch) * distance)
    .addScaledVector(UP, Math.sin(pitch) * distance);
}
