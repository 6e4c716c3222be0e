// SPDX-License-Identifier: Apache-2.0
// The same sky from the same place, as several viewers draw it.
import {execFileSync} from 'node:child_process';
import {readFile} from 'node:fs/promises';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {until} from '../checks/drawing.mjs';
import {withPage} from './browser.mjs';
import {serve} from './server.mjs';

const SECONDS = 120;
const FIELD_OF_VIEW = Math.PI / 4;

/** Runs `cloudgen preview`; a view is {eye, target}, each longitude, latitude, metres. */
export function previewPicture(program, folder, file, size, {eye, target}) {
  execFileSync(program, ['preview', folder, '-o', file, '--size', `${size.width}x${size.height}`, `--view=${eye}:${target}`, '--quiet']);
  return readFile(file);
}

/** Draws the page; returns the picture and the place in metres of the scene. */
export function pagePicture(folder, size, view) {
  return withPage(size, async (page) => {
    await page.goto(pathToFileURL(join(folder, 'index.html')).href);
    await until(() => page.evaluate(() => window.cloudgenReady || window.cloudgenError), SECONDS, 'the page is not ready');
    const place = await page.evaluate(({eye, target}) => {
      const viewer = window.cloudgen;
      const inScene = ([longitude, latitude, height]) => {
        const [x, z] = viewer.frame.toScene(longitude, latitude);
        return [x, height, z];
      };
      const place = {eye: inScene(eye), target: inScene(target)};
      viewer.place(place.eye, place.target);
      return place;
    }, view);
    await page.addStyleTag({content: '* {visibility: hidden} canvas {visibility: visible !important}'});
    const still = () => page.evaluate(() => window.cloudgen.isAtRest);
    await until(still, SECONDS, 'the page still draws');
    return {place, png: await page.screenshot()};
  });
}

/** X3D's rotation that looks along a direction, upright. */
export function rotationAlong([x, y, z]) {
  const half = [Math.atan2(-x, -z) / 2, Math.atan2(y, Math.hypot(x, z)) / 2];
  const [cy, sy, cp, sp] = [Math.cos(half[0]), Math.sin(half[0]), Math.cos(half[1]), Math.sin(half[1])];
  const axis = [cy * sp, sy * cp, -sy * sp];
  const sine = Math.hypot(...axis);
  return [...(sine > 1e-9 ? axis.map((a) => a / sine) : [0, 1, 0]), 2 * Math.atan2(sine, cy * cp)];
}

const orientation = ({eye, target}) => rotationAlong(target.map((value, i) => value - eye[i])).join(' ');

/** `background` (0..1, grey) replaces the sky where it is given. */
export async function xitePicture(folder, size, place, background) {
  let x3d = await readFile(join(folder, 'scene.x3d'), 'utf8');
  if (background !== undefined) {
    const grey = Array(3).fill(background).join(' ');
    x3d = x3d.replace(/<Background [^>]*>/, `<Background skyColor="${grey}"/>`).replace(/<Fog [^>]*>/, '');
  }
  const viewpoint = `<Viewpoint position="${place.eye.join(' ')}" orientation="${orientation(place)}" fieldOfView="${FIELD_OF_VIEW}"/>`;
  const server = await serve(folder, {'/scene/placed.x3d': x3d.replace('<Viewpoint', `${viewpoint}<Viewpoint`)});
  try {
    return await withPage(size, async (page) => {
      await page.goto(`${server.address}/pages/xite.html?scene=/scene/placed.x3d`);
      await until(() => page.evaluate(() => window.state.ready || window.state.error), SECONDS, 'X_ITE is not ready');
      await page.waitForTimeout(6000);
      return page.screenshot({timeout: SECONDS * 1000});
    });
  } finally {
    server.close();
  }
}

/** three.js with a glTF file of the folder; `background` as above. */
export async function threePicture(folder, file, size, place, background) {
  const server = await serve(folder);
  const query = new URLSearchParams({scene: `/scene/${file}`, eye: place.eye, target: place.target, ...(background === undefined ? {} : {background})});
  try {
    return await withPage(size, async (page) => {
      await page.goto(`${server.address}/pages/three.html?${query}`);
      await until(() => page.evaluate(() => window.state.ready || window.state.error), SECONDS, 'three.js is not ready');
      return page.screenshot({timeout: SECONDS * 1000});
    });
  } finally {
    server.close();
  }
}
