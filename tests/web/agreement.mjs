// SPDX-License-Identifier: Apache-2.0
// How well viewers agree on one sky: cover and brightness of its clouds, looked up at from the ground, as `cloudgen preview`, three.js (splats
// and cards) and X_ITE draw them.
//   node tests/web/agreement.mjs PROGRAM SKY.sky.json [--keep DIR]
// Prints a JSON line: cover is the share of the picture where clouds are more than half opaque, luminance the mean where the splats are opaque.
// Slow (minutes): not a part of the tests.
import {execFileSync} from 'node:child_process';
import {mkdir, mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import pngjs from 'pngjs';
import {linear, luminance} from './lib/light.mjs';
import {pagePicture, previewPicture, threePicture, xitePicture} from './lib/placed.mjs';

const SIZE = {width: 480, height: 270};
const OPAQUE = 0.9;

/** From south of the box up to where no ground is seen; longitude, latitude, metres. */
function viewOf([west, south, east, north]) {
  const middle = (west + east) / 2;
  const metersOfDegree = 111_200;
  const away = 0.9 * (north - south);
  return {eye: [middle, south - 0.2 * (north - south), 50], target: [middle, south - 0.2 * (north - south) + away, 50 + Math.tan(0.42) * away * metersOfDegree]};
}

const decode = (png) => pngjs.PNG.sync.read(png).data;
const displayAt = (data, i) => [data[i] / 255, data[i + 1] / 255, data[i + 2] / 255];
const linearAt = (data, i) => displayAt(data, i).map(linear);
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/** Opacity and colour of each pixel from pictures before black and before white; `blended` tells in which values the viewer blends. */
function overBlackAndWhite(blackPng, whitePng, blended) {
  const [black, white] = [decode(blackPng), decode(whitePng)];
  const at = blended === 'linear' ? linearAt : displayAt;
  const pixels = [];
  for (let i = 0; i < black.length; i += 4) {
    const alpha = Math.min(1, Math.max(0, 1 - (mean(at(white, i)) - mean(at(black, i)))));
    pixels.push({alpha, luminance: luminance(linearAt(black, i))});
  }
  return pixels;
}

/** The same from pictures with and without clouds before a blue sky: how much of its blue is gone. */
function overSky(cloudyPng, clearPng) {
  const [cloudy, clear] = [decode(cloudyPng), decode(clearPng)];
  const blueness = ([r, , b]) => b - r;
  const pixels = [];
  for (let i = 0; i < cloudy.length; i += 4) {
    const color = linearAt(cloudy, i);
    pixels.push({alpha: Math.min(1, Math.max(0, 1 - blueness(color) / blueness(linearAt(clear, i)))), luminance: luminance(color)});
  }
  return pixels;
}

function summary(pixels, judged) {
  return {
    cover: +mean(pixels.map((pixel) => Number(pixel.alpha > 0.5))).toFixed(3),
    luminance: +mean(pixels.filter((_, i) => judged[i]).map((pixel) => pixel.luminance)).toFixed(3),
  };
}

const [program, skyFile, keepWord, keepFolder] = process.argv.slice(2);
if (!skyFile) throw new Error('usage: node tests/web/agreement.mjs PROGRAM SKY.sky.json [--keep DIR]');
const work = keepWord === '--keep' ? resolve(keepFolder) : await mkdtemp(join(tmpdir(), 'cloudgen-agreement-'));
await mkdir(work, {recursive: true});
try {
  const sky = JSON.parse(await readFile(skyFile, 'utf8'));
  const view = viewOf(sky.bbox);
  const build = async (name, layers, formats) => {
    await writeFile(join(work, `${name}.sky.json`), JSON.stringify({...sky, layers}));
    execFileSync(program, ['build', join(work, `${name}.sky.json`), '-o', join(work, name), '--formats', formats, '--max-puffs', '60000', '--overwrite', '--quiet'], {stdio: ['ignore', 'ignore', 'inherit']});
    return join(work, name);
  };
  const kept = async (name, png) => {
    await writeFile(join(work, name), png);
    return png;
  };
  const folder = await build('clouds', sky.layers, 'x3d,splats,glb,pack,page');
  const clear = await build('clear', [], 'splats');
  const {place} = await pagePicture(folder, SIZE, view);
  const results = {preview: overSky(await previewPicture(program, folder, join(work, 'preview.png'), SIZE, view), await previewPicture(program, clear, join(work, 'clear.png'), SIZE, view))};
  for (const [name, blended, picture] of [
    ['splats', 'display', (grey) => threePicture(folder, 'scene.splats.glb', SIZE, place, grey)],
    ['cards', 'linear', (grey) => threePicture(folder, 'scene.glb', SIZE, place, grey)],
    ['x3d', 'display', (grey) => xitePicture(folder, SIZE, place, grey)],
  ])
    results[name] = overBlackAndWhite(await kept(`${name}_black.png`, await picture(0)), await kept(`${name}_white.png`, await picture(1)), blended);
  const judged = results.splats.map((pixel) => pixel.alpha > OPAQUE);
  console.log(JSON.stringify({bench: 'agreement', sky: sky.title, ...Object.fromEntries(Object.entries(results).map(([name, pixels]) => [name, summary(pixels, judged)]))}));
} finally {
  if (keepWord !== '--keep') await rm(work, {recursive: true, force: true});
}
