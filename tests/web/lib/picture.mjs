// SPDX-License-Identifier: Apache-2.0
// What it means that a viewer "draws" the clouds.
import {mkdir, writeFile} from 'node:fs/promises';
import {dirname} from 'node:path';
import pngjs from 'pngjs';

/** The clouds must change more than this share of the picture of the same sky without them. */
export const LEAST_SHARE = 0.005;
/** A pixel counts as changed when one of its channels differs by more than this, of 255. */
const LEAST_DIFFERENCE = 8;
const LEAST_COLORS = 64;

export async function keep(file, png) {
  await mkdir(dirname(file), {recursive: true});
  await writeFile(file, png);
}

export function changedShare(onePng, otherPng) {
  const a = pngjs.PNG.sync.read(onePng);
  const b = pngjs.PNG.sync.read(otherPng);
  if (a.width !== b.width || a.height !== b.height) throw new Error(`pictures of different sizes: ${a.width}x${a.height}, ${b.width}x${b.height}`);
  let changed = 0;
  for (let i = 0; i < a.data.length; i += 4)
    if ([0, 1, 2].some((k) => Math.abs(a.data[i + k] - b.data[i + k]) > LEAST_DIFFERENCE)) ++changed;
  return changed / (a.width * a.height);
}

function colorsIn(png) {
  const {data} = pngjs.PNG.sync.read(png);
  const colors = new Set();
  for (let i = 0; i < data.length; i += 4) colors.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
  return colors.size;
}

/** Throws unless the clouds are seen; returns the share of the picture that they change. */
export function expectDrawn(withClouds, withoutClouds) {
  const share = changedShare(withClouds, withoutClouds);
  const percent = `${(100 * share).toFixed(2)} %`;
  if (!(share > LEAST_SHARE)) throw new Error(`the clouds change ${percent} of the picture, at least ${100 * LEAST_SHARE} % are expected`);
  const colors = colorsIn(withClouds);
  if (colors < LEAST_COLORS) throw new Error(`a flat picture: ${colors} colours`);
  return percent;
}
