// SPDX-License-Identifier: Apache-2.0
import {Vector3} from 'three/webgpu';
import type {Frame} from './frame';
import type {SceneData} from './scene_data';
import type {Splats} from './splats';

export const VIEW_NAMES = ['overview', 'ground', 'top'] as const;
export type ViewName = (typeof VIEW_NAMES)[number];

export interface View {
  position: Vector3;
  target: Vector3;
}

/** Where the clouds stand: the middle 80 % of the splats in each direction. */
export interface CloudExtent {
  center: Vector3;
  spread: number;
  top: number;
}

export function cloudExtent(splats: Splats, frame: Frame): CloudExtent {
  const xs: number[] = [];
  const ys: number[] = [];
  const zs: number[] = [];
  const stride = Math.max(1, Math.floor(splats.count / 20_000));
  let index = 0;
  splats.forEach((center) => {
    if (index++ % stride) return;
    xs.push(center.x);
    ys.push(center.y);
    zs.push(center.z);
  });
  if (!xs.length) return {center: new Vector3(frame.centerX, 1500, frame.centerZ), spread: frame.size, top: 3000};
  for (const values of [xs, ys, zs]) values.sort((a, b) => a - b);
  const share = (values: number[], part: number) => values[Math.min(values.length - 1, Math.floor(part * values.length))];
  const spread = Math.max(share(xs, 0.9) - share(xs, 0.1), share(zs, 0.9) - share(zs, 0.1), 4000);
  const middle = (values: number[]) => 0.5 * (share(values, 0.1) + share(values, 0.9));
  return {center: new Vector3(middle(xs), share(ys, 0.5), middle(zs)), spread, top: share(ys, 0.98)};
}

/**
 * The camera of a named view. `fieldOfView` is the smaller of the two opening angles, radians, so that a narrow
 * window sees as much as a wide one from farther away.
 */
export function viewNamed(name: ViewName, data: SceneData, frame: Frame, clouds: CloudExtent, fieldOfView: number): View {
  const ground = data.groundHeightMeters;
  const [sunX, , sunZ] = data.sun.direction;
  const sunAway = new Vector3(-sunX, 0, -sunZ);
  if (sunAway.lengthSq() < 1e-6) sunAway.set(0, 0, -1);
  sunAway.normalize();

  if (name === 'top') {
    const reach = 0.63 * Math.max(frame.width, frame.depth);
    const target = new Vector3(frame.centerX, ground, frame.centerZ);
    return {target, position: new Vector3(frame.centerX, ground + reach / Math.tan(fieldOfView / 2), frame.centerZ + reach * 1e-4)};
  }
  if (name === 'ground') {
    // An observer under the near edge of the clouds, the sun at one side, eyes on clouds that are not overhead.
    const looking = sunAway.clone().applyAxisAngle(new Vector3(0, 1, 0), 0.7);
    const back = Math.min(0.45 * clouds.spread, Math.max(4 * clouds.top, 12_000));
    const position = new Vector3(clouds.center.x, 0, clouds.center.z).addScaledVector(looking, -back).setY(ground + 30);
    const ahead = Math.max(3.2 * clouds.top, 8_000);
    return {position, target: position.clone().addScaledVector(looking, ahead).setY(ground + 0.23 * ahead)};
  }
  // From the south by habit of maps, lower over a small scene, where clouds have height, higher over a wide one.
  const wide = Math.min(1, Math.max(0, (clouds.spread - 40_000) / 400_000));
  const pitch = 0.22 + 0.45 * wide;
  const distance = (0.56 * clouds.spread) / Math.tan(fieldOfView / 2) + 2 * clouds.top;
  const target = new Vector3(clouds.center.x, ground + 0.35 * clouds.top, clouds.center.z);
  const side = sunX > 0 ? 0.35 : -0.35;
  const position = target
    .clone()
    .add(new Vector3(Math.sin(side) * Math.cos(pitch), Math.sin(pitch), Math.cos(side) * Math.cos(pitch)).multiplyScalar(distance));
  return {position, target};
}
