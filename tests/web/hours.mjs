// SPDX-License-Identifier: Apache-2.0
// One theatre from morning to evening, as `cloudgen preview`, the page, three.js (splats) and X_ITE draw it from the same place.
//   node tests/web/hours.mjs PROGRAM SKY.sky.json SHEET.png [--keep DIR]
// Writes a contact sheet, an hour a row, and prints mean luminances. Slow (minutes): not a part of the tests.
import {execFileSync} from 'node:child_process';
import {mkdir, mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import pngjs from 'pngjs';
import {linear, luminance} from './lib/light.mjs';
import {pagePicture, previewPicture, threePicture, xitePicture} from './lib/placed.mjs';

const HOURS = [6, 9, 12, 15, 18];
const SIZE = {width: 384, height: 216};

/** The sky at an hour of mean solar time over the middle of its box. */
function atHour(sky, hour) {
  const middle = (sky.bbox[0] + sky.bbox[2]) / 2;
  const midnight = Date.parse(`${sky.valid_time.slice(0, 10)}T00:00:00Z`);
  return {...sky, valid_time: new Date(midnight + (hour - middle / 15) * 3_600_000).toISOString().replace(/\.\d+Z/, 'Z')};
}

/** From the south, a little above the low clouds; longitude, latitude, metres. */
function viewOf([west, south, east, north]) {
  const middle = (west + east) / 2;
  return {eye: [middle, south - 0.35 * (north - south), 3200], target: [middle, south + 0.6 * (north - south), 2300]};
}

/** Mean of the linear luminance, 0..1, and of the display values of red and blue. */
function meansOf(png) {
  const {data} = pngjs.PNG.sync.read(png);
  let [sum, red, blue] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = [data[i], data[i + 1], data[i + 2]].map((v) => linear(v / 255));
    sum += luminance([r, g, b]);
    red += r;
    blue += b;
  }
  return {luminance: (sum * 4) / data.length, warmth: red / blue};
}

function sheetOf(rows) {
  const sheet = new pngjs.PNG({width: rows[0].length * SIZE.width, height: rows.length * SIZE.height});
  rows.forEach((row, j) => row.forEach((png, i) => pngjs.PNG.bitblt(pngjs.PNG.sync.read(png), sheet, 0, 0, SIZE.width, SIZE.height, i * SIZE.width, j * SIZE.height)));
  return pngjs.PNG.sync.write(sheet, {colorType: 2});
}

const [program, skyFile, sheetFile, keepWord, keepFolder] = process.argv.slice(2);
if (!sheetFile) throw new Error('usage: node tests/web/hours.mjs PROGRAM SKY.sky.json SHEET.png [--keep DIR]');
const work = keepWord === '--keep' ? resolve(keepFolder) : await mkdtemp(join(tmpdir(), 'cloudgen-hours-'));
await mkdir(work, {recursive: true});
try {
  const sky = JSON.parse(await readFile(skyFile, 'utf8'));
  const view = viewOf(sky.bbox);
  const rows = [];
  for (const hour of HOURS) {
    const [file, folder, preview] = [`${hour}.sky.json`, `${hour}`, `${hour}.png`].map((name) => join(work, name));
    await writeFile(file, JSON.stringify(atHour(sky, hour)));
    execFileSync(program, ['build', file, '-o', folder, '--formats', 'x3d,splats,pack,page', '--max-puffs', '60000', '--overwrite', '--quiet'], {stdio: ['ignore', 'ignore', 'inherit']});
    const page = await pagePicture(folder, SIZE, view);
    const row = [await previewPicture(program, folder, preview, SIZE, view), page.png, await threePicture(folder, 'scene.splats.glb', SIZE, page.place),
      await xitePicture(folder, SIZE, page.place)];
    rows.push(row);
    const means = row.map(meansOf);
    console.log(JSON.stringify({hour, luminance: means.map((m) => +m.luminance.toFixed(3)), red_to_blue: means.map((m) => +m.warmth.toFixed(2))}));
  }
  await writeFile(sheetFile, sheetOf(rows));
} finally {
  if (keepWord !== '--keep') await rm(work, {recursive: true, force: true});
}
