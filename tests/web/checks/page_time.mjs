// SPDX-License-Identifier: Apache-2.0
// The page of a sky that moves: played, paused, scrubbed; at the time of a still scene it shows what that shows.
import {existsSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {withPage} from '../lib/browser.mjs';
import {keep} from '../lib/picture.mjs';
import {similarity} from '../lib/similarity.mjs';
import {until} from './drawing.mjs';
import {expect, rest, SECONDS, slide} from './page_state.mjs';

const SIZE = {width: 960, height: 540};
/** The clouds are the same; the places of puffs are rounded in both. */
const LEAST_SIMILARITY = 0.98;
const ROUNDS = 5;

async function open(page, folder) {
  await page.goto(pathToFileURL(join(folder, 'index.html')).href, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
  await until(() => page.evaluate(() => window.cloudgenReady || window.cloudgenError), SECONDS, 'cloudgenReady is not set');
  const error = await page.evaluate(() => window.cloudgenError);
  expect(!error, `the page says: ${error}`);
}

const validTime = (page) => page.$eval('#cloudgen-scene', (slot) => Date.parse(JSON.parse(slot.textContent).validTime));
const seconds = (page) => page.evaluate(() => window.cloudgen.seconds);
const sunHeight = (page) => page.evaluate(() => window.cloudgen.sun.elevationDegrees);
const place = (page) => page.evaluate(() => ({eye: window.cloudgen.cameraPosition, target: window.cloudgen.target}));

/** The complete picture from a place, panels left out. */
async function pictureFrom(page, {eye, target}) {
  await page.evaluate(([eye, target]) => window.cloudgen.place(eye, target), [eye, target]);
  await page.waitForTimeout(500);
  await rest(page);
  const style = await page.addStyleTag({content: '* {visibility: hidden !important} canvas {visibility: visible !important}'});
  const png = await page.screenshot({timeout: SECONDS * 1000});
  await style.evaluate((element) => element.remove());
  return png;
}

async function playingWorks(page) {
  const [before, sun] = [await seconds(page), await sunHeight(page)];
  await page.selectOption('#time-speed', '1800');
  await page.click('#time-play');
  expect((await page.textContent('#time-play')) === 'Pause', 'the button does not offer to pause');
  await until(async () => Math.abs((await seconds(page)) - before) > 900, SECONDS, 'time does not go on');
  await page.click('#time-play');
  const after = await seconds(page);
  await page.waitForTimeout(400);
  expect((await seconds(page)) === after, 'time goes on when paused');
  expect(Math.abs((await sunHeight(page)) - sun) > 0.5, 'the sun does not go with the time');
  const shown = await page.inputValue('#time');
  expect(Math.abs(Number(shown) - after) < 2, `the slider is at ${shown} s, the sky at ${after} s`);
}

/**
 * Frames a second while the view turns, as the time stands and as it is scrubbed; by turns, so that both meet the same machine. They are
 * told, not demanded (80 % is the aim): they hang on what else the machine does.
 */
async function scrubbingSpeed(page) {
  const {last, first} = await page.$eval('#time', (slider) => ({first: Number(slider.min), last: Number(slider.max)}));
  const flight = (from, to) =>
    page.evaluate(
      async ([from, to]) => {
        const viewer = window.cloudgen;
        const slider = document.getElementById('time');
        const [start, drawn] = [performance.now(), viewer.frames];
        let now = start;
        for (; now - start < 1500; now = performance.now()) {
          viewer.drag(2, 0);
          if (to > from) {
            slider.value = String(from + ((to - from) * (now - start)) / 1500);
            slider.dispatchEvent(new Event('input', {bubbles: true}));
          }
          await new Promise(requestAnimationFrame);
        }
        return (1000 * (viewer.frames - drawn)) / (now - start);
      },
      [from, to],
    );
  await flight(0, 0);
  const [still, moving] = [[], []];
  for (let i = 0; i < ROUNDS; ++i) {
    still.push(await flight(0, 0));
    moving.push(await flight(first, last));
  }
  const median = (values) => values.sort((a, b) => a - b)[ROUNDS >> 1];
  return `${median(moving).toFixed(1)} frames a second of ${median(still).toFixed(1)}`;
}

/** `still` is the scene of one of the times alone, if it is there. */
export async function movingPageWorks(folder, still, picturePath) {
  let standing = null;
  if (existsSync(join(still, 'index.html')))
    standing = await withPage(SIZE, async (page) => {
      await open(page, still);
      await page.click('#view-near');
      const from = await place(page);
      return {from, time: await validTime(page), png: await pictureFrom(page, from)};
    });
  return withPage(SIZE, async (page, seen) => {
    await open(page, folder);
    expect(await page.isVisible('#time-box'), 'there is no time slider');
    const notes = [];
    if (standing) {
      await slide(page, 'time', (standing.time - (await validTime(page))) / 1000);
      await page.waitForTimeout(1000);
      const png = await pictureFrom(page, standing.from);
      await keep(`${picturePath}.still.png`, standing.png);
      await keep(`${picturePath}.moving.png`, png);
      const alike = similarity(standing.png, png);
      expect(alike >= LEAST_SIMILARITY, `at the still scene's time the sky is like it by ${alike.toFixed(3)} only`);
      notes.push(`like the still scene by ${alike.toFixed(3)}`);
    }
    await page.click('#view-near');
    await playingWorks(page);
    notes.push(`scrubbing has ${await scrubbingSpeed(page)}`);
    expect(!seen.errors.length, `console: ${seen.errors.join(' | ')}`);
    return notes.join(', ');
  });
}
