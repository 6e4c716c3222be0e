// SPDX-License-Identifier: Apache-2.0
// What must hold in a pack before anything in it is used: the rules of src/runtime/pack_rules.cpp.
import type {ByteBuffer} from 'flatbuffers';
import {RuntimePack} from '../../dist/schema/cloudgen/pack/runtime-pack';
import type {Vec3} from '../../dist/schema/cloudgen/pack/vec3';

/** The newest version of the format that is read. */
const PACK_VERSION = 1;
const HARMONICS = 16;
const YAW_STEPS = 16;

class Unsound extends Error {}

function demand(condition: boolean, what: string): void {
  if (!condition) throw new Unsound(what);
}

/** The pack in the buffer; throws an Error of one line where it is none, damaged or of a newer version. */
export function requireSound(buffer: ByteBuffer): RuntimePack {
  try {
    demand(buffer.capacity() >= 16 && RuntimePack.bufferHasIdentifier(buffer), 'this is no runtime pack');
    const root = RuntimePack.getRootAsRuntimePack(buffer);
    demand(root.version() >= 1 && root.version() <= PACK_VERSION, 'the pack is of a newer version than is known here');
    requireParts(root, buffer.capacity());
    requireArchetypes(root);
    requireClouds(root);
    requireLight(root);
    requireKeyframes(root, buffer.capacity());
    return root;
  } catch (error) {
    const what = error instanceof Unsound ? error.message : 'the pack is cut short or damaged';
    throw new Error(`scene.cgpack: ${what}. Make it again with: cloudgen build … --formats pack,page`);
  }
}

function isFinite3(v: Vec3 | null): boolean {
  return v !== null && Number.isFinite(v.x()) && Number.isFinite(v.y()) && Number.isFinite(v.z());
}

function isBox(lower: Vec3 | null, upper: Vec3 | null): boolean {
  return isFinite3(lower) && isFinite3(upper) && lower!.x() <= upper!.x() && lower!.y() <= upper!.y() && lower!.z() <= upper!.z();
}

function requireParts(root: RuntimePack, bytes: number): void {
  demand(
    root.sun() !== null && root.tone() !== null && root.tilesLength() > 0 && root.responsesLength() === root.puffsLength(),
    'a part of the pack is missing',
  );
  const runs: [number, number, {bb_pos: number} | null][] = [
    [root.puffsLength(), 20, root.puffs(0)],
    [root.responsesLength(), 36, root.responses(0)],
    [root.instancesLength(), 24, root.instances(0)],
    [root.recordsLength(), 24, root.records(0)],
    [root.tilesLength(), 40, root.tiles(0)],
  ];
  for (const [count, size, first] of runs)
    demand(count === 0 || (first !== null && first.bb_pos % 4 === 0 && first.bb_pos + count * size <= bytes), 'the pack is cut short or damaged');
}

function requireArchetypes(root: RuntimePack): void {
  const puffs = root.puffsLength();
  let used = 0;
  for (let a = 0; a < root.archetypesLength(); ++a) {
    const archetype = root.archetypes(a)!;
    demand(isBox(archetype.lower(), archetype.upper()) && isBox(archetype.centerLower(), archetype.centerUpper()), 'an archetype has no box');
    demand(archetype.levelsLength() > 0, 'an archetype has no level of detail');
    let next = archetype.levels(0)!.first();
    for (let l = 0; l < archetype.levelsLength(); ++l) {
      const level = archetype.levels(l)!;
      demand(level.first() + level.count() <= puffs && Number.isFinite(level.errorMeters()), 'a level of detail reaches beyond the puffs');
      demand(level.first() === next, 'levels of detail do not follow each other');
      next += level.count();
      used += level.count();
    }
    demand(used <= puffs, 'levels of detail share puffs');
    const figures = [archetype.sunLeast(), archetype.sunMost(), archetype.forwardMost(), archetype.beam()];
    for (let i = 0; i < HARMONICS; ++i) figures.push(archetype.sunScale(i) ?? NaN, archetype.forwardScale(i) ?? NaN);
    demand(
      archetype.sunScaleLength() === HARMONICS && archetype.forwardScaleLength() === HARMONICS && figures.every(Number.isFinite),
      'an archetype does not say how it answers to light',
    );
    demand(
      archetype.sunHeight() < root.sunHeightsLength() && archetype.atlas() < root.atlasesLength() && archetype.impostor() < root.impostorsLength(),
      'an archetype names something that is not there',
    );
  }
}

function requireClouds(root: RuntimePack): void {
  const clouds = root.instancesLength();
  for (let i = 0; i < clouds; ++i) {
    const cloud = root.instances(i)!;
    demand(
      cloud.archetype() < root.archetypesLength() &&
        cloud.yawStep() < YAW_STEPS &&
        isFinite3(cloud.position()) &&
        cloud.scale() > 0 &&
        cloud.scale() < 1e6 &&
        Number.isFinite(cloud.opticalDepthFactor()),
      'a cloud has no shape, no place or no size',
    );
  }
  demand(root.tiles(0)!.count() === clouds, 'the first tile does not hold all clouds');
  // A tile has one parent before it: so there is no way round, and all of it is met once.
  let met = 1;
  for (let t = 0; t < root.tilesLength(); ++t) {
    const tile = root.tiles(t)!;
    demand(isBox(tile.lower(), tile.upper()) && tile.first() + tile.count() <= clouds, 'a tile has no box, or clouds that are not there');
    if (tile.children() === 0) continue;
    const first = tile.firstChild();
    demand(first === met && first > t && first + tile.children() <= root.tilesLength(), 'the children of a tile do not follow it');
    met += tile.children();
    let next = tile.first();
    for (let c = first; c < first + tile.children(); ++c) {
      demand(root.tiles(c)!.first() === next, 'the children of a tile do not share out its clouds');
      next += root.tiles(c)!.count();
    }
    demand(next === tile.first() + tile.count(), 'the children of a tile do not share out its clouds');
  }
}

function requireLight(root: RuntimePack): void {
  const days = root.daylightLength();
  const heights = root.sunHeightsLength();
  demand(days >= 2 && heights > 0 && root.sunColorsLength() === days * heights, 'the daylight is not whole');
  let before = -Infinity;
  for (let i = 0; i < days; ++i) {
    const day = root.daylight(i)!;
    const colors = [day.zenith(), day.horizon(), day.ground(), day.ambient(), day.bounce()];
    demand(colors.every(isFinite3) && day.elevationDegrees() > before, 'the daylight does not rise with the sun');
    before = day.elevationDegrees();
  }
  for (let i = 0; i < root.sunColorsLength(); ++i) demand(isFinite3(root.sunColors(i)), 'the sun has no colour');
  const tone = root.tone()!;
  const figures = [
    tone.whiteSun(), tone.skyWithoutSun(), tone.skyAtNoon(), tone.mostForward(), tone.white(), tone.mostExposure(),
    tone.contrast(), tone.knee(), tone.room(), tone.meanSun(), tone.meanSky(), tone.meanGround(),
    root.sun()!.azimuthDegrees(), root.sun()!.elevationDegrees(),
  ];
  demand(
    figures.every(Number.isFinite) && isFinite3(root.sun()!.direction()) &&
      root.liftLowest() >= 0.01 && root.liftLowest() <= 1 && root.liftPower() >= 0 && root.liftPower() <= 4,
    'the sun has no direction, or the tone curve no figures',
  );
}

function requireKeyframes(root: RuntimePack, bytes: number): void {
  const clouds = root.instancesLength();
  let before = -Infinity;
  for (let k = 0; k < root.keyframesLength(); ++k) {
    const frame = root.keyframes(k)!;
    demand(Number.isFinite(frame.seconds()) && frame.seconds() > before, 'time does not go forward');
    before = frame.seconds();
    const motions = frame.motionsLength();
    const named = frame.cloudsArray();
    if (named) {
      demand(named.length === motions, 'a keyframe does not move every cloud that it names');
      let last = -1;
      for (const cloud of named) {
        demand(cloud > last && cloud < clouds, 'a keyframe names a cloud that is not there');
        last = cloud;
      }
    }
    if (motions === 0) continue;
    demand(named !== null || motions === clouds, 'a keyframe does not move every cloud');
    const first = frame.motions(0)!.bb_pos;
    demand(first % 4 === 0 && first + 20 * motions <= bytes, 'the pack is cut short or damaged');
    for (let i = 0; i < motions; ++i) {
      const motion = frame.motions(i)!;
      demand(
        isFinite3(motion.shift()) && motion.growth() > 0 && motion.growth() < 1e6 && motion.presence() >= 0 && motion.presence() < 1e6,
        "a cloud's motion is none",
      );
    }
  }
}
