// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {looking, type Camera} from '../src/camera';
import {floatOfHalf, PackView, rotationOf} from '../src/pack/pack_view';
import {bytesOf} from '../src/pack/quads';
import {chosenLevel, farFirst, sortedByKey} from '../src/pack/selection';
import {levelOf, SkyMaker, type ListOrder} from '../src/pack/sky_maker';
import {Timeline} from '../src/pack/timeline';
import {madePack} from './made_pack';

const camera: Camera = looking([0, 1500, 0], [0, 0, -1], Math.PI / 4, 1280, 720);
const order = (more: Partial<ListOrder> = {}): ListOrder => ({
  camera, shape: 'quads', marginRadians: 0, marginMeters: 0, detail: {errorPixels: 3, hysteresis: 0.15, mostPuffs: 1e6}, ...more,
});
const ahead = {x: 0, y: 1000, z: -4000};

function skyOf(...clouds: {x: number; y: number; z: number}[]): SkyMaker {
  const sky = new SkyMaker(madePack({clouds}));
  sky.setSun({azimuthDegrees: 180, elevationDegrees: 45});
  return sky;
}

test('half floats and turns are read', () => {
  assert.equal(floatOfHalf(0x5640), 100);
  assert.equal(floatOfHalf(0xc000), -2);
  const turn = rotationOf((3 << 30) | (512 << 20) | (512 << 10) | 512);
  assert.ok(Math.abs(turn[3] - 1) < 1e-5 && Math.abs(turn[0]) < 1e-3);
});

test('a pack is read where it lies', () => {
  const pack = PackView.open(madePack({clouds: [ahead, {x: 50, y: 7000, z: 20}]}));
  assert.equal(pack.clouds.count, 2);
  assert.equal(pack.clouds.floats[7], 7000);
  assert.deepEqual(pack.archetypes[0].levels.map((level) => level.count), [8, 2, 1]);
  assert.deepEqual([...pack.centers.slice(3 * 7, 3 * 8)], [500, 1000, 500]);
  assert.ok(Math.abs(pack.covariances[0] - 10_000) < 20);
  assert.deepEqual(pack.record(1), {id: (7n << 32n) | (2n << 24n) | 1n, baseMeters: 7000, topMeters: 8000, opticalDepth: 10, rule: 'made', layer: 2});
});

test('what is no pack, cut short, newer or out of range is refused in one line', () => {
  const whole = madePack({clouds: [ahead]});
  const refused = (bytes: ArrayBuffer, why: RegExp) => assert.throws(() => PackView.open(bytes), (error: Error) => why.test(error.message) && !error.message.includes('\n'));
  refused(new ArrayBuffer(40), /no runtime pack/);
  for (const share of [0.1, 0.3, 0.6, 0.9]) refused(whole.slice(0, Math.floor(share * whole.byteLength / 16) * 16), /scene\.cgpack/);
  refused(madePack({clouds: [ahead], version: 99}), /newer version/);
  refused(madePack({clouds: [ahead], archetypeOfFirst: 3}), /no shape/);
});

test('a pack with any byte changed is refused or read, and never hangs', () => {
  const whole = new Uint8Array(madePack({clouds: [ahead, {x: 900, y: 1000, z: -6000}]}));
  for (let at = 0; at < whole.length; at += 3) {
    const bytes = whole.slice();
    bytes[at] ^= 0xff;
    try {
      const sky = new SkyMaker(bytes.buffer);
      sky.setSun({azimuthDegrees: 180, elevationDegrees: 45});
      sky.list(order({detail: {errorPixels: 3, hysteresis: 0.15, mostPuffs: 1000}}));
    } catch (error) {
      assert.match((error as Error).message, /scene\.cgpack/, `byte ${at}`);
    }
  }
});

test('clouds behind the eye and beside the view are left out', () => {
  assert.equal(skyOf({x: 0, y: 1000, z: 4000}).list(order()).count, 0);
  assert.equal(skyOf({x: 9000, y: 1000, z: -4000}).list(order()).count, 0);
  assert.equal(skyOf(ahead).list(order()).count, 8);
});

test('far clouds have fewer puffs, and a level is kept until the limit is clearly passed', () => {
  assert.equal(skyOf({x: 0, y: 1000, z: -19_000}).list(order({detail: {errorPixels: 6, hysteresis: 0.15, mostPuffs: 1e6}})).count, 2);
  const levels = {levels: [{first: 0, count: 8, errorMeters: 0}, {first: 8, count: 2, errorMeters: 60}]};
  const pixelsPerMeter = 3 / 60;
  assert.equal(chosenLevel(levels, 255, 1.01 * pixelsPerMeter, 3, 0.15), 0);
  assert.equal(chosenLevel(levels, 1, 1.1 * pixelsPerMeter, 3, 0.15), 1, 'stays coarse');
  assert.equal(chosenLevel(levels, 0, 0.9 * pixelsPerMeter, 3, 0.15), 0, 'stays fine');
  assert.equal(chosenLevel(levels, 1, 1.2 * pixelsPerMeter, 3, 0.15), 0);
});

test('puffs come from far to near', () => {
  const keys = Uint16Array.from([5, 3, 60_000, 3, 0].map((value) => value));
  assert.deepEqual([...sortedByKey(keys, 5)], [4, 1, 3, 0, 2]);
  assert.ok(farFirst(100) > farFirst(10_000));
  const list = skyOf(ahead, {x: 0, y: 1000, z: -9000}).list(order());
  const corners = new Float32Array(list.buffer);
  const words = bytesOf('quads') / 4;
  const middle = (i: number) => (corners[words * i + 2] + corners[words * i + 17]) / 2;
  for (let i = 1; i < list.count; ++i) assert.ok(middle(i) >= middle(i - 1) - 300, `${middle(i - 1)} before ${middle(i)}`);
});

test('a budget is kept, and what is left is wider', () => {
  const clouds = Array.from({length: 60}, (_, i) => ({x: 60 * (i - 30), y: 1000, z: -6000}));
  const most = (mostPuffs: number) => order({detail: {errorPixels: 3, hysteresis: 0, mostPuffs}});
  const [all, some] = [skyOf(...clouds).list(most(1e6)), skyOf(...clouds).list(most(120))];
  assert.equal(all.count, 480);
  assert.ok(some.count > 60 && some.count < 180, String(some.count));
  assert.ok(some.fillPixels / some.count > 1.5 * (all.fillPixels / all.count));
});

test('quads face the eye, as wide as the puff reaches', () => {
  const {buffer} = skyOf({x: 0, y: 1000, z: -5000}).list(order({camera: looking([0, 1500, 0], [0, 0, -1], Math.PI / 4, 1280, 720)}));
  const f = new Float32Array(buffer);
  const width = Math.hypot(f[5] - f[0], f[6] - f[1], f[7] - f[2]);
  assert.ok(Math.abs(width - 2 * 2.2 * 100) < 2, String(width));
});

test('layers hide genera and levels', () => {
  const sky = skyOf(ahead);
  sky.setLayers({hiddenGenera: ['Cu'], hiddenLevels: []});
  assert.equal(sky.list(order()).count, 0);
  sky.setLayers({hiddenGenera: [], hiddenLevels: ['low']});
  assert.equal(sky.list(order()).count, 0);
  sky.setLayers({hiddenGenera: [], hiddenLevels: ['high']});
  assert.equal(sky.list(order()).count, 8);
  assert.deepEqual([1999, 2000, 6000].map(levelOf), ['low', 'middle', 'high']);
});

test('a ray finds the cloud that it meets, the nearer of two', () => {
  const sky = skyOf({x: 0, y: 1000, z: -9000}, ahead);
  const towards = (x: number, y: number, z: number): [number, number, number] => {
    const long = Math.hypot(x, y, z);
    return [x / long, y / long, z / long];
  };
  assert.equal(sky.pick([0, 1500, 0], towards(500, -500, -3500))?.cloud, 1);
  assert.equal(sky.pick([0, 1500, 0], towards(0, 1, 0)), null);
});

test('the sun lights clouds, and its colour follows its height', () => {
  const sky = skyOf(ahead);
  const redAt = (elevationDegrees: number) => {
    sky.setSun({azimuthDegrees: 180, elevationDegrees});
    return sky.lighting.colors[4 * sky.lighting.firstColor(0, 0)];
  };
  assert.ok(redAt(80) > redAt(-8), `${redAt(80)} ${redAt(-8)}`);
});

test('clouds move between keyframes', () => {
  const timeline = new Timeline(PackView.open(madePack({clouds: [ahead], shift: [600, 0, 0]})));
  timeline.setTime(1800);
  assert.equal(timeline.clouds.floats[0], 300);
  timeline.setTime(1e9);
  assert.equal(timeline.clouds.floats[0], 600);
  assert.ok(timeline.slackMeters >= 600);
});

test('a cloud that is not at both keyframes is not there between them', () => {
  const timeline = new Timeline(PackView.open(madePack({clouds: [ahead, ahead, ahead], shift: [600, 0, 0], there: [[0, 1], [0, 2]]})));
  const there = (seconds: number) => {
    timeline.setTime(seconds);
    return [0, 1, 2].map((i) => timeline.clouds.factor(i) > 0);
  };
  assert.deepEqual(there(1800), [true, false, false]);
  assert.deepEqual([timeline.clouds.floats[0], timeline.clouds.floats[6]], [300, 0]);
  assert.deepEqual(there(0), [true, true, false]);
  const refused = (there: [number[], number[]]) => assert.throws(() => PackView.open(madePack({clouds: [ahead, ahead], shift: [1, 0, 0], there})), /keyframe names/);
  refused([[0, 1], [0, 2]]);
  refused([[0, 1], [1, 0]]);
});

test('between two lists the corners of puffs go on as their clouds do', () => {
  const sky = new SkyMaker(madePack({clouds: [ahead], shift: [600, 0, -300]}));
  sky.setSun({azimuthDegrees: 180, elevationDegrees: 45});
  const listAt = (seconds: number) => {
    sky.setTime(seconds);
    return sky.list(order({shape: 'triangles', marginRadians: 0.5}));
  };
  const [early, late] = [listAt(900), listAt(2700)];
  assert.equal(early.count, late.count);
  assert.deepEqual({...early.moment}, {seconds: 900, from: 0, to: 3600});
  const [from, to, motion] = [early.buffer, late.buffer, early.motions!].map((buffer) => new Float32Array(buffer));
  // The puff nearest to the eye is the last of both lists; it turns a little as it goes by.
  const last = 12 * (early.count - 1);
  for (const k of [0, 2]) assert.ok(Math.abs(from[last + k] + 1800 * motion[9 * (early.count - 1) + k] - to[last + k]) < 60, `${k}`);
});

test('the shadow of a cloud lies away from the sun', () => {
  const sky = skyOf({x: 5000, y: 1000, z: 5000});
  const light = sky.sunlight({lower: [0, 0], width: 10_000, depth: 10_000, groundMeters: 0});
  let darkest = 0;
  for (let i = 0; i < light.length; ++i) if (light[i] < light[darkest]) darkest = i;
  const south = (Math.floor(darkest / 512) / 512) * 10_000;
  assert.ok(light[darkest] < 250 && south > 3000 && south < 4500, `${south}`);
});
