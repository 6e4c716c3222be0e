// SPDX-License-Identifier: Apache-2.0
import pngjs from 'pngjs';

const WINDOW = 8;

/** Luma of a PNG, 0..255. */
function lumaOf(png) {
  const {width, height, data} = pngjs.PNG.sync.read(png);
  const luma = Float64Array.from({length: width * height}, (_, i) => 0.299 * data[4 * i] + 0.587 * data[4 * i + 1] + 0.114 * data[4 * i + 2]);
  return {width, height, luma};
}

/** Mean structural similarity of two pictures of one size (Wang et al. 2004), luma, windows of 8 pixels every 4. */
export function similarity(onePng, otherPng) {
  const [a, b] = [lumaOf(onePng), lumaOf(otherPng)];
  if (a.width !== b.width || a.height !== b.height) throw new Error('pictures of different sizes');
  const [c1, c2] = [(0.01 * 255) ** 2, (0.03 * 255) ** 2];
  let [sum, windows] = [0, 0];
  for (let y = 0; y + WINDOW <= a.height; y += WINDOW / 2)
    for (let x = 0; x + WINDOW <= a.width; x += WINDOW / 2) {
      let [ma, mb, aa, bb, ab] = [0, 0, 0, 0, 0];
      for (let j = 0; j < WINDOW; ++j)
        for (let i = 0; i < WINDOW; ++i) {
          const at = (y + j) * a.width + x + i;
          const [u, v] = [a.luma[at], b.luma[at]];
          ma += u;
          mb += v;
          aa += u * u;
          bb += v * v;
          ab += u * v;
        }
      const n = WINDOW * WINDOW;
      [ma, mb] = [ma / n, mb / n];
      const [va, vb, cov] = [aa / n - ma * ma, bb / n - mb * mb, ab / n - ma * mb];
      sum += ((2 * ma * mb + c1) * (2 * cov + c2)) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
      ++windows;
    }
  return sum / windows;
}
