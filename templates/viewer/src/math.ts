// SPDX-License-Identifier: Apache-2.0

/** Metres, or a direction: x east, y up, z south. */
export type Vec3 = [number, number, number];

export const UP: Vec3 = [0, 1, 0];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
/** a + s b */
export const along = (a: Vec3, s: number, b: Vec3): Vec3 => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const distance = (a: Vec3, b: Vec3): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
export const normalized = (a: Vec3): Vec3 => scale(a, 1 / Math.max(length(a), 1e-30));
export const mixed = (a: Vec3, b: Vec3, share: number): Vec3 => along(scale(a, 1 - share), share, b);

export const clamp = (value: number, least: number, most: number): number => Math.min(most, Math.max(least, value));

/** 0 below `low`, 1 above `high`, straight between. */
export const ramp = (low: number, high: number, value: number): number => clamp((value - low) / (high - low), 0, 1);

/** The same with soft ends; falling where `from` is above `to`. */
export function smoothStep(from: number, to: number, value: number): number {
  const t = clamp((value - from) / (to - from), 0, 1);
  return t * t * (3 - 2 * t);
}

/** Counter-clockwise about y, seen from above. */
export function turnedAboutUp(v: Vec3, radians: number): Vec3 {
  const [c, s] = [Math.cos(radians), Math.sin(radians)];
  return [c * v[0] + s * v[2], v[1], c * v[2] - s * v[0]];
}

/** A unit vector: heading clockwise from -z, pitch upwards, both in radians. */
export function directionOf(heading: number, pitch: number): Vec3 {
  return [Math.sin(heading) * Math.cos(pitch), Math.sin(pitch), -Math.cos(heading) * Math.cos(pitch)];
}
