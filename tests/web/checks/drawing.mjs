// SPDX-License-Identifier: Apache-2.0
// A page of ours opens a scene in somebody's viewer; the clouds must be seen.
import {withPage} from '../lib/browser.mjs';
import {expectDrawn, keep} from '../lib/picture.mjs';

const SIZE = {width: 960, height: 540};
const SECONDS = 90;

/** Waits until `test(page)` is true; by asking, because a page may forbid evaluation of texts. */
export async function until(test, seconds, what) {
  const end = Date.now() + seconds * 1000;
  while (!(await test())) {
    if (Date.now() > end) throw new Error(`${what} after ${seconds} s`);
    await new Promise((resolve) => setTimeout(resolve, 150));
  }
}

/** What a page draws once it is ready, and, if nodes of some types are to be removed, then. */
export async function picture(address, picturePath, {settleMilliseconds, remove}) {
  return withPage(SIZE, async (page) => {
    await page.goto(address, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
    await until(() => page.evaluate(() => window.state?.ready || window.state?.error), SECONDS, 'the viewer is not ready');
    const error = await page.evaluate(() => window.state.error);
    if (error) throw new Error(error);
    const shot = async (suffix) => {
      await page.waitForTimeout(settleMilliseconds);
      const png = await page.screenshot({timeout: SECONDS * 1000});
      await keep(`${picturePath}${suffix}.png`, png);
      return png;
    };
    const full = await shot('');
    if (!remove) return {full};
    await page.evaluate((types) => window.removeClouds(types), remove);
    return {full, empty: await shot('.empty')};
  });
}

/** For pages that take the clouds out themselves. */
export async function drawsByRemoval(address, picturePath, remove = [], settleMilliseconds = 1500) {
  const {full, empty} = await picture(address, picturePath, {settleMilliseconds, remove});
  return `${expectDrawn(full, empty)} of the picture are cloud`;
}

/** For viewers that need a second file without the clouds. */
export async function drawsByComparison(address, emptyAddress, picturePath, settleMilliseconds = 2000) {
  const {full} = await picture(address, picturePath, {settleMilliseconds});
  const {full: empty} = await picture(emptyAddress, `${picturePath}.empty`, {settleMilliseconds});
  return `${expectDrawn(full, empty)} of the picture are cloud`;
}
