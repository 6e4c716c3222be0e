// SPDX-License-Identifier: Apache-2.0
// What checks of the page ask it.
import {until} from './drawing.mjs';

export const SECONDS = 120;

export function expect(condition, what) {
  if (!condition) throw new Error(what);
}

export const position = (page) => page.evaluate(() => window.cloudgen.cameraPosition);
export const frames = (page) => page.evaluate(() => window.cloudgen.frames);
export const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Waits for a picture that is complete and stays. */
export async function rest(page) {
  await until(() => page.evaluate(() => window.cloudgen.isAtRest), SECONDS, 'the page still draws, though nothing changes,');
}

/** Sets a slider as a hand does. */
export async function slide(page, id, value) {
  await page.$eval(`#${id}`, (slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event('input', {bubbles: true}));
  }, value);
}

/** Where on the page the place of a cloud of the pack is seen, and which cloud; one that stands well inside the view. */
export async function cloudOnScreen(page) {
  return page.evaluate(() => {
    const {pack, camera, canvas, exaggeration} = window.cloudgen;
    const {clouds, archetypes} = pack;
    const right = [-camera.forward[2], 0, camera.forward[0]];
    const level = Math.hypot(right[0], right[2]);
    right[0] /= level;
    right[2] /= level;
    const up = [right[1] * camera.forward[2] - right[2] * camera.forward[1], right[2] * camera.forward[0] - right[0] * camera.forward[2], right[0] * camera.forward[1] - right[1] * camera.forward[0]];
    const focal = (0.5 * canvas.clientHeight) / Math.tan(camera.fieldRadians / 2);
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let best = null;
    for (let i = 0; i < clouds.count; ++i) {
      const info = archetypes[clouds.archetype(i)];
      const [x, y, z] = clouds.floats.subarray(6 * i, 6 * i + 3);
      const away = [x - camera.eye[0], (y + info.middleMeters * clouds.scale(i)) * exaggeration - camera.eye[1], z - camera.eye[2]];
      const depth = dot(away, camera.forward);
      const [u, v] = [canvas.clientWidth / 2 + (focal * dot(away, right)) / depth, canvas.clientHeight / 2 - (focal * dot(away, up)) / depth];
      if (depth < 100 || document.elementFromPoint(u, v) !== canvas) continue;
      const opacity = clouds.factor(i) * info.opticalDepth;
      const score = opacity > 1 ? info.widthMeters / depth : 0;
      if (!best || score > best.score) best = {x: u, y: v, cloud: i, score};
    }
    return best;
  });
}
