// SPDX-License-Identifier: Apache-2.0
// Frames a second of the page while it orbits, against one instanced draw of three.js of the same quads: by turns, so that both meet the
// same machine; medians. `blank_fps` is what the browser reaches then with nothing to draw: no page is faster. Not a test: prints one line of
// JSON a sky. Packages are those of tests/web.
//   node tests/bench/page.mjs MADE_SKY [--keep DIR] [--only PUFFS]
import {execFileSync} from 'node:child_process';
import {mkdir, mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';
import {withPage} from '../web/lib/browser.mjs';
import {similarity} from '../web/lib/similarity.mjs';
import {serve} from '../web/lib/server.mjs';

const SIZE = {width: 1280, height: 720};
const SECONDS = 3;
const ROUNDS = 3;
/** Clouds, puffs each, archetypes, kilometres a side; whether three.js draws it, too. */
const SKIES = [
  [200, 40, 8, 40, true],
  [2500, 40, 48, 130, false],
  [25000, 40, 48, 400, false],
];

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const round = (value, digits = 2) => Number(value.toFixed(digits));
const onlyPictures = '* {visibility: hidden !important} canvas {visibility: visible !important}';

async function until(condition, seconds, what) {
  for (const start = Date.now(); Date.now() - start < 1000 * seconds; await new Promise((later) => setTimeout(later, 100))) if (await condition()) return;
  throw new Error(`${what} after ${seconds} s`);
}

/** Frames a second of a page whose canvas is only cleared. */
function blankFps() {
  return withPage(SIZE, async (page) => {
    await page.goto('about:blank');
    return page.evaluate(async (milliseconds) => {
      document.body.innerHTML = '<canvas width=320 height=180 style="position:fixed;inset:0;width:100%;height:100%"></canvas>';
      const gl = document.querySelector('canvas').getContext('webgl2', {antialias: false, alpha: false, depth: false});
      const start = performance.now();
      let frames = 0;
      for (; performance.now() - start < milliseconds; await new Promise(requestAnimationFrame)) {
        gl.clearColor(frames++ % 2, 0, 0, 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
      }
      return (1000 * frames) / (performance.now() - start);
    }, 1000 * SECONDS);
  });
}

/** Opens the page of a folder near its clouds, and measures it, beside three.js if that is asked for. */
function pageFigures(folder, withReference) {
  return withPage(SIZE, async (page, seen) => {
    const start = Date.now();
    await page.goto(pathToFileURL(join(folder, 'index.html')).href);
    await until(() => page.evaluate(() => window.cloudgenReady || window.cloudgenError), 120, 'the page is not ready');
    const loadSeconds = (Date.now() - start) / 1000;
    if (seen.errors.length) throw new Error(seen.errors.join(' | '));
    await page.addStyleTag({content: onlyPictures});
    await page.evaluate(() => window.cloudgen.setView('near'));
    await page.waitForTimeout(1500);
    // Frames as the browser shows them, while the view turns about the clouds as by a hand.
    const flight = (seconds) =>
      page.evaluate(async (seconds) => {
        const viewer = window.cloudgen;
        const start = performance.now();
        const before = viewer.frames;
        while (performance.now() - start < 1000 * seconds) {
          viewer.drag(2, 0);
          await new Promise(requestAnimationFrame);
        }
        const {gl} = viewer;
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        return (1000 * (viewer.frames - before)) / (performance.now() - start);
      }, seconds);
    await flight(SECONDS);
    const rounds = [];
    const figures = async () => {
      const {puffs, canvas, divisor} = await page.evaluate(() => window.cloudgen.drawing);
      return {load_s: round(loadSeconds), fps: round(median(rounds)), drawn: puffs, canvas, divisor};
    };
    if (!withReference) {
      for (let i = 0; i < ROUNDS; ++i) rounds.push(await flight(SECONDS));
      return {figures: await figures()};
    }
    // The picture as it is while the view moves, and what three.js needs to draw the same.
    await page.evaluate(async () => {
      const viewer = window.cloudgen;
      viewer.refine = async () => {};
      viewer.setView('near');
      viewer.listed = null;
      await viewer.askList();
      await new Promise((later) => setTimeout(later, 800));
      viewer.requestFrame();
    });
    await page.waitForTimeout(1500);
    const moving = await page.screenshot({timeout: 60_000});
    const reference = await page.evaluate(async () => {
      const viewer = window.cloudgen;
      const base64 = (bytes) => {
        let text = '';
        for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
        return btoa(text);
      };
      const detail = {errorPixels: 0, hysteresis: 0, mostPuffs: 1e9};
      const list = await viewer.sky.call('list', {camera: viewer.camera, shape: 'quads', marginRadians: 3, marginMeters: 1e6, detail});
      const {gl} = viewer;
      const [size, count] = [128, viewer.pack.root.atlasesLength() * 16];
      const [frame, pixels, rgba] = [gl.createFramebuffer(), new Uint8Array(2 * size * size * count), new Uint8Array(4 * size * size)];
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      for (let layer = 0; layer < count; ++layer) {
        gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, viewer.renderer.painter.sprites, 0, layer);
        gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
        for (let i = 0; i < size * size; ++i) pixels.set([rgba[4 * i], rgba[4 * i + 1]], 2 * (layer * size * size + i));
      }
      return {camera: viewer.camera, quads: base64(new Uint8Array(list.buffer)), layers: {pixels: base64(pixels), size, count}};
    });
    await page.evaluate(() => window.cloudgen.showClouds(false));
    await page.waitForTimeout(2500);
    reference.background = `data:image/png;base64,${(await page.screenshot({timeout: 60_000})).toString('base64')}`;
    await page.evaluate(() => window.cloudgen.showClouds(true));
    const three = await besideThree(reference, async (flightOfThree) => {
      const [times, fpsOfThree] = [[], []];
      for (let i = 0; i < ROUNDS; ++i) {
        rounds.push(await flight(SECONDS));
        fpsOfThree.push(await flightOfThree(2 * SECONDS));
        times.push(rounds[i] / fpsOfThree[i]);
      }
      return {fps: median(fpsOfThree), times: median(times)};
    });
    return {figures: await figures(), moving, three};
  });
}

/** Opens three.js with the same quads, and hands over how it is measured. */
function besideThree(reference, use) {
  return withPage(SIZE, async (page) => {
    const server = await serve(tmpdir());
    try {
      await page.goto(`${server.address}/pages/instanced.html`);
      await until(() => page.evaluate(() => window.ready), 60, 'three.js is not ready');
      const quads = await page.evaluate((reference) => window.start(reference), reference);
      const figures = await use((seconds) => page.evaluate((seconds) => window.flight(seconds), seconds));
      return {...figures, quads, picture: await page.screenshot({timeout: 60_000})};
    } finally {
      server.close();
    }
  });
}

const [program, ...words] = process.argv.slice(2);
if (!program) throw new Error('usage: node tests/bench/page.mjs MADE_SKY [--keep DIR] [--only PUFFS]');
const option = (name) => (words.includes(name) ? words[words.indexOf(name) + 1] : null);
const work = option('--keep') ? resolve(option('--keep')) : await mkdtemp(join(tmpdir(), 'cloudgen-page-'));
await mkdir(work, {recursive: true});
try {
  for (const [clouds, each, archetypes, side, withReference] of SKIES) {
    if (option('--only') && Number(option('--only')) !== clouds * each) continue;
    const folder = join(work, String(clouds * each));
    if (!words.includes('--made')) execFileSync(program, [folder, clouds, each, archetypes, side].map(String), {stdio: ['ignore', 'ignore', 'inherit']});
    const {figures, moving, three} = await pageFigures(folder, withReference);
    const line = {case: 'page', clouds, puffs: clouds * each, ...figures, blank_fps: round(await blankFps())};
    if (withReference) {
      Object.assign(line, {three_quads: three.quads, three_fps: round(three.fps), times_faster: round(three.times, 1), ssim: round(similarity(moving, three.picture), 3)});
      await writeFile(join(work, 'page.png'), moving);
      await writeFile(join(work, 'three.png'), three.picture);
    }
    console.log(JSON.stringify(line));
  }
} finally {
  if (!option('--keep')) await rm(work, {recursive: true, force: true});
}
