// SPDX-License-Identifier: Apache-2.0
import type {Vec3} from '../math';
import type {PackView} from './pack_view';
import type {CloudSet} from './selection';
import {eachCoarsePuff} from './strewn';

export const SHADOW_CELLS = 512;
const LEVELS = 5;
/** The kernel reaches two cells to each side. */
const REACH = 2;

export interface Area {
  /** Lower corner, metres east and south. */
  lower: [number, number];
  width: number;
  depth: number;
  groundMeters: number;
}

interface Grid {
  cells: number;
  cellX: number;
  cellZ: number;
  opticalDepth: Float32Array;
}

/**
 * The share of sunlight, 0..255, that reaches the ground under the clouds, row by row over an area of SHADOW_CELLS squared. Every
 * puff is thrown along the sun's direction to the ground, on the grid whose cells are as wide as the puff; the grids are then added.
 */
export function groundSunlight(pack: PackView, set: CloudSet, area: Area, sun: Vec3): Uint8Array<ArrayBuffer> {
  const grids: Grid[] = [];
  for (let i = 0, cells = SHADOW_CELLS; i < LEVELS; ++i, cells /= 2)
    grids.push({cells, cellX: area.width / cells, cellZ: area.depth / cells, opticalDepth: new Float32Array(cells * cells)});

  // A sun below this height would throw shadows out of the scene.
  const slope = Math.max(sun[1], 0.12);
  eachCoarsePuff(pack, set, (x, y, z, deviation, opticalDepth) => {
    const fall = (y - area.groundMeters) / slope;
    const wanted = Math.round(Math.log2(Math.max(deviation, 1) / grids[0].cellX));
    const grid = grids[Math.min(LEVELS - 1, Math.max(0, wanted))];
    addPuff(grid, x - sun[0] * fall - area.lower[0], z - sun[2] * fall - area.lower[1], deviation, Math.min(opticalDepth, 5.3));
  });

  const light = new Uint8Array(SHADOW_CELLS * SHADOW_CELLS);
  for (let row = 0; row < SHADOW_CELLS; ++row)
    for (let column = 0; column < SHADOW_CELLS; ++column) {
      let depth = 0;
      for (const grid of grids) depth += sampled(grid, (column + 0.5) / SHADOW_CELLS, (row + 0.5) / SHADOW_CELLS);
      // Clouds scatter most light forward, so less is lost than their optical depth says.
      light[row * SHADOW_CELLS + column] = Math.round(255 * Math.exp(-0.2 * depth));
    }
  return light;
}

function addPuff(grid: Grid, x: number, z: number, deviation: number, throughCenter: number): void {
  const mass = (throughCenter * 2 * Math.PI * deviation * deviation) / (grid.cellX * grid.cellZ);
  const sigmaX = Math.max(deviation / grid.cellX, 0.5);
  const sigmaZ = Math.max(deviation / grid.cellZ, 0.5);
  const column = x / grid.cellX - 0.5;
  const row = z / grid.cellZ - 0.5;
  const firstColumn = Math.round(column) - REACH;
  const firstRow = Math.round(row) - REACH;
  if (firstColumn + 2 * REACH < 0 || firstRow + 2 * REACH < 0 || firstColumn >= grid.cells || firstRow >= grid.cells) return;
  const weights: number[] = [];
  let sum = 0;
  for (let j = 0; j <= 2 * REACH; ++j)
    for (let i = 0; i <= 2 * REACH; ++i) {
      const dx = (firstColumn + i - column) / sigmaX;
      const dz = (firstRow + j - row) / sigmaZ;
      sum += weights[weights.push(Math.exp(-0.5 * (dx * dx + dz * dz))) - 1];
    }
  for (let j = 0, at = 0; j <= 2 * REACH; ++j)
    for (let i = 0; i <= 2 * REACH; ++i, ++at) {
      const c = firstColumn + i;
      const r = firstRow + j;
      if (c >= 0 && r >= 0 && c < grid.cells && r < grid.cells) grid.opticalDepth[r * grid.cells + c] += (mass * weights[at]) / sum;
    }
}

function sampled(grid: Grid, u: number, v: number): number {
  const {cells, opticalDepth} = grid;
  const x = Math.min(cells - 1, Math.max(0, u * cells - 0.5));
  const y = Math.min(cells - 1, Math.max(0, v * cells - 0.5));
  const column = Math.min(cells - 2, Math.floor(x));
  const row = Math.min(cells - 2, Math.floor(y));
  const a = x - column;
  const b = y - row;
  const at = row * cells + column;
  return (
    (1 - b) * ((1 - a) * opticalDepth[at] + a * opticalDepth[at + 1]) +
    b * ((1 - a) * opticalDepth[at + cells] + a * opticalDepth[at + cells + 1])
  );
}
