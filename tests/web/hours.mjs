// SPDX-License-Identifier: Apache-2.0
// One theatre from morning to evening, as `cloudgen preview`, the page and X_ITE draw it from the same place.
//   node tests/web/hours.mjs PROGRAM SKY.sky.json SHEET.png [--keep DIR]
// Writes a contact sheet, an hour a row, and prints mean luminances. Slow (minutes): not a part of the tests.
import {execFileSync} from 'node:child_process';
import {mkdir, mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';
import pngjs from 'pngjs';
import {withPage} from './lib/browser.mjs';
import {serve} from './lib/server.mjs';
import {until} from './checks/drawing.mjs';

const HOURS = [6, 9, 12, 15, 18];
const SIZE = {width: 384, height: 216};
const SECONDS = 120;
const FIELD_OF_VIEW = Math.PI / 4;

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

/** Draws the page from the place; returns the picture and the place in metres of the scene. */
function pagePicture(folder, view) {
  return withPage(SIZE, async (page) => {
    await page.goto(pathToFileURL(join(folder, 'index.html')).href);
    await until(() => page.evaluate(() => window.cloudgenReady || window.cloudgenError), SECONDS, 'the page is not ready');
    const place = await page.evaluate(({eye, target}) => {
      const viewer = window.cloudgen;
      const inScene = ([longitude, latitude, height]) => {
        const [x, z] = viewer.frame.toScene(longitude, latitude);
        return [x, height, z];
      };
      const place = {eye: inScene(eye), target: inScene(target)};
      viewer.place(place.eye, place.target);
      return place;
    }, view);
    await page.addStyleTag({content: '* {visibility: hidden} canvas {visibility: visible !important}'});
    const still = () => page.evaluate(() => window.cloudgen.isAtRest);
    await until(still, SECONDS, 'the page still draws');
    return {place, png: await page.screenshot()};
  });
}

/** X3D's rotation that looks from one place to another, upright. */
function orientation({eye, target}) {
  const [x, y, z] = [0, 1, 2].map((i) => target[i] - eye[i]);
  const half = [Math.atan2(-x, -z) / 2, Math.atan2(y, Math.hypot(x, z)) / 2];
  const [cy, sy, cp, sp] = [Math.cos(half[0]), Math.sin(half[0]), Math.cos(half[1]), Math.sin(half[1])];
  const axis = [cy * sp, sy * cp, -sy * sp];
  const sine = Math.hypot(...axis);
  return [...(sine > 1e-9 ? axis.map((a) => a / sine) : [0, 1, 0]), 2 * Math.atan2(sine, cy * cp)].join(' ');
}

async function xitePicture(folder, place) {
  const x3d = await readFile(join(folder, 'scene.x3d'), 'utf8');
  const viewpoint = `<Viewpoint position="${place.eye.join(' ')}" orientation="${orientation(place)}" fieldOfView="${FIELD_OF_VIEW}"/>`;
  const server = await serve(folder, {'/scene/placed.x3d': x3d.replace('<Viewpoint', `${viewpoint}<Viewpoint`)});
  try {
    return await withPage(SIZE, async (page) => {
      await page.goto(`${server.address}/pages/xite.html?scene=/scene/placed.x3d`);
      await until(() => page.evaluate(() => window.state.ready || window.state.error), SECONDS, 'X_ITE is not ready');
      await page.waitForTimeout(6000);
      return page.screenshot({timeout: SECONDS * 1000});
    });
  } finally {
    server.close();
  }
}

/** Mean of the linear luminance, 0..1, and of the display values of red and blue. */
function meansOf(png) {
  const {data} = pngjs.PNG.sync.read(png);
  const linear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  let [luminance, red, blue] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = [data[i], data[i + 1], data[i + 2]].map((v) => linear(v / 255));
    luminance += 0.2126 * r + 0.7152 * g + 0.0722 * b;
    red += r;
    blue += b;
  }
  return {luminance: (luminance * 4) / data.length, warmth: red / blue};
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
    execFileSync(program, ['preview', folder, '-o', preview, '--size', `${SIZE.width}x${SIZE.height}`, `--view=${view.eye}:${view.target}`, '--quiet']);
    const page = await pagePicture(folder, view);
    const row = [await readFile(preview), page.png, await xitePicture(folder, page.place)];
    rows.push(row);
    const means = row.map(meansOf);
    console.log(JSON.stringify({hour, luminance: means.map((m) => +m.luminance.toFixed(3)), red_to_blue: means.map((m) => +m.warmth.toFixed(2))}));
  }
  await writeFile(sheetFile, sheetOf(rows));
} finally {
  if (keepWord !== '--keep') await rm(work, {recursive: true, force: true});
}
