// SPDX-License-Identifier: Apache-2.0
import {Mesh, type GL} from './gl/gl';
import {ramp} from './math';
import type {SceneData, TerrainData} from './scene_data';

/** The model's ground: heights on a regular lattice of the scene, above the scene's lowest ground. */
export class Terrain {
  private readonly data: TerrainData | null;
  private readonly lowest: number;

  constructor(scene: Pick<SceneData, 'terrain' | 'groundHeightMeters'>) {
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

  /** The lattice as a mesh: place with the height above the lowest ground; slopes east and south, and how high it is, 0 to 1. */
  mesh(gl: GL): Mesh | null {
    if (!this.data) return null;
    const {columns, rows, origin, step} = this.data;
    const values: number[] = [];
    const corners: number[] = [];
    for (let row = 0; row < rows; ++row)
      for (let column = 0; column < columns; ++column) {
        values.push(origin[0] + column * step[0], this.at(column, row), origin[1] + row * step[1], ...this.relief(column, row));
        if (row + 1 === rows || column + 1 === columns) continue;
        const first = row * columns + column;
        corners.push(first, first + columns, first + columns + 1, first, first + columns + 1, first + 1);
      }
    return new Mesh(gl, values, [3, 3], corners);
  }

  private at(column: number, row: number): number {
    return this.data!.heights[row * this.data!.columns + column] - this.lowest;
  }

  /** Slopes are drawn steeper than they are where the lattice is coarse. */
  private relief(column: number, row: number): [number, number, number] {
    const {columns, rows, step} = this.data!;
    const [west, east] = [Math.max(column - 1, 0), Math.min(column + 1, columns - 1)];
    const [north, south] = [Math.max(row - 1, 0), Math.min(row + 1, rows - 1)];
    const steeper = Math.min(12, Math.max(1, Math.max(...step) / 2500));
    const slopeX = (steeper * (this.at(east, row) - this.at(west, row))) / ((east - west) * step[0]);
    const slopeZ = (steeper * (this.at(column, south) - this.at(column, north))) / ((south - north) * step[1]);
    const t = ramp(0, 4300, this.at(column, row) + this.lowest - 200);
    return [slopeX, slopeZ, t * t * (3 - 2 * t)];
  }
}
