// SPDX-License-Identifier: Apache-2.0
import {along, type Vec3} from '../math';
import type {PackView} from './pack_view';
import type {CloudSet} from './selection';

/** A cloud that hides this share of what is behind it has been hit; of fainter ones the most opaque, down to the second. */
const HIT = 0.3;
const FAINTEST = 0.03;

export interface Picked {
  cloud: number;
  distanceMeters: number;
}

/** The cloud that one sees along a ray: a unit vector from a place in drawn metres. */
export function cloudAlong(pack: PackView, set: CloudSet, eye: Vec3, ray: Vec3): Picked | null {
  const {clouds, exaggeration: e} = set;
  let best: Picked | null = null;
  let faint: (Picked & {alpha: number}) | null = null;
  for (let i = 0; i < clouds.count; ++i) {
    if (set.hidden[i] || clouds.factor(i) <= 0) continue;
    const info = pack.archetypes[clouds.archetype(i)];
    const scale = clouds.scale(i);
    const radius = e * info.radiusMeters * scale;
    const middle: Vec3 = [clouds.floats[6 * i], e * (clouds.floats[6 * i + 1] + info.middleMeters * scale), clouds.floats[6 * i + 2]];
    const to = [middle[0] - eye[0], middle[1] - eye[1], middle[2] - eye[2]];
    const ahead = to[0] * ray[0] + to[1] * ray[1] + to[2] * ray[2];
    if (ahead < -radius) continue;
    const nearest = along(eye, ahead, ray);
    if (Math.hypot(nearest[0] - middle[0], nearest[1] - middle[1], nearest[2] - middle[2]) > radius) continue;
    if (best && ahead - radius > best.distanceMeters) continue;
    const hit = alphaAlong(pack, set, i, eye, ray);
    if (hit.alpha >= HIT && (!best || hit.distanceMeters < best.distanceMeters)) best = {cloud: i, distanceMeters: hit.distanceMeters};
    if (hit.alpha >= FAINTEST && (!faint || hit.alpha > faint.alpha)) faint = {cloud: i, ...hit};
  }
  return best ?? (faint && {cloud: faint.cloud, distanceMeters: faint.distanceMeters});
}

/** What one cloud hides along a ray, and how far away the most opaque part of it is. */
function alphaAlong(pack: PackView, set: CloudSet, cloud: number, eye: Vec3, ray: Vec3): {alpha: number; distanceMeters: number} {
  const {clouds, exaggeration: e} = set;
  const scale = clouds.scale(cloud);
  const turn = (2 * Math.PI * clouds.yawStep(cloud)) / 16;
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  // The ray in the axes of the archetype, where covariances stand as they are; lengths along it stay those of the world.
  const local = (v: Vec3): Vec3 => [(c * v[0] - s * v[2]) / scale, v[1] / (e * scale), (c * v[2] + s * v[0]) / scale];
  const from = local([eye[0] - clouds.floats[6 * cloud], eye[1] - e * clouds.floats[6 * cloud + 1], eye[2] - clouds.floats[6 * cloud + 2]]);
  const way = local(ray);
  const {first, count} = pack.archetypes[clouds.archetype(cloud)].levels[0];
  let through = 1;
  let most = 0;
  let distanceMeters = Infinity;
  for (let p = first; p < first + count; ++p) {
    const k = 6 * p;
    const [xx, xy, xz, yy, yz, zz] = pack.covariances.subarray(k, k + 6);
    // The inverse of the covariance by its cofactors.
    const [ixx, ixy, ixz] = [yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy];
    const [iyy, iyz, izz] = [xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy];
    const determinant = xx * ixx + xy * ixy + xz * ixz;
    if (!(determinant > 0)) continue;
    const form = (a: Vec3, b: Vec3) =>
      (a[0] * (ixx * b[0] + ixy * b[1] + ixz * b[2]) + a[1] * (ixy * b[0] + iyy * b[1] + iyz * b[2]) + a[2] * (ixz * b[0] + iyz * b[1] + izz * b[2])) / determinant;
    const to: Vec3 = [pack.centers[3 * p] - from[0], pack.centers[3 * p + 1] - from[1], pack.centers[3 * p + 2] - from[2]];
    const [tt, tw, ww] = [form(to, to), form(to, way), form(way, way)];
    const closest = tw / ww;
    if (closest <= 0) continue;
    const alpha = (1 - Math.exp(-pack.opticalDepths[p] * clouds.factor(cloud))) * Math.exp(-0.5 * Math.max(0, tt - tw * closest));
    through *= 1 - alpha;
    if (alpha > most) {
      most = alpha;
      distanceMeters = closest;
    }
  }
  return {alpha: 1 - through, distanceMeters};
}
