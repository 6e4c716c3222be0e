// SPDX-License-Identifier: Apache-2.0
import {Vector3} from 'three/webgpu';
import type {Frame} from './frame';
import type {Splats} from './splats';

/** Where clouds stand, metres. */
export interface CloudExtent {
  /** Middle and width of the middle 80 % of the splats. */
  center: Vector3;
  spread: number;
  /** Height below which 98 % of the splats are. */
  top: number;
  /** The place with most cloud, at its mean height, and the highest cloud there. */
  densest: Vector3;
  densestTop: number;
  /** Mean deviation of the splats there. */
  densestDeviation: number;
  /** Cloud over a place, as a share of that over the densest. */
  cover: (x: number, z: number) => number;
}

interface Cell {
  weight: number;
  sum: Vector3;
  top: number;
  deviation: number;
}

export function cloudExtent(splats: Splats, frame: Frame): CloudExtent {
  const xs: number[] = [];
  const ys: number[] = [];
  const zs: number[] = [];
  const cells = new Map<string, Cell>();
  const side = Math.max(8_000, frame.size / 100);
  const keyOf = (x: number, z: number) => `${Math.floor(x / side)} ${Math.floor(z / side)}`;
  splats.forEach((center, deviation, opacity) => {
    xs.push(center.x);
    ys.push(center.y);
    zs.push(center.z);
    const key = keyOf(center.x, center.z);
    const cell = cells.get(key) ?? {weight: 0, sum: new Vector3(), top: 0, deviation: 0};
    const weight = opacity * deviation * deviation;
    cell.weight += weight;
    cell.deviation += weight * deviation;
    cell.sum.addScaledVector(center, weight);
    if (opacity > 0.15) cell.top = Math.max(cell.top, center.y);
    cells.set(key, cell);
  });
  const middle = new Vector3(frame.centerX, 1500, frame.centerZ);
  if (!xs.length)
    return {center: middle, spread: frame.size, top: 3000, densest: middle.clone(), densestTop: 3000, densestDeviation: 500, cover: () => 0};

  // Of two places with as much cloud, the one nearer to the middle of the scene.
  let densest = {score: -1, cell: {weight: 1, sum: middle, top: 0, deviation: 0} as Cell};
  for (const cell of cells.values()) {
    const place = cell.sum.clone().divideScalar(Math.max(cell.weight, 1e-9));
    const away = Math.hypot(place.x - frame.centerX, place.z - frame.centerZ) / frame.size;
    const score = cell.weight * (1 - Math.min(0.9, away));
    if (score > densest.score) densest = {score, cell};
  }
  for (const values of [xs, ys, zs]) values.sort((a, b) => a - b);
  const share = (values: number[], part: number) => values[Math.min(values.length - 1, Math.floor(part * values.length))];
  const half = (values: number[]) => 0.5 * (share(values, 0.1) + share(values, 0.9));
  const place = densest.cell.sum.clone().divideScalar(Math.max(densest.cell.weight, 1e-9));
  return {
    center: new Vector3(half(xs), share(ys, 0.5), half(zs)),
    spread: Math.max(share(xs, 0.9) - share(xs, 0.1), share(zs, 0.9) - share(zs, 0.1), 4000),
    top: share(ys, 0.98),
    densest: place,
    densestTop: Math.max(densest.cell.top, place.y),
    densestDeviation: densest.cell.deviation / Math.max(densest.cell.weight, 1e-9),
    cover: (x, z) => (cells.get(keyOf(x, z))?.weight ?? 0) / Math.max(densest.cell.weight, 1e-9),
  };
}
