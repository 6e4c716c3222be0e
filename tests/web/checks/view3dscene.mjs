// SPDX-License-Identifier: Apache-2.0
import {execFile, execFileSync} from 'node:child_process';
import {mkdir, readFile} from 'node:fs/promises';
import {dirname} from 'node:path';
import {expectDrawn} from '../lib/picture.mjs';
import {Skip} from '../lib/runner.mjs';

function need(program) {
  try {
    execFileSync('which', [program], {stdio: 'ignore'});
  } catch {
    throw new Skip(`${program} is not installed`);
  }
}

async function screenshot(file, png) {
  await mkdir(dirname(png), {recursive: true});
  await new Promise((resolve, reject) =>
    execFile(
      'xvfb-run',
      ['-a', '-s', '-screen 0 1024x768x24', 'view3dscene', file, '--hide-extras', '--hide-menu', '--no-sound', '--geometry', '960x540', '--screenshot', '1', png],
      {timeout: 80_000},
      (error, _, said) => (error ? reject(new Error(error.killed ? 'view3dscene took over 80 s' : said.trim().split('\n').at(-1) || error.message)) : resolve()),
    ),
  );
  return readFile(png);
}

export async function view3dsceneDraws(file, emptyFile, picturePath) {
  need('view3dscene');
  need('xvfb-run');
  const full = await screenshot(file, `${picturePath}.png`);
  const empty = await screenshot(emptyFile, `${picturePath}.empty.png`);
  return `${expectDrawn(full, empty)} of the picture are cloud`;
}
