// SPDX-License-Identifier: Apache-2.0
// The table of Murphy's thesis: one sky of cumulus as cloudgen writes it and as one Billboard a puff, in X_ITE and X3DOM, the
// camera on a circle. One JSON line a case (drawing_ms: processor time of the drawing process for a frame); --plot draws them.
// One more where both kinds drew up to 1000: how alike the two are from 1500 m away (ssim).
//   node tests/bench/web/bench.mjs BILLBOARD_SKY [--billboards 1,10,100,1000,2000,5000,10000] [--viewers xite,x3dom]
//        [--kinds ours,thesis] [--seconds 8] [--wait 90] [--pictures DIR] [--plot FILE.svg] [--lines FILE.jsonl]
import {execFileSync} from 'node:child_process';
import {appendFileSync, mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {parseArgs} from 'node:util';
import {withPage} from '../../web/lib/browser.mjs';
import {serve} from '../../web/lib/server.mjs';
import {similarity} from '../../web/lib/similarity.mjs';
import {drawingTimeUnder, memoryUnder} from './memory.mjs';
import {linesOf, plot} from './plot.mjs';

const {values: options, positionals: [program]} = parseArgs({
  allowPositionals: true,
  options: {
    billboards: {type: 'string', default: '1,10,100,1000,2000,5000,10000'},
    viewers: {type: 'string', default: 'xite,x3dom'},
    kinds: {type: 'string', default: 'ours,thesis'},
    seconds: {type: 'string', default: '8'},
    wait: {type: 'string', default: '90'},
    pictures: {type: 'string'},
    plot: {type: 'string'},
    lines: {type: 'string'},
  },
});
if (!program) {
  console.error('usage: node tests/bench/web/bench.mjs BILLBOARD_SKY [options]; see the head of the file');
  process.exit(2);
}

/** More as one Billboard each take minutes to look at. */
const MOST_COMPARED = 1000;

/** Runs in the page: puts the camera at a place, looking level along a yaw. */
function addCamera(viewer) {
  if (viewer === 'xite') {
    const view = browser.currentScene.getNamedNode('View_Overview');
    window.look = (x, y, z, yaw) => {
      view.position = new X3D.SFVec3f(x, y, z);
      view.orientation = new X3D.SFRotation(0, 1, 0, yaw);
    };
  } else {
    const view = [...document.querySelectorAll('Viewpoint')].find((node) => node.getAttribute('DEF') === 'View_Overview');
    window.look = (x, y, z, yaw) => {
      view.setAttribute('position', `${x} ${y} ${z}`);
      view.setAttribute('orientation', `0 1 0 ${yaw}`);
    };
  }
}

/** Runs in the page: a circle of 1500 m about the middle for some seconds; returns what frames took. */
async function orbit({middle, seconds}) {
  const gaps = [];
  const start = performance.now();
  let last = start;
  await new Promise((done) => {
    const frame = () => {
      const now = performance.now();
      gaps.push(now - last);
      last = now;
      const yaw = (now / 1000) * 0.3;
      window.look(middle[0] + 1500 * Math.sin(yaw), middle[1], middle[2] + 1500 * Math.cos(yaw), yaw);
      if (now - start >= seconds * 1000) done();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
  gaps.shift();
  gaps.sort((a, b) => a - b);
  return {frames: gaps.length, fps: gaps.length / ((last - start) / 1000), p95: gaps[Math.floor(gaps.length * 0.95)] ?? null};
}

/** Also the picture from near by, if it was drawn. */
async function measure(folder, viewer, kind, billboards) {
  let picture = null;
  const line = {bench: 'billboards', viewer, kind, billboards};
  const side = 1000 * Math.sqrt(Math.max(1, Math.floor(billboards / 40)));
  const middle = [side / 2, 1250, -side / 2];
  const server = await serve(folder);
  const scene = kind === 'ours' ? 'scene.x3d' : 'thesis.x3d';
  try {
    await withPage({width: 1280, height: 720}, async (page) => {
      const started = Date.now();
      await page.goto(`${server.address}/pages/${viewer}.html?scene=/scene/${scene}`, {waitUntil: 'domcontentloaded', timeout: 60_000});
      await page.waitForFunction('window.state.ready || window.state.error', null, {timeout: 1000 * Number(options.wait), polling: 50});
      const error = await page.evaluate(() => window.state.error);
      if (error) throw new Error(error);
      line.first_frame_ms = Date.now() - started;
      await page.evaluate(addCamera, viewer);
      await page.evaluate(orbit, {middle, seconds: 4}); // what is near is loaded, shaders are built
      const before = drawingTimeUnder(process.pid);
      const {frames, fps, p95} = await page.evaluate(orbit, {middle, seconds: Number(options.seconds)});
      const drawing_ms = Math.round((drawingTimeUnder(process.pid) - before) / Math.max(frames, 1));
      Object.assign(line, {fps: Number(fps.toFixed(2)), p95_ms: p95 && Math.round(p95), drawing_ms}, memoryUnder(process.pid));
      if (options.pictures || billboards <= MOST_COMPARED) {
        await page.evaluate(([x, y, z]) => window.look(x, y, z + 1500, 0), middle);
        await page.waitForTimeout(3000);
        picture = await page.screenshot({timeout: 90_000});
        if (options.pictures) writeFileSync(join(resolve(options.pictures), `${viewer}_${kind}_${billboards}.png`), picture);
      }
    });
  } catch (error) {
    line.failed = String(error.message ?? error).split('\n')[0].slice(0, 160);
  } finally {
    server.close();
  }
  return {line, picture};
}

const lines = [];
function tell(line) {
  lines.push(line);
  console.log(JSON.stringify(line));
  if (options.lines) appendFileSync(options.lines, `${JSON.stringify(line)}\n`);
}

for (const billboards of options.billboards.split(',').map(Number)) {
  const folder = mkdtempSync(join(tmpdir(), 'cloudgen-billboards-'));
  execFileSync(resolve(program), [String(billboards), folder], {stdio: ['ignore', 'inherit', 'inherit']});
  for (const viewer of options.viewers.split(',')) {
    const pictures = [];
    for (const kind of options.kinds.split(',')) {
      const {line, picture} = await measure(folder, viewer, kind, billboards);
      tell(line);
      if (picture && billboards <= MOST_COMPARED) pictures.push(picture);
    }
    if (pictures.length === 2) tell({bench: 'near view', viewer, billboards, ssim: Number(similarity(...pictures).toFixed(3))});
  }
  rmSync(folder, {recursive: true, force: true});
}
if (options.plot) writeFileSync(options.plot, plot(options.lines ? linesOf(options.lines) : lines));
