// SPDX-License-Identifier: Apache-2.0
// A sky that moves in somebody's viewer: from one time of its film to another the clouds went as far as the wind takes them.
import {readFile} from 'node:fs/promises';
import {join} from 'node:path';
import {withPage} from '../lib/browser.mjs';
import {changedShare, keep} from '../lib/picture.mjs';
import {until} from './drawing.mjs';
import {expect} from './page_state.mjs';

const SIZE = {width: 960, height: 540};
const SECONDS = 120;
/** Seconds of the film in its first hour, which takes ten. */
const TIMES = [2, 8];
const SECONDS_AN_HOUR = 10;
/** Clouds differ in their heights and so in their winds; the report has the mean of those that are matched. */
const LEAST_DRIFT = 0.75;
const MOST_DRIFT = 1.25;
/** A cloud that is smaller than this is not there. */
const LEAST_SCALE = 0.01;

function meanDrift([before, after]) {
  const hours = (after.seconds - before.seconds) / SECONDS_AN_HOUR;
  let [count, speed] = [0, 0];
  for (const [name, [x, , z, scale]] of Object.entries(before.clouds)) {
    const [x2, , z2, scale2] = after.clouds[name] ?? [0, 0, 0, 0];
    if (Math.min(scale, scale2) < LEAST_SCALE) continue;
    speed += Math.hypot(x2 - x, z2 - z) / (3600 * hours);
    ++count;
  }
  expect(count > 0, 'no cloud is there at both times');
  return {count, speed: speed / count};
}

/** `address` is that of a page with `filmAt`. */
export async function skyMoves(address, folder, picturePath) {
  const {motion} = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8'));
  const wind = motion.hours[0].wind_m_s;
  return withPage(SIZE, async (page, seen) => {
    await page.goto(address, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
    await until(() => page.evaluate(() => window.state?.ready || window.state?.error), SECONDS, 'the viewer is not ready');
    const error = await page.evaluate(() => window.state.error);
    expect(!error, error);
    const [moments, pictures] = [[], []];
    for (const seconds of TIMES) {
      moments.push(await page.evaluate((at) => window.filmAt(at), seconds));
      pictures.push(await page.screenshot({timeout: SECONDS * 1000}));
      await keep(`${picturePath}.${seconds}s.png`, pictures.at(-1));
    }
    const {count, speed} = meanDrift(moments);
    const drift = speed / wind;
    expect(drift > LEAST_DRIFT && drift < MOST_DRIFT, `${count} clouds go at ${speed.toFixed(1)} m/s, the wind at ${wind}`);
    const changed = changedShare(...pictures);
    expect(changed > 0.002, `only ${(100 * changed).toFixed(2)} % of the picture change`);
    const errors = seen.errors.filter((text) => !/status of 404/.test(text));  // the page has no icon
    expect(!errors.length, `console: ${errors.join(' | ')}`);
    return `${count} clouds go at ${speed.toFixed(1)} m/s, the wind at ${wind}`;
  });
}
