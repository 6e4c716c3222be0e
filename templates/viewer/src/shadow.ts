// SPDX-License-Identifier: Apache-2.0
import {DataTexture, LinearFilter, RedFormat, UnsignedByteType, type Vector3} from 'three/webgpu';
import type {Frame} from './frame';
import type {Splats} from './splats';

const FINEST_CELLS = 512;
const LEVELS = 5;
/** The kernel reaches two cells to each side. */
const REACH = 2;

interface Level {
  cells: number;
  cellX: number;
  cellZ: number;
  opticalDepth: Float32Array;
}

/**
 * The share of sunlight that reaches the ground under the clouds, as a texture over the scene's rectangle
 * (u east, v south). Every splat is thrown along the sun's direction to the ground, on the level whose cells
 * are as wide as the splat; the levels are then added.
 */
export function groundSunlight(splats: Splats, frame: Frame, lower: [number, number], sun: Vector3, groundMeters: number): DataTexture {
  const levels: Level[] = [];
  for (let i = 0, cells = FINEST_CELLS; i < LEVELS; ++i, cells /= 2)
    levels.push({cells, cellX: frame.width / cells, cellZ: frame.depth / cells, opticalDepth: new Float32Array(cells * cells)});

  // A sun below this height would throw shadows out of the scene.
  const slope = Math.max(sun.y, 0.12);
  splats.forEach((center, deviation, opacity) => {
    const fall = (center.y - groundMeters) / slope;
    const x = center.x - sun.x * fall - lower[0];
    const z = center.z - sun.z * fall - lower[1];
    const wanted = Math.round(Math.log2(Math.max(deviation, 1) / levels[0].cellX));
    addSplat(levels[Math.min(LEVELS - 1, Math.max(0, wanted))], x, z, deviation, opacity);
  });

  const light = new Uint8Array(FINEST_CELLS * FINEST_CELLS);
  for (let row = 0; row < FINEST_CELLS; ++row)
    for (let column = 0; column < FINEST_CELLS; ++column) {
      let depth = 0;
      for (const level of levels) depth += sampled(level, (column + 0.5) / FINEST_CELLS, (row + 0.5) / FINEST_CELLS);
      // Clouds scatter most light forward, so less is lost than their optical depth says.
      light[row * FINEST_CELLS + column] = Math.round(255 * Math.exp(-0.2 * depth));
    }
  const texture = new DataTexture(light, FINEST_CELLS, FINEST_CELLS, RedFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

function addSplat(level: Level, x: number, z: number, deviation: number, opacity: number): void {
  const throughCenter = -Math.log(1 - Math.min(opacity, 0.995));
  const mass = (throughCenter * 2 * Math.PI * deviation * deviation) / (level.cellX * level.cellZ);
  const sigmaX = Math.max(deviation / level.cellX, 0.5);
  const sigmaZ = Math.max(deviation / level.cellZ, 0.5);
  const column = x / level.cellX - 0.5;
  const row = z / level.cellZ - 0.5;
  const firstColumn = Math.round(column) - REACH;
  const firstRow = Math.round(row) - REACH;
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
      if (c >= 0 && r >= 0 && c < level.cells && r < level.cells) level.opticalDepth[r * level.cells + c] += (mass * weights[at]) / sum;
    }
}

function sampled(level: Level, u: number, v: number): number {
  const {cells, opticalDepth} = level;
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
