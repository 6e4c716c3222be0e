// SPDX-License-Identifier: Apache-2.0
import {Vector3} from 'three/webgpu';
import type {Color} from './scene_data';

/** The sRGB curve. The page draws in display values from end to end, because splats blend in them. */
export function displayValue(linear: number): number {
  const value = Math.min(1, Math.max(0, linear));
  return value <= 0.0031308 ? 12.92 * value : 1.055 * Math.pow(value, 1 / 2.4) - 0.055;
}

export function displayColor(linear: Color): Vector3 {
  return new Vector3(displayValue(linear[0]), displayValue(linear[1]), displayValue(linear[2]));
}
