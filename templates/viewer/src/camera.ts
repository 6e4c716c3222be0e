// SPDX-License-Identifier: Apache-2.0
import {add, cross, dot, normalized, scale, UP, type Vec3} from './math';

/** Where one looks from, and where to. */
export interface Camera {
  eye: Vec3;
  /** A unit vector. */
  forward: Vec3;
  /** Need not be at right angles to it. */
  up: Vec3;
  fieldRadians: number;
  widthPixels: number;
  heightPixels: number;
}

export const FAR_METERS = 20_000_000;

/** Pixels that a metre across spans at a metre's distance. */
export function focalPixels(camera: Camera): number {
  return (0.5 * camera.heightPixels) / Math.tan(0.5 * camera.fieldRadians);
}

export interface Axes {
  right: Vec3;
  up: Vec3;
  forward: Vec3;
}

export function axesOf(camera: Camera): Axes {
  const right = normalized(cross(camera.forward, Math.abs(dot(camera.forward, camera.up)) > 0.99999 ? [0, 0, -1] : camera.up));
  return {right, up: cross(right, camera.forward), forward: camera.forward};
}

/** Column-major world-to-clip matrix of a perspective without end: depth runs from -1 at `near` to 1 at infinity. */
export function clipMatrix(camera: Camera, near: number): Float32Array {
  const {right, up, forward} = axesOf(camera);
  const fy = 1 / Math.tan(0.5 * camera.fieldRadians);
  const fx = (fy * camera.heightPixels) / camera.widthPixels;
  const {eye} = camera;
  const row = (v: Vec3, s: number) => [v[0] * s, v[1] * s, v[2] * s, -dot(v, eye) * s];
  const x = row(right, fx);
  const y = row(up, fy);
  const w = row(forward, 1);
  const z = [w[0], w[1], w[2], w[3] - 2 * near];
  const m = new Float32Array(16);
  [x, y, z, w].forEach((r, i) => r.forEach((value, j) => (m[4 * j + i] = value)));
  return m;
}

/** The place on the screen, in 0..1 from the upper left, and the depth along the view; null behind the eye. */
export function projected(camera: Camera, place: Vec3): {u: number; v: number; depth: number} | null {
  const {right, up, forward} = axesOf(camera);
  const away: Vec3 = [place[0] - camera.eye[0], place[1] - camera.eye[1], place[2] - camera.eye[2]];
  const depth = dot(away, forward);
  if (depth <= 1e-3) return null;
  const focal = focalPixels(camera);
  return {
    u: 0.5 + (focal * dot(away, right)) / depth / camera.widthPixels,
    v: 0.5 - (focal * dot(away, up)) / depth / camera.heightPixels,
    depth,
  };
}

/** The ray through a place of the screen in 0..1 from the upper left; a unit vector. */
export function rayThrough(camera: Camera, u: number, v: number): Vec3 {
  const {right, up, forward} = axesOf(camera);
  const focal = focalPixels(camera);
  const x = ((u - 0.5) * camera.widthPixels) / focal;
  const y = ((0.5 - v) * camera.heightPixels) / focal;
  return normalized(add(forward, add(scale(right, x), scale(up, y))));
}

export const OUTSIDE = 0;
export const ACROSS = 1;
export const INSIDE = 2;

/** What a camera may see, each side turned outwards by an angle and moved outwards by a length. */
export class Frustum {
  /** Normal inwards and offset, six times. */
  private readonly planes: Float64Array;

  constructor(camera: Camera, marginRadians: number, marginMeters: number) {
    const {right, up, forward} = axesOf(camera);
    const halfWidth = Math.atan((0.5 * camera.widthPixels) / focalPixels(camera));
    const halfHeight = 0.5 * camera.fieldRadians;
    const quarter = Math.PI / 2;
    const planes: number[] = [];
    const side = (across: Vec3, half: number) => {
      // A wedge of more than half a turn keeps nothing out.
      const angle = Math.min(half + marginRadians, quarter);
      const normal = add(scale(forward, Math.sin(angle)), scale(across, Math.cos(angle)));
      planes.push(...normal, marginMeters - dot(normal, camera.eye));
    };
    side(right, halfWidth);
    side(scale(right, -1), halfWidth);
    side(up, halfHeight);
    side(scale(up, -1), halfHeight);
    const reach = FAR_METERS + marginMeters;
    planes.push(...forward, marginMeters + reach * Math.sin(Math.min(marginRadians, quarter)) - dot(forward, camera.eye));
    planes.push(...scale(forward, -1), reach + dot(forward, camera.eye));
    this.planes = Float64Array.from(planes);
  }

  sideOfBox(lx: number, ly: number, lz: number, ux: number, uy: number, uz: number): number {
    const p = this.planes;
    let inside = true;
    for (let i = 0; i < 24; i += 4) {
      const away = 0.5 * (p[i] * (lx + ux) + p[i + 1] * (ly + uy) + p[i + 2] * (lz + uz)) + p[i + 3];
      const reach = 0.5 * (Math.abs(p[i]) * (ux - lx) + Math.abs(p[i + 1]) * (uy - ly) + Math.abs(p[i + 2]) * (uz - lz));
      if (away < -reach) return OUTSIDE;
      if (away < reach) inside = false;
    }
    return inside ? INSIDE : ACROSS;
  }

  meetsSphere(x: number, y: number, z: number, radius: number): boolean {
    const p = this.planes;
    for (let i = 0; i < 24; i += 4) if (p[i] * x + p[i + 1] * y + p[i + 2] * z + p[i + 3] < -radius) return false;
    return true;
  }
}

export const looking = (eye: Vec3, forward: Vec3, fieldRadians: number, widthPixels: number, heightPixels: number): Camera => ({
  eye,
  forward,
  up: UP,
  fieldRadians,
  widthPixels,
  heightPixels,
});
