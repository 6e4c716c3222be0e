// SPDX-License-Identifier: Apache-2.0
// Nobody shall see where X_ITE goes from one level of a cloud to the next: the cloud of a scene whose levels reach furthest, alone before black and before
// white, from just within and just beyond each of its LOD's ranges.
import pngjs from 'pngjs';
import {withPage} from '../lib/browser.mjs';
import {linear, luminance} from '../lib/light.mjs';
import {keep} from '../lib/picture.mjs';
import {rotationAlong} from '../lib/placed.mjs';
import {Skip} from '../lib/runner.mjs';
import {until} from './drawing.mjs';

const SIZE = {width: 240, height: 180}, SECONDS = 120;
const JUST = 0.002;
/** From the side and a little above; level pictures are not seen edge-on. */
const TOWARDS_VIEWER = [0.77, 0.5, 0.4];
/** Shares of their own. A cloud in full shows another side than its picture, and one sees only some of it: who is in it sees nothing else, and
 * only luminance tells. */
const MOST_OF_PICTURES = {cover: 0.02, luminance: 0.03}, MOST_INTO_FULL = {cover: 0.05, luminance: 0.08};

/** Runs in the page: leaves the cloud whose levels reach furthest, and tells of it. X_ITE 15 counts ranges in metres of the scene, whatever the scale. */
function leaveWidest(wantsFull) {
  const scene = X3D.getBrowser(document.getElementById('canvas')).currentScene;
  const typeOf = (node) => node.getNodeTypeName();
  const isPicture = (level) => level.getNodeName().startsWith('Picture_');
  const turns = (level) => typeOf(level.children[0]) === 'Transform';
  /** What its levels are; a full cloud whose picture lies level is not asked for: from within, that is edge-on. */
  const kindsOf = (lod) =>
    [...lod.children].map((level, i) => (isPicture(level) ? 'picture' : level.children.length > 0 && turns(lod.children[i + 1]) ? 'full' : 'none'));
  let widest = null;
  const visit = (nodes) => {
    for (const node of nodes) {
      const type = typeOf(node);
      const lod = type === 'Transform' ? [...node.children].find((child) => typeOf(child) === 'LOD') : null;
      if (lod && kindsOf(lod).some((kind, i, kinds) => kind === (wantsFull ? 'full' : 'picture') && kinds[i + 1] === 'picture')) {
        const reach = lod.range[lod.range.length - 1] * node.scale.x;
        if (!widest || reach > widest.reach) widest = {node, lod, reach};
      }
      if (['Transform', 'Group', 'LOD', 'Switch'].includes(type)) visit(node.children);
    }
  };
  visit(scene.rootNodes);
  if (!widest) return null;
  const {node, lod} = widest;
  const ranges = [...lod.range];
  const first = (type) => [...scene.rootNodes].find((root) => typeOf(root) === type);
  const [background, navigation, view] = [first('Background'), first('NavigationInfo'), first('Viewpoint')];
  scene.rootNodes = new X3D.MFNode(background, navigation, view, node);
  navigation.visibilityLimit = 3 * ranges.at(-1);
  for (const field of ['skyAngle', 'groundAngle']) background[field] = new X3D.MFFloat();
  background.groundColor = new X3D.MFColor();
  window.seeFrom = (eye, rotation, fieldOfView, grey) => {
    view.position = new X3D.SFVec3f(...eye);
    view.orientation = new X3D.SFRotation(...rotation);
    view.fieldOfView = fieldOfView;
    background.skyColor = new X3D.MFColor(new X3D.SFColor(grey, grey, grey));
  };
  window.levelNow = () => lod.level_changed;
  /** Of the coarsest picture, from side to side. */
  const widthOf = (level) => {
    const shapes = [];
    const find = (nodes) => [...nodes].forEach((child) => (typeOf(child) === 'Shape' ? shapes.push(child) : find(child.children)));
    find(level.children);
    const across = (axis) => shapes.flatMap((shape) => [...shape.geometry.coord.point].map((point) => point[axis]));
    return Math.max(...['x', 'y', 'z'].map((axis) => Math.max(...across(axis)) - Math.min(...across(axis))));
  };
  const width = node.scale.x * widthOf([...lod.children].findLast(isPicture));
  const center = ['x', 'y', 'z'].map((axis) => node.translation[axis] + node.scale.x * lod.center[axis]);
  return {name: lod.getNodeName(), center, ranges, width, kinds: kindsOf(lod)};
}

/** Mean opacity, and luminance where there is some, of a picture before black and before white. */
function meansOf(blackPng, whitePng) {
  const [black, white] = [blackPng, whitePng].map((png) => pngjs.PNG.sync.read(png).data);
  let [cover, light] = [0, 0];
  for (let i = 0; i < black.length; i += 4) {
    const sum = (data) => data[i] + data[i + 1] + data[i + 2];
    const alpha = Math.min(1, Math.max(0, 1 - (sum(white) - sum(black)) / 765));
    if (alpha < 0.02) continue;
    cover += alpha;
    light += alpha * luminance([0, 1, 2].map((k) => linear(Math.min(1, black[i + k] / 255 / alpha))));
  }
  return {cover: (4 * cover) / black.length, luminance: light / cover};
}

async function seenFrom(page, cloud, distance, picturePath) {
  const eye = cloud.center.map((value, i) => value + distance * TOWARDS_VIEWER[i]);
  // As wide as the picture, or all of it if one is in the cloud.
  const fieldOfView = Math.min(Math.PI / 4, 2 * Math.atan((0.6 * cloud.width) / distance));
  const shots = [];
  for (const grey of [0, 1]) {
    await page.evaluate((view) => window.seeFrom(...view), [eye, rotationAlong(TOWARDS_VIEWER.map((value) => -value)), fieldOfView, grey]);
    await page.waitForTimeout(400);
    shots.push(await page.screenshot({timeout: SECONDS * 1000}));
  }
  await keep(picturePath, shots[0]);
  return {level: await page.evaluate(() => window.levelNow()), ...meansOf(...shots)};
}

/** `address`: of the X_ITE page with a scene. `wantsFull`: a cloud that is there in full, and only where that begins. */
export async function levelsSwitchUnseen(address, wantsFull, picturePath) {
  return withPage(SIZE, async (page) => {
    await page.goto(address, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
    await until(() => page.evaluate(() => window.state?.ready || window.state?.error), SECONDS, 'the viewer is not ready');
    const cloud = await page.evaluate(leaveWidest, wantsFull);
    if (!cloud) throw new Skip('no cloud has such levels');
    const said = [];
    for (const [i, range] of cloud.ranges.entries()) {
      if (cloud.kinds[i] !== (wantsFull ? 'full' : 'picture') || cloud.kinds[i + 1] !== 'picture') continue;
      const within = await seenFrom(page, cloud, (1 - JUST) * range, `${picturePath}.${i}.within.png`);
      const beyond = await seenFrom(page, cloud, (1 + JUST) * range, `${picturePath}.${i}.beyond.png`);
      if (within.level !== i || beyond.level !== i + 1) throw new Error(`${cloud.name}: levels ${within.level} and ${beyond.level} about its range ${i}`);
      if (!(within.cover > 0.05)) throw new Error(`${cloud.name}: nothing is seen ${range} m away`);
      const most = wantsFull ? MOST_INTO_FULL : MOST_OF_PICTURES;
      for (const what of ['cover', 'luminance']) {
        const jump = beyond[what] / within[what] - 1;
        const words = `${what} ${jump < 0 ? '' : '+'}${(100 * jump).toFixed(1)} %`;
        said.push(words);
        if (!(Math.abs(jump) <= most[what])) throw new Error(`${cloud.name}: ${words} beyond ${range} m`);
      }
    }
    return `${cloud.name}: ${said.join(', ')}`;
  });
}
