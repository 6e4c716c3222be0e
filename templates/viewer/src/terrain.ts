// SPDX-License-Identifier: Apache-2.0
import {BufferAttribute, BufferGeometry} from 'three/webgpu';
import {displayValue} from './color';
import type {SceneData, TerrainData} from './scene_data';

/** The model's ground: heights on a regular lattice of the scene, above the scene's lowest ground. */
export class Terrain {
  private readonly data: TerrainData | null;
  private readonly lowest: number;

  constructor(private readonly scene: SceneData) {
    this.data = scene.terrain ?? null;
    this.lowest = scene.groundHeightMeters;
  }

  get exists(): boolean {
    return this.data !== null;
  }

  /** Metres above the lowest ground, bilinear; 0 beyond the lattice. */
  rise(x: number, z: number): number {
    if (!this.data) return 0;
    const {columns, rows, origin, step} = this.data;
    const u = (x - origin[0]) / step[0];
    const v = (z - origin[1]) / step[1];
    if (!(u >= 0 && v >= 0 && u <= columns - 1 && v <= rows - 1)) return 0;
    const column = Math.min(Math.floor(u), columns - 2);
    const row = Math.min(Math.floor(v), rows - 2);
    const [a, b] = [u - column, v - row];
    const north = (1 - a) * this.at(column, row) + a * this.at(column + 1, row);
    const south = (1 - a) * this.at(column, row + 1) + a * this.at(column + 1, row + 1);
    return (1 - b) * north + b * south;
  }

  /** The lattice as a mesh with heights above the lowest ground; `relief` is the colour of each point, for display. */
  geometry(): BufferGeometry {
    const {columns, rows, origin, step} = this.data!;
    const positions: number[] = [];
    const relief: number[] = [];
    const corners: number[] = [];
    for (let row = 0; row < rows; ++row)
      for (let column = 0; column < columns; ++column) {
        positions.push(origin[0] + column * step[0], this.at(column, row), origin[1] + row * step[1]);
        relief.push(...this.relief(column, row));
        if (row + 1 === rows || column + 1 === columns) continue;
        const first = row * columns + column;
        corners.push(first, first + columns, first + columns + 1, first, first + columns + 1, first + 1);
      }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute('relief', new BufferAttribute(new Float32Array(relief), 3));
    geometry.setIndex(corners);
    return geometry;
  }

  private at(column: number, row: number): number {
    return this.data!.heights[row * this.data!.columns + column] - this.lowest;
  }

  /** As the other formats draw it: lighter with height, shaded by slopes that are drawn steeper than they are. */
  private relief(column: number, row: number): number[] {
    const {columns, rows, step} = this.data!;
    const [west, east] = [Math.max(column - 1, 0), Math.min(column + 1, columns - 1)];
    const [north, south] = [Math.max(row - 1, 0), Math.min(row + 1, rows - 1)];
    const steeper = Math.min(12, Math.max(1, Math.max(...step) / 2500));
    const slopeX = (steeper * (this.at(east, row) - this.at(west, row))) / ((east - west) * step[0]);
    const slopeZ = (steeper * (this.at(column, south) - this.at(column, north))) / ((south - north) * step[1]);
    const [sunX, sunY, sunZ] = this.scene.sun.direction;
    const facing = (sunY - slopeX * sunX - slopeZ * sunZ) / Math.hypot(slopeX, 1, slopeZ);
    const lit = Math.min(1.8, Math.max(0, facing / Math.max(sunY, 0.15)));
    const t = Math.min(1, Math.max(0, (this.at(column, row) + this.lowest - 200) / 4300));
    const high = t * t * (3 - 2 * t);
    return [2.3, 1.6, 1.75].map((tint, i) => displayValue(this.scene.sky.ground[i] * (1 + high * (tint - 1)) * (0.45 + 0.55 * lit)));
  }
}
