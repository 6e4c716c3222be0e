// SPDX-License-Identifier: Apache-2.0
// Each control of the page, by mouse, keys and touch.
import {readFile} from 'node:fs/promises';
import {until} from './drawing.mjs';
import {apart, cloudOnScreen, expect, frames, position, rest, SECONDS, slide} from './page_state.mjs';

const pressed = (page, id) => page.getAttribute(`#${id}`, 'aria-pressed').then((value) => value === 'true');
const text = (page, id) => page.textContent(`#${id}`);

async function modesWork(page) {
  for (const mode of ['fly', 'walk', 'follow', 'orbit']) {
    await page.click(`#mode-${mode}`);
    expect(await pressed(page, `mode-${mode}`), `the button ${mode} is not shown as pressed`);
    if (mode === 'walk') expect((await page.evaluate(() => window.cloudgen.cameraPosition[1] - window.cloudgen.groundUnder(window.cloudgen.cameraPosition))) < 3, 'walking is not on the ground');
  }
  await page.focus('canvas');
  await page.keyboard.press('f');
  expect(await pressed(page, 'mode-fly'), 'F does not turn flying on');
}

async function keysWork(page) {
  await page.click('#view-near');
  await page.click('#mode-fly');
  await page.focus('canvas');
  for (const key of ['w', 'd', 'e', 'ArrowLeft']) {
    const before = await page.evaluate(() => ({place: window.cloudgen.cameraPosition, ahead: window.cloudgen.camera.forward}));
    const drawn = await frames(page);
    await page.keyboard.down(key);
    await until(async () => (await frames(page)) > drawn + 1, SECONDS, `no picture while ${key} is held`);
    await page.keyboard.up(key);
    const after = await page.evaluate(() => ({place: window.cloudgen.cameraPosition, ahead: window.cloudgen.camera.forward}));
    if (key.startsWith('Arrow')) expect(apart(before.ahead, after.ahead) > 0.002, `key ${key} does not turn the camera`);
    else expect(apart(before.place, after.place) > 10, `key ${key} does not move the camera`);
  }
  await page.keyboard.press('n');
  await until(async () => /^(000|001|359)/.test(await text(page, 'bearing')), 20, 'N does not turn to north');
  await page.keyboard.press('h');
  expect(await page.isVisible('#help'), 'H does not open the help');
  await page.keyboard.press('Escape');
  expect(!(await page.isVisible('#help')), 'Escape does not close the help');
  const wasOpen = await page.$eval('#panel', (panel) => panel.open);
  await page.keyboard.press('l');
  expect((await page.$eval('#panel', (panel) => panel.open)) !== wasOpen, 'L does not open or close the panel');
  await page.keyboard.press('l');
}

async function pointerWorks(page) {
  await page.click('#view-near');
  const {width, height} = page.viewportSize();
  const [x, y] = [width / 2, height / 2];
  let before = await position(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 20, {steps: 4});
  await page.mouse.up();
  expect(apart(before, await position(page)) > 100, 'dragging does not turn the view');
  before = await position(page);
  await page.mouse.wheel(0, -300);
  await until(async () => apart(before, await position(page)) > 100, 20, 'the wheel does not move the camera');
  before = await position(page);
  await page.mouse.move(x, y);
  await page.mouse.down({button: 'right'});
  await page.mouse.move(x + 50, y, {steps: 3});
  await page.mouse.up({button: 'right'});
  expect(apart(before, await position(page)) > 100, 'the right button does not move the view');
}

/** Two fingers apart bring the view nearer. */
async function touchWorks(page) {
  const before = await position(page);
  await page.$eval('canvas', (canvas) => {
    canvas.setPointerCapture = () => {};
    const send = (type, pointerId, clientX) =>
      canvas.dispatchEvent(new PointerEvent(type, {pointerId, pointerType: 'touch', clientX, clientY: 300, bubbles: true}));
    send('pointerdown', 11, 150);
    send('pointerdown', 12, 200);
    for (let x = 200; x <= 300; x += 20) send('pointermove', 12, x);
    send('pointerup', 11, 150);
    send('pointerup', 12, 300);
    delete canvas.setPointerCapture;
  });
  expect(apart(before, await position(page)) > 100, 'two fingers do not bring the view nearer');
}

async function slidersWork(page) {
  await page.click('#view-near');
  const sunPlace = () => page.evaluate(() => [window.cloudgen.sun.elevationDegrees, window.cloudgen.sun.azimuthDegrees, 0]);
  const sun = await sunPlace();
  const clock = await page.inputValue('#sun-minute');
  await slide(page, 'sun-minute', (Number(clock) + 240) % 1440);
  expect(apart(await sunPlace(), sun) > 1, 'the sun slider does not move the sun');
  expect(/\d\d:\d\d UTC/.test(await text(page, 'sun-text')), 'the sun slider does not tell the time');
  await slide(page, 'sun-minute', clock);
  await slide(page, 'exaggeration', 2);
  expect((await text(page, 'exaggeration-text')) === 'heights × 2', 'the slider does not tell the exaggeration');
  await slide(page, 'exaggeration', 1);
  if (await page.isVisible('#time')) {
    const before = await text(page, 'time-text');
    await slide(page, 'time', 900);
    expect((await text(page, 'time-text')) !== before, 'the time slider does not tell the time');
    await slide(page, 'time', 0);
  }
}

/** With all genera off, and with all levels off, no puff is left. */
async function layersWork(page) {
  await rest(page);
  const puffs = () => page.evaluate(() => window.cloudgen.drawing.puffs);
  const all = await puffs();
  expect(all > 0, 'no puffs are drawn');
  const toggle = (selector) => page.$$eval(selector, (boxes) => boxes.forEach((box) => box.click()));
  for (const selector of ['#genera input', '#levels input']) {
    await toggle(selector);
    await until(async () => (await puffs()) === 0, 30, `puffs are left with all of ${selector} off`);
    await toggle(selector);
    await until(async () => (await puffs()) > 0, 30, `puffs do not come back with all of ${selector} on`);
  }
}

async function pickingWorks(page, folder) {
  await page.click('#view-near');
  if (await page.$eval('#panel', (panel) => panel.open)) await page.click('#panel summary');
  await rest(page);
  const seen = await cloudOnScreen(page);
  expect(seen, 'no cloud is seen from near');
  await page.mouse.click(seen.x, seen.y);
  await until(() => page.isVisible('#card'), 20, 'a click on a cloud shows no card');
  const genus = (await text(page, 'card-genus')).match(/\((\w+)\)/)?.[1];
  const report = JSON.parse(await readFile(`${folder}/report.json`, 'utf8'));
  expect(genus in report.genera, `the card tells a genus that is not in the report: ${genus}`);
  expect(/m \/ .* ft \/ FL\d{3}/.test(await text(page, 'card-base')) && /FL\d{3}/.test(await text(page, 'card-top')), 'the card does not tell base and top');
  expect(Number(await text(page, 'card-depth')) > 0, 'the card does not tell the optical depth');
  expect((await text(page, 'card-rule')).length > 2 && /^\d+, layer \d+, cloud \d+$/.test(await text(page, 'card-cell')), 'the card does not tell rule and cell');
  await page.click('#card-close');
  expect(!(await page.isVisible('#card')), 'the card does not close');
}

async function pathWorks(page) {
  await page.click('#mode-follow');
  const before = await position(page);
  await until(async () => apart(before, await position(page)) > 20, SECONDS, 'following the path does not move the camera');
  await page.click('#path-play');
  await rest(page);
  const still = await position(page);
  await slide(page, 'path-place', 500);
  expect(apart(still, await position(page)) > 100, 'the slider of the path does not move the camera');
  const box = await page.evaluate(() => window.cloudgen.frame.box);
  const line = {type: 'LineString', coordinates: [[box.west, box.south, 4000], [box.east, box.north, 4000]]};
  await page.setInputFiles('#path-file', {name: 'path.geojson', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(line))});
  await until(async () => Math.abs((await position(page))[1] - 4000) < 1, 20, 'a path from a file is not flown');
  await page.click('#path-play');
  await page.click('#mode-orbit');
}

async function screenshotWorks(page) {
  const [download] = await Promise.all([page.waitForEvent('download', {timeout: 30_000}), page.click('#screenshot')]);
  const png = await readFile(await download.path());
  expect(png.subarray(1, 4).toString() === 'PNG' && png.length > 5000, 'the saved picture is none');
}

async function readoutTells(page) {
  await page.click('#view-top');
  await rest(page);
  expect(/°/.test(await text(page, 'place')), `no coordinates: ${await text(page, 'place')}`);
  expect(/ m \/ .* ft \/ FL/.test(await text(page, 'height')), `no camera height: ${await text(page, 'height')}`);
  expect(/(km|m) at /.test(await text(page, 'scale-text')), 'no scale');
  await page.click('#compass');
}

export async function controlsWork(page, folder) {
  await modesWork(page);
  await keysWork(page);
  await pointerWorks(page);
  await touchWorks(page);
  await slidersWork(page);
  await layersWork(page);
  await pickingWorks(page, folder);
  await pathWorks(page);
  await screenshotWorks(page);
  await readoutTells(page);
}
