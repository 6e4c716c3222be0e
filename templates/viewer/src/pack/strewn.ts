// SPDX-License-Identifier: Apache-2.0
import type {PackView} from './pack_view';
import type {CloudSet} from './selection';

/** Puffs of a cloud that stand for it where detail does not matter: at least so many, if it has them. */
const ENOUGH_PUFFS = 6;

/**
 * Calls back with the centre in metres of the scene (true heights), the deviation and the optical depth of coarse puffs of every
 * cloud that is shown. The deviation is that of the circle with the area of the puff seen from above.
 */
export function eachCoarsePuff(
  pack: PackView,
  set: CloudSet,
  visit: (x: number, y: number, z: number, deviationMeters: number, opticalDepth: number, cloud: number) => void,
): void {
  const {clouds} = set;
  const chosen = pack.archetypes.map(({levels}) => [...levels].reverse().find((level) => level.count >= ENOUGH_PUFFS) ?? levels[0]);
  const flat = (p: number) => {
    const [xx, xz, zz] = [pack.covariances[6 * p], pack.covariances[6 * p + 2], pack.covariances[6 * p + 5]];
    return Math.pow(Math.max(0, xx * zz - xz * xz), 0.25);
  };
  for (let i = 0; i < clouds.count; ++i) {
    if (set.hidden[i] || clouds.factor(i) <= 0) continue;
    const {first, count} = chosen[clouds.archetype(i)];
    const scale = clouds.scale(i);
    const turn = (2 * Math.PI * clouds.yawStep(i)) / 16;
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    for (let p = first; p < first + count; ++p) {
      const [px, py, pz] = [pack.centers[3 * p], pack.centers[3 * p + 1], pack.centers[3 * p + 2]];
      visit(
        clouds.floats[6 * i] + scale * (c * px + s * pz),
        clouds.floats[6 * i + 1] + scale * py,
        clouds.floats[6 * i + 2] + scale * (c * pz - s * px),
        scale * flat(p),
        pack.opticalDepths[p] * clouds.factor(i),
        i,
      );
    }
  }
}
