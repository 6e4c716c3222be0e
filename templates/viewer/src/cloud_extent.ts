// SPDX-License-Identifier: Apache-2.0
import type {Frame} from './frame';
import {along, scale, type Vec3} from './math';
import type {PackView} from './pack/pack_view';
import {eachCoarsePuff} from './pack/strewn';

/** Where clouds stand, metres. */
export interface CloudExtent {
  /** Middle and width of the middle 80 % of the puffs. */
  center: Vec3;
  spread: number;
  /** Height below which 98 % of the puffs are. */
  top: number;
  /** The place with most cloud, at its mean height, and the highest cloud there. */
  densest: Vec3;
  densestTop: number;
  /** Mean deviation of the puffs there. */
  densestDeviation: number;
  /** Cloud over a place, as a share of that over the densest. */
  cover: (x: number, z: number) => number;
}

interface Cell {
  weight: number;
  sum: Vec3;
  top: number;
  deviation: number;
}

const placeOf = (cell: Cell): Vec3 => scale(cell.sum, 1 / Math.max(cell.weight, 1e-9));

export function cloudExtent(pack: PackView, frame: Frame): CloudExtent {
  const [xs, ys, zs]: number[][] = [[], [], []];
  const cells = new Map<number, Cell>();
  const side = Math.max(8_000, frame.size / 100);
  const keyOf = (x: number, z: number) => Math.floor(x / side) * 65536 + Math.floor(z / side);
  const all = {clouds: pack.clouds, velocities: new Float32Array(0), slackMeters: 0, hidden: new Uint8Array(pack.clouds.count), exaggeration: 1};
  eachCoarsePuff(pack, all, (x, y, z, deviation, opticalDepth) => {
    xs.push(x);
    ys.push(y);
    zs.push(z);
    const key = keyOf(x, z);
    let cell = cells.get(key);
    if (!cell) cells.set(key, (cell = {weight: 0, sum: [0, 0, 0], top: 0, deviation: 0}));
    const opacity = 1 - Math.exp(-opticalDepth);
    const weight = opacity * deviation * deviation;
    cell.weight += weight;
    cell.deviation += weight * deviation;
    cell.sum = along(cell.sum, weight, [x, y, z]);
    if (opacity > 0.15) cell.top = Math.max(cell.top, y);
  });
  const middle: Vec3 = [frame.centerX, 1500, frame.centerZ];
  if (!xs.length) return {center: middle, spread: frame.size, top: 3000, densest: middle, densestTop: 3000, densestDeviation: 500, cover: () => 0};

  // Of two places with as much cloud, the one nearer to the middle of the scene.
  let densest: Cell = {weight: 1, sum: middle, top: 0, deviation: 0};
  let most = -1;
  for (const cell of cells.values()) {
    const place = placeOf(cell);
    const away = Math.hypot(place[0] - frame.centerX, place[2] - frame.centerZ) / frame.size;
    const score = cell.weight * (1 - Math.min(0.9, away));
    if (score > most) [most, densest] = [score, cell];
  }
  for (const values of [xs, ys, zs]) values.sort((a, b) => a - b);
  const share = (values: number[], part: number) => values[Math.min(values.length - 1, Math.floor(part * values.length))];
  const half = (values: number[]) => 0.5 * (share(values, 0.1) + share(values, 0.9));
  const place = placeOf(densest);
  return {
    center: [half(xs), share(ys, 0.5), half(zs)],
    spread: Math.max(share(xs, 0.9) - share(xs, 0.1), share(zs, 0.9) - share(zs, 0.1), 4000),
    top: share(ys, 0.98),
    densest: place,
    densestTop: Math.max(densest.top, place[1]),
    densestDeviation: densest.deviation / Math.max(densest.weight, 1e-9),
    cover: (x, z) => (cells.get(keyOf(x, z))?.weight ?? 0) / Math.max(densest.weight, 1e-9),
  };
}
