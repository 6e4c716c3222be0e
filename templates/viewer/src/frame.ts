// SPDX-License-Identifier: Apache-2.0
import proj4, {type Converter} from 'proj4';
import type {SceneData} from './scene_data';

/** The scene's horizontal mapping, by PROJ's own definition of it: longitude, latitude <-> metres east and south. */
export class Frame {
  readonly width: number;
  readonly depth: number;
  readonly centerX: number;
  readonly centerZ: number;
  readonly longitudeSpan: number;
  private readonly mapping: Converter;
  private readonly origin: number[];

  constructor(private readonly data: SceneData) {
    const {lower, upper, definition} = data.frame;
    const {box} = data;
    // PROJ takes missing false eastings as zero, proj4js as not-a-number.
    this.mapping = proj4(`${definition} +x_0=0 +y_0=0`);
    this.origin = this.mapping.forward([box.west, box.south]);
    this.width = upper[0] - lower[0];
    this.depth = upper[1] - lower[1];
    this.centerX = 0.5 * (lower[0] + upper[0]);
    this.centerZ = 0.5 * (lower[1] + upper[1]);
    this.longitudeSpan = box.east > box.west ? box.east - box.west : box.east - box.west + 360;
  }

  /** The larger side of the scene, metres. */
  get size(): number {
    return Math.max(this.width, this.depth);
  }

  get box() {
    return this.data.box;
  }

  /** [x, z] in metres. */
  toScene(longitude: number, latitude: number): [number, number] {
    const [east, north] = this.mapping.forward([longitude, latitude]);
    return [east - this.origin[0], -(north - this.origin[1])];
  }

  /** [longitude, latitude] in degrees; null off the map. */
  toGeographic(x: number, z: number): [number, number] | null {
    const [longitude, latitude] = this.mapping.inverse([x + this.origin[0], this.origin[1] - z]);
    return Number.isFinite(longitude) && Number.isFinite(latitude) ? [longitude, latitude] : null;
  }

  /** Azimuth of true north at a place, radians clockwise from the scene's -z axis; it turns away from the centre. */
  northAt(x: number, z: number): number {
    const place = this.toGeographic(x, z);
    if (!place) return 0;
    const [x1, z1] = this.toScene(place[0], Math.min(89.99, place[1] + 0.01));
    return Math.atan2(x1 - x, z - z1);
  }
}

/** "36.60° N, 122.10° W", with as many decimals as a pixel of the given size is worth. */
export function placeText(longitude: number, latitude: number, metersPerPixel = 100): string {
  const decimals = metersPerPixel > 2000 ? 1 : metersPerPixel > 100 ? 2 : 3;
  const wrapped = ((((longitude + 180) % 360) + 360) % 360) - 180;
  const side = (value: number, positive: string, negative: string) =>
    `${Math.abs(value).toFixed(decimals)}° ${value < 0 ? negative : positive}`;
  return `${side(latitude, 'N', 'S')}, ${side(wrapped, 'E', 'W')}`;
}
