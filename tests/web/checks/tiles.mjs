// SPDX-License-Identifier: Apache-2.0
// Tilesets on somebody's globe: nothing is warned of, the clouds are seen, and each stands where clouds.csv has it.
import {readFile} from 'node:fs/promises';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';
import pngjs from 'pngjs';
import {withPage} from '../lib/browser.mjs';
import {changedShare, keep} from '../lib/picture.mjs';
import {until} from './drawing.mjs';

const SIZE = {width: 960, height: 540};
const SECONDS = 150;
/** How far a drawn cloud may be from where it should be. */
const MOST_PIXELS = 3;
/** What drivers and browsers say of themselves, and 3d-tiles-renderer of every tileset of version 1.1. */
const NOT_OF_THE_TILESET = /tiles versions at 1.1 or higher have limited support|GPU stall due to ReadPixels|GL Driver Message|WebGPU|Automatic fallback to software|SwiftShader/;

const here = fileURLToPath(new URL('..', import.meta.url));

/** The page of CesiumJS as one script. */
export async function cesiumPage() {
  const {outputFiles} = await build({
    entryPoints: [join(here, 'pages/cesium.mjs')], bundle: true, write: false, format: 'esm', logLevel: 'error', target: 'es2022',
  });
  return outputFiles[0].text;
}

async function cloudsOf(folder) {
  const [head, ...lines] = (await readFile(join(folder, 'clouds.csv'), 'utf8')).trim().split('\n').map((line) => line.split(','));
  return lines.map((cells) => Object.fromEntries(head.map((name, i) => [name, Number.isNaN(Number(cells[i])) ? cells[i] : Number(cells[i])])));
}

/** The middle of what two pictures differ by about a place, and how much that is. */
function drawnMiddle(full, empty, [x, y], reach) {
  let [sum, sumX, sumY] = [0, 0, 0];
  for (let row = Math.max(0, Math.round(y - reach)); row < Math.min(full.height, y + reach); ++row)
    for (let column = Math.max(0, Math.round(x - reach)); column < Math.min(full.width, x + reach); ++column) {
      const at = 4 * (row * full.width + column);
      const change = [0, 1, 2].reduce((total, k) => total + Math.abs(full.data[at + k] - empty.data[at + k]), 0);
      sum += change, sumX += change * (column + 0.5), sumY += change * (row + 0.5);
    }
  return {sum, middle: [sumX / sum, sumY / sum]};
}

/** Clouds whose neighbours are farther off than `reach` pixels three times, so that none reaches into what is measured, and which are not at the border. */
function aloneOnScreen(places, reach) {
  const inside = ([x, y]) => x > reach && y > reach && x < SIZE.width - reach && y < SIZE.height - reach;
  return places.map((place, i) => [place, i]).filter(([place, i]) =>
    inside(place) && places.every((other, j) => i === j || Math.hypot(place[0] - other[0], place[1] - other[1]) > 3 * reach));
}

/**
 * Opens the page on the tileset of a folder, seen from above the middle of its clouds, so that a cloud is a few pixels wide.
 * Returns how many clouds were found where they should be, and how far off the worst was.
 */
export async function tilesStandInPlace(address, folder, picturePath) {
  const clouds = await cloudsOf(folder);
  const extent = (key) => [Math.min(...clouds.map((c) => c[key])), Math.max(...clouds.map((c) => c[key]))];
  const [west, east] = extent('longitude'), [south, north] = extent('latitude');
  const height = 100_000 + 150_000 * (north - south);
  const eye = [(west + east) / 2, (south + north) / 2, Math.round(height)];
  return withPage(SIZE, async (page, seen) => {
    await page.goto(`${address}&eye=${eye}`, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
    await until(() => page.evaluate(() => window.state?.ready || window.state?.error), SECONDS, 'the viewer is not ready');
    const error = await page.evaluate(() => window.state.error);
    if (error) throw new Error(`${error}; ${seen.errors.join('; ')}`);
    const shot = async (suffix) => {
      await page.waitForTimeout(1500);
      const png = await page.screenshot({timeout: SECONDS * 1000});
      await keep(`${picturePath}${suffix}.png`, png);
      return png;
    };
    const full = await shot('');
    const expected = await page.evaluate((places) => window.project(places),
      clouds.map(({longitude, latitude, base_m, top_m}) => [longitude, latitude, (base_m + top_m) / 2]));
    await page.evaluate(() => window.removeClouds());
    const empty = await shot('.empty');
    const share = `${(100 * changedShare(full, empty)).toFixed(2)} %`;
    const complaints = [...seen.errors, ...seen.warnings].filter((text) => !NOT_OF_THE_TILESET.test(text));
    if (complaints.length) throw new Error(`the viewer complains: ${complaints.slice(0, 3).join('; ')}`);
    const [a, b] = [full, empty].map((png) => pngjs.PNG.sync.read(png));
    const reach = 8;
    const offs = aloneOnScreen(expected, reach).map(([place]) => {
      const {sum, middle} = drawnMiddle(a, b, place, reach);
      if (!(sum > 0)) throw new Error(`no cloud is drawn at ${place.map(Math.round)}`);
      return Math.hypot(middle[0] - place[0], middle[1] - place[1]);
    });
    if (offs.length < 3) throw new Error(`only ${offs.length} clouds stand alone: the sky is too full for this check`);
    const worst = Math.max(...offs);
    const note = `${offs.length} clouds, the worst ${worst.toFixed(2)} px off; ${share} of the picture are cloud`;
    if (worst > MOST_PIXELS) throw new Error(note);
    return note;
  });
}
