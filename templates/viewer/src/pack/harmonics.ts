// SPDX-License-Identifier: Apache-2.0
import type {Vec3} from '../math';

export const HARMONICS = 16;

/** Real spherical harmonics to degree 3 as schemas/runtime_pack.fbs orders them (Sloan 2008; y up). */
export function harmonicsOf(d: Vec3): number[] {
  const [x, y, z] = [d[0], d[2], d[1]];
  const [xx, yy, zz] = [x * x, y * y, z * z];
  return [
    0.28209479,
    0.48860251 * y, 0.48860251 * z, 0.48860251 * x,
    1.09254843 * x * y, 1.09254843 * y * z, 0.31539157 * (3 * zz - 1), 1.09254843 * x * z, 0.54627422 * (xx - yy),
    0.59004359 * y * (3 * xx - yy), 2.89061144 * x * y * z, 0.4570458 * y * (5 * zz - 1), 0.37317633 * z * (5 * zz - 3),
    0.4570458 * x * (5 * zz - 1), 1.44530572 * z * (xx - yy), 0.59004359 * x * (xx - 3 * yy),
  ];
}
