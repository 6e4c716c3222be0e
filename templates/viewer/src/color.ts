// SPDX-License-Identifier: Apache-2.0
import type {Vec3} from './math';

/** The sRGB curve. The page draws in display values from end to end, because puffs blend in them. */
export function displayValue(linear: number): number {
  const value = Math.min(1, Math.max(0, linear));
  return value <= 0.0031308 ? 12.92 * value : 1.055 * Math.pow(value, 1 / 2.4) - 0.055;
}

export function linearValue(display: number): number {
  return display <= 0.04045 ? display / 12.92 : Math.pow((display + 0.055) / 1.055, 2.4);
}

export function displayColor(linear: Vec3): Vec3 {
  return [displayValue(linear[0]), displayValue(linear[1]), displayValue(linear[2])];
}
