// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {clarity} from '../src/air';
import {looking, projected, rayThrough} from '../src/camera';
import {cellOf} from '../src/card';
import {flightLevel, heightText} from '../src/heights';
import {distance, normalized, type Vec3} from '../src/math';
import {FlightPath} from '../src/path';
import {orbited, poseTowards, targetOf, zoomed} from '../src/pose';
import {directionTo, type Daylight} from '../src/pack/daylight';
import {SKY_COLUMNS, SKY_ROWS, SkyTable} from '../src/pack/sky_table';
import {Quality} from '../src/quality';
import {TimePlayer} from '../src/time_player';
import {minuteOfDay, sunAt} from '../src/sun_clock';

test('heights in metres, feet and flight levels', () => {
  assert.equal(flightLevel(10_000), 'FL328');
  assert.equal(heightText(1524), '1,500 m / 5,000 ft / FL050');
});

test('the sun stands where almanacs have it', () => {
  // Greenwich, solstice noon of 2026: 90 - 51.48 + 23.44 degrees high, in the south.
  const noon = sunAt(Date.UTC(2026, 5, 21, 12, 2), 0, 51.48);
  assert.ok(Math.abs(noon.elevationDegrees - 61.96) < 0.05, String(noon.elevationDegrees));
  assert.ok(Math.abs(noon.azimuthDegrees - 180) < 0.6, String(noon.azimuthDegrees));
  const morning = sunAt(Date.UTC(2026, 2, 20, 6), 0, 0);
  assert.ok(Math.abs(morning.elevationDegrees) < 2.5 && Math.abs(morning.azimuthDegrees - 90) < 1, 'equinox, east at six');
  assert.equal(minuteOfDay(Date.UTC(2026, 0, 1, 23, 59)), 1439);
});

test('a place on the screen is seen along the ray through it', () => {
  const camera = looking([10, 500, 20], normalized([0.6, -0.2, -0.77]), Math.PI / 4, 1280, 720);
  const ray = rayThrough(camera, 0.3, 0.7);
  const seen = projected(camera, [10 + 900 * ray[0], 500 + 900 * ray[1], 20 + 900 * ray[2]])!;
  assert.ok(Math.abs(seen.u - 0.3) < 1e-3 && Math.abs(seen.v - 0.7) < 1e-3);
});

test('an orbit keeps its distance and stays above the ground', () => {
  const pose = poseTowards([0, 5000, 10_000], [0, 1000, 0]);
  const turned = orbited(pose, 1, 0.1, 20);
  assert.ok(distance(targetOf(turned), [0, 1000, 0]) < 1e-6 * 1e4);
  assert.ok(Math.abs(distance(turned.eye, [0, 1000, 0]) - pose.reach) < 1e-6 * 1e4);
  assert.ok(orbited(pose, 0, 3, 20).eye[1] >= 19.9);
  assert.equal(zoomed(pose, 0.5, 300, 1e6).reach, pose.reach / 2);
});

test('a flight path goes through its places at an even pace', () => {
  const places: Vec3[] = [[0, 100, 0], [1000, 100, 0], [1000, 100, 1000]];
  const path = new FlightPath(places, false);
  assert.deepEqual(path.placeAt(0), places[0]);
  assert.deepEqual(path.placeAt(1e9), places[2]);
  let nearest = Infinity;
  for (let s = 0; s < path.lengthMeters; s += 5) nearest = Math.min(nearest, distance(path.placeAt(s), places[1]));
  assert.ok(nearest < 5);
  assert.throws(() => new FlightPath([[0, 0, 0]], false));
});

test('air takes less high up, and all of a colour far away', () => {
  assert.ok(clarity(100_000, 9000, 9000) > clarity(100_000, 0, 0));
  assert.ok(clarity(1e7, 0, 0) < 1e-6);
  assert.ok(Math.abs(clarity(1000, 500, 500.001) - clarity(1000, 500, 520)) < 1e-3, 'no jump at a level line');
});

test('the pace gets coarser when frames are slow, and is not tried finer at once again', () => {
  const quality = new Quality(8, 3);
  for (let i = 0; i < 4; ++i) quality.frame(0.08);
  assert.equal(quality.step, 4);
  for (let i = 0; i < 24; ++i) quality.frame(0.016);
  assert.equal(quality.step, 3);
  for (let i = 0; i < 4; ++i) quality.frame(0.08);
  for (let i = 0; i < 30; ++i) quality.frame(0.016);
  assert.equal(quality.step, 4, 'it was too slow a moment ago');
});

test("a cloud's number tells its cell", () => {
  assert.deepEqual(cellOf({id: (1234n << 32n) | (3n << 24n) | 56n}), {cell: 1234n, layer: 3, number: 56});
});

test('a sky is played from its time on, and at the end from its start', () => {
  const shown: number[] = [];
  let next: ((milliseconds: number) => void) | null = null;
  const player = new TimePlayer(0, 3600, 1800, (seconds) => shown.push(seconds), (step) => (next = step));
  player.speed = 3600;
  player.play();
  for (const now of [5000, 5100, 5200, 9000, 9200]) next!(now);
  // 100 ms a frame; the long wait counts as a quarter of a second.
  assert.deepEqual(shown.map(Math.round), [1800, 2160, 2520, 3420, 0]);
  player.pause();
  next!(9300);
  assert.equal(shown.length, 5);
  player.goTo(9999);
  assert.equal(player.seconds, 3600);
});

test('the sky is blue by day, red towards a sun that has set, and dark blue at night', () => {
  const skyUnder = (elevationDegrees: number, sunlight: number) => {
    const night: Vec3 = [0.005, 0.0065, 0.011];
    const daylight: Daylight = {zenith: night, horizon: night, ground: night, ambient: [0.1, 0.1, 0.1], bounce: night, suns: [[sunlight, sunlight, sunlight]]};
    const {colors} = new SkyTable(daylight, directionTo({azimuthDegrees: 250, elevationDegrees}));
    const at = (row: number, column: number) => [...colors.subarray(4 * (row * SKY_COLUMNS + column)).subarray(0, 3)];
    return {zenith: at(SKY_ROWS - 1, SKY_COLUMNS - 1), towards: at(4, 2), away: at(4, SKY_COLUMNS - 1)};
  };
  const [day, dusk, night] = [skyUnder(45, 1), skyUnder(-5, 0), skyUnder(-25, 0)];
  assert.ok(day.zenith[2] > 1.3 * day.zenith[0] && day.zenith[2] > 120, `${day.zenith}`);
  assert.ok(dusk.towards[0] > 1.2 * dusk.towards[2] && dusk.towards[0] > 1.5 * dusk.away[0], `${dusk.towards} ${dusk.away}`);
  assert.ok(dusk.zenith[2] > dusk.zenith[0], `${dusk.zenith}`);
  for (const color of [night.zenith, night.towards, night.away]) assert.ok(color[2] > color[0] && color[2] > 15 && color[2] < 60, `${color}`);
});
