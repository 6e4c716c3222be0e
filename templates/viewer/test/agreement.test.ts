// SPDX-License-Identifier: Apache-2.0
// The page draws the puffs that src/runtime draws: clouds in view, at a time, each in its level of detail. tests/support/list_puffs.cpp
// makes the sky and the lists; CLOUDGEN_LIST_PUFFS names the program, as ctest does.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import {looking} from '../src/camera';
import type {Vec3} from '../src/math';
import {PackView} from '../src/pack/pack_view';
import {Selection} from '../src/pack/selection';
import {Timeline} from '../src/pack/timeline';

interface Drawn {
  seconds: number;
  eye: Vec3;
  forward: Vec3;
  width: number;
  height: number;
  fieldRadians: number;
  marginRadians: number;
  marginMeters: number;
  errorPixels: number;
  hysteresis: number;
  /** Cloud and puff, in any order. */
  puffs: [number, number][];
}

const program = process.env.CLOUDGEN_LIST_PUFFS;

test('the page draws what the runtime draws', {skip: program ? false : 'CLOUDGEN_LIST_PUFFS is not set'}, () => {
  const folder = mkdtempSync(join(tmpdir(), 'cloudgen-agreement-'));
  try {
    const file = join(folder, 'made.cgpack');
    const lines = execFileSync(program!, [file], {encoding: 'utf8', maxBuffer: 1 << 28}).trim().split('\n');
    const pack = PackView.open(Uint8Array.from(readFileSync(file)).buffer);
    const timeline = new Timeline(pack);
    const selection = new Selection(pack);
    let [all, clouds, levels] = [0, 0, new Set<number>()];
    for (const line of lines) {
      const drawn = JSON.parse(line) as Drawn;
      timeline.setTime(drawn.seconds);
      const {velocities, slackMeters, clouds: moved} = timeline;
      const set = {clouds: moved, velocities, slackMeters, hidden: new Uint8Array(moved.count), exaggeration: 1};
      const camera = looking(drawn.eye, drawn.forward, drawn.fieldRadians, drawn.width, drawn.height);
      const detail = {errorPixels: drawn.errorPixels, hysteresis: drawn.hysteresis, mostPuffs: 1e9};
      selection.select(set, camera, drawn.marginRadians, drawn.marginMeters, detail);
      const here = new Set<string>();
      for (let i = 0; i < selection.count; ++i) here.add(`${selection.clouds[i]} ${selection.puffs[i]}`);
      const there = new Set(drawn.puffs.map(([cloud, puff]) => `${cloud} ${puff}`));
      const apart = [...here].filter((puff) => !there.has(puff)).length + [...there].filter((puff) => !here.has(puff)).length;
      // The runtime counts in single precision: a cloud on the very edge of a limit may fall on its other side.
      assert.ok(apart <= 0.005 * there.size, `${apart} of ${there.size} puffs are drawn by one of both`);
      all += there.size;
      clouds += selection.cloudCount;
      for (const [cloud, puff] of drawn.puffs) levels.add(pack.archetypes[moved.archetype(cloud)].levels.findIndex(({first, count}) => puff >= first && puff < first + count));
    }
    assert.ok(all > 2000 && clouds > 200 && clouds < 0.6 * lines.length * pack.clouds.count && levels.size > 1, `a poor sky: ${all} puffs of ${clouds} clouds, ${levels.size} levels`);
  } finally {
    rmSync(folder, {recursive: true, force: true});
  }
});
