// SPDX-License-Identifier: Apache-2.0
// index.html as a user opens it: from the disk, with mouse and keys, on a desk and on a telephone.
import {existsSync} from 'node:fs';
import {readFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {withPage} from '../lib/browser.mjs';
import {expectDrawn, keep} from '../lib/picture.mjs';
import {until} from './drawing.mjs';
import {controlsWork} from './page_controls.mjs';
import {apart, expect, position, rest, SECONDS} from './page_state.mjs';

async function viewButtonsWork(page, picturePath) {
  const places = [];
  for (const name of ['near', 'ground', 'top', 'overview']) {
    await page.click(`#view-${name}`);
    await rest(page);
    expect((await page.getAttribute(`#view-${name}`, 'aria-pressed')) === 'true', `the button ${name} is not shown as pressed`);
    places.push(await position(page));
    await keep(`${picturePath}.${name}.png`, await page.screenshot({timeout: SECONDS * 1000}));
  }
  expect(apart(places[0], places[1]) > 1000 && apart(places[1], places[2]) > 1000, 'view buttons do not move the camera');
}

async function legendListsGenera(page, folder) {
  const shown = await page.$$eval('#genera li[data-genus]', (rows) =>
    Object.fromEntries(rows.map((row) => [row.dataset.genus, Number(row.querySelector('.count').textContent.replaceAll(',', ''))])),
  );
  const report = join(folder, 'report.json');
  if (!existsSync(report)) return;
  const counted = Object.entries(JSON.parse(await readFile(report, 'utf8')).genera ?? {}).filter(([, count]) => count > 0);
  for (const [genus, count] of counted) expect(shown[genus] === count, `legend: ${genus} ${shown[genus]}, report: ${count}`);
  expect(Object.keys(shown).length === counted.length, `legend lists ${Object.keys(shown)}, report ${counted.map(([genus]) => genus)}`);
}

async function fidelityIsTold(page, folder) {
  const shown = await page.evaluate(() => document.getElementById('fidelity')?.dataset.verified);
  const report = join(folder, 'report.json');
  if (!existsSync(report)) return;
  const found = JSON.parse(await readFile(report, 'utf8')).verify;
  const told = found ? (found.passed ? 'passed' : 'failed') : 'no';
  expect(shown === told, `fidelity: the page says ${shown}, the report ${told}`);
}

/** What axe-core finds that keeps people out. */
async function noSeriousFindings(page) {
  // The page's policy lets no script in: the driver's own context may.
  await page.evaluate(await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
  const {violations} = await page.evaluate(() => window.axe.run());
  const grave = violations.filter(({impact}) => impact === 'serious' || impact === 'critical');
  expect(!grave.length, `axe: ${grave.map(({id, nodes}) => `${id} (${nodes.map((node) => node.target).join(' ')})`).join(', ')}`);
}

async function everythingFits(page) {
  const outside = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, summary, #readout')]
      .filter((element) => element.checkVisibility() && !element.closest('dialog, ul, #levels, .file'))
      .filter((element) => {
        const {left, right, top, bottom} = element.getBoundingClientRect();
        return left < 0 || top < 0 || right > innerWidth + 0.5 || bottom > innerHeight + 0.5;
      })
      .map((element) => element.id || element.tagName),
  );
  expect(!outside.length, `not wholly in the window: ${outside.join(', ')}`);
}

export async function pageWorks(folder, size, picturePath) {
  return withPage(size, async (page, seen) => {
    const address = pathToFileURL(join(folder, 'index.html')).href;
    const start = Date.now();
    await page.goto(address, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
    await until(() => page.evaluate(() => window.cloudgenReady || window.cloudgenError), SECONDS, 'cloudgenReady is not set');
    const error = await page.evaluate(() => window.cloudgenError);
    expect(!error, `the page says: ${error}`);
    const ready = ((Date.now() - start) / 1000).toFixed(1);

    await everythingFits(page);
    await legendListsGenera(page, folder);
    await fidelityIsTold(page, folder);
    await rest(page);
    const full = await page.screenshot({timeout: SECONDS * 1000});
    await keep(`${picturePath}.png`, full);
    await page.evaluate(() => window.cloudgen.showClouds(false));
    await rest(page);
    const share = expectDrawn(full, await page.screenshot({timeout: SECONDS * 1000}));
    await page.evaluate(() => window.cloudgen.showClouds(true));

    await viewButtonsWork(page, picturePath);
    await controlsWork(page, folder);
    await noSeriousFindings(page);
    expect(!seen.errors.length, `console: ${seen.errors.join(' | ')}`);
    const fetched = seen.requests.filter((request) => request !== address && !/^(data|blob):/.test(request));
    expect(!fetched.length, `the page asked for ${fetched.join(', ')}`);
    const {puffs, divisor} = await page.evaluate(() => window.cloudgen.drawing);
    return `${puffs} puffs at 1/${divisor} while moving, ready after ${ready} s, ${share} of the picture are cloud`;
  });
}
