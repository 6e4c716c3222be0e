// SPDX-License-Identifier: Apache-2.0
// The viewpoint of --fly in X_ITE: it stands still until it is chosen, then flies at its speed along its places.
import {withPage} from '../lib/browser.mjs';
import {until} from './drawing.mjs';

const SECONDS = 90, METERS_PER_SECOND = 200;

const distance = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

/** How far from a place the polyline through others is. */
function distanceToWay(place, way) {
  const toLeg = (from, to) => {
    const leg = to.map((value, i) => value - from[i]);
    const along = leg.reduce((sum, value, i) => sum + value * (place[i] - from[i]), 0) / leg.reduce((sum, value) => sum + value * value, 0);
    const share = Math.min(1, Math.max(0, along));
    return distance(place, from.map((value, i) => value + share * leg[i]));
  };
  return Math.min(...way.slice(1).map((to, i) => toLeg(way[i], to)));
}

/** `address`: of the X_ITE page with a scene that has the viewpoint View_Flight. */
export async function fliesOnceChosen(address) {
  return withPage({width: 240, height: 135}, async (page) => {
    await page.goto(address, {waitUntil: 'domcontentloaded', timeout: SECONDS * 1000});
    await until(() => page.evaluate(() => window.state?.ready || window.state?.error), SECONDS, 'the viewer is not ready');
    const read = () =>
      page.evaluate(() => {
        const scene = X3D.getBrowser(document.getElementById('canvas')).currentScene;
        const view = scene.getNamedNode('View_Flight'), clock = scene.getNamedNode('Flight_Clock'), places = scene.getNamedNode('Flight_Places');
        return {place: [...view.position], elapsed: clock.elapsedTime, active: clock.isActive, way: Array.from(places.keyValue, (place) => [...place])};
      });
    const before = await read();
    await page.waitForTimeout(1000);
    if (before.active || distance((await read()).place, before.place) > 0) throw new Error('it flies before it is chosen');
    await page.evaluate(() => (X3D.getBrowser(document.getElementById('canvas')).currentScene.getNamedNode('View_Flight').set_bind = true));
    await until(async () => (await read()).elapsed > 2, SECONDS, 'it does not fly');
    const after = await read();
    const flown = distance(after.place, after.way[0]), expected = METERS_PER_SECOND * after.elapsed;
    if (Math.abs(flown / expected - 1) > 0.05) throw new Error(`it flew ${flown.toFixed(0)} m in ${after.elapsed.toFixed(1)} s`);
    const off = distanceToWay(after.place, after.way);
    if (off > 5) throw new Error(`it is ${off.toFixed(0)} m off its way`);
    return `${flown.toFixed(0)} m in ${after.elapsed.toFixed(1)} s, ${off.toFixed(1)} m off its way`;
  });
}
