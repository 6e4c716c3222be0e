// SPDX-License-Identifier: Apache-2.0
// A pack of one shape with three levels of detail, made by hand.
import {Builder} from 'flatbuffers';
import {Archetype} from '../dist/schema/cloudgen/pack/archetype';
import {Atlas} from '../dist/schema/cloudgen/pack/atlas';
import {Daylight} from '../dist/schema/cloudgen/pack/daylight';
import {Instance} from '../dist/schema/cloudgen/pack/instance';
import {Keyframe} from '../dist/schema/cloudgen/pack/keyframe';
import {Level} from '../dist/schema/cloudgen/pack/level';
import {Motion} from '../dist/schema/cloudgen/pack/motion';
import {Puff} from '../dist/schema/cloudgen/pack/puff';
import {Record} from '../dist/schema/cloudgen/pack/record';
import {Response} from '../dist/schema/cloudgen/pack/response';
import {RuntimePack} from '../dist/schema/cloudgen/pack/runtime-pack';
import {Sun} from '../dist/schema/cloudgen/pack/sun';
import {Tile} from '../dist/schema/cloudgen/pack/tile';
import {Tone} from '../dist/schema/cloudgen/pack/tone';
import {Vec3} from '../dist/schema/cloudgen/pack/vec3';

export interface Cloud {
  x: number;
  y: number;
  z: number;
  yaw?: number;
  scale?: number;
}

export interface Made {
  clouds: Cloud[];
  version?: number;
  /** Of the first cloud, at 3600 s. */
  shift?: [number, number, number];
  /** The clouds that are there at 0 s and at 3600 s; all if not given. */
  there?: [number[], number[]];
  archetypeOfFirst?: number;
}

const HALF_OF_100 = 0x5640;
const HALF_OF_2 = 0x4000;
/** No turn: x, y, z 0 and w left out. */
const NO_TURN = (3 << 30) | (512 << 20) | (512 << 10) | 512;
const LEVELS = [[0, 8, 0], [8, 2, 60], [10, 1, 200]];
const PUFFS = 11;
const REACH = 20_000;

/** A structure's vector: written back to front, as FlatBuffers does. */
function vector(builder: Builder, size: number, count: number, alignment: number, write: (index: number) => void): number {
  builder.startVector(size, count, alignment);
  for (let i = count - 1; i >= 0; --i) write(i);
  return builder.endVector();
}

export function madePack({clouds, version = 1, shift, there, archetypeOfFirst = 0}: Made): ArrayBuffer {
  const builder = new Builder(4096);
  const sixteen = (value: number) => Array.from({length: 16}, () => value);
  const sunScale = Archetype.createSunScaleVector(builder, [3.5, ...sixteen(0).slice(1)]);
  const forwardScale = Archetype.createForwardScaleVector(builder, sixteen(0));
  const levels = vector(builder, 12, 3, 4, (i) => Level.createLevel(builder, LEVELS[i][0], LEVELS[i][1], LEVELS[i][2]));
  const genus = builder.createString('Cu');
  Archetype.startArchetype(builder);
  Archetype.addGenus(builder, genus);
  Archetype.addCenterLower(builder, Vec3.createVec3(builder, -500, 0, -500));
  Archetype.addCenterUpper(builder, Vec3.createVec3(builder, 500, 1000, 500));
  Archetype.addLower(builder, Vec3.createVec3(builder, -750, -250, -750));
  Archetype.addUpper(builder, Vec3.createVec3(builder, 750, 1250, 750));
  Archetype.addWidthMeters(builder, 1000);
  Archetype.addDepthMeters(builder, 1000);
  Archetype.addOpticalDepth(builder, 10);
  Archetype.addLevels(builder, levels);
  Archetype.addSunScale(builder, sunScale);
  Archetype.addForwardScale(builder, forwardScale);
  Archetype.addSunMost(builder, 1);
  const archetypes = RuntimePack.createArchetypesVector(builder, [Archetype.endArchetype(builder)]);

  const corner = (i: number, bit: number) => (i < 8 ? (i & bit ? 65535 : 0) : 32768);
  const puffs = vector(builder, 20, PUFFS, 16, (i) =>
    Puff.createPuff(builder, corner(i, 1), corner(i, 2), corner(i, 4), HALF_OF_100, HALF_OF_100, HALF_OF_100, NO_TURN, HALF_OF_2, i, 0),
  );
  const zeros = sixteen(0) as number[];
  const responses = vector(builder, 36, PUFFS, 16, () =>
    (Response.createResponse as (...values: unknown[]) => number)(builder, 127, ...zeros.slice(1), ...zeros, 255, 255, 255, 255),
  );
  const instances = vector(builder, 24, clouds.length, 16, (i) => {
    const {x, y, z, yaw = 0, scale = 1} = clouds[i];
    return Instance.createInstance(builder, x, y, z, i === 0 ? archetypeOfFirst : 0, yaw, 255, scale, 1);
  });
  const records = vector(builder, 24, clouds.length, 16, (i) =>
    Record.createRecord(builder, (7n << 32n) | (2n << 24n) | BigInt(i), clouds[i].y, clouds[i].y + 1000, 10, 0, 2),
  );
  const tiles = vector(builder, 40, 1, 16, () => Tile.createTile(builder, -REACH, -REACH, -REACH, REACH, REACH, REACH, 0, clouds.length, 0, 0));
  const rules = RuntimePack.createRulesVector(builder, [builder.createString('made')]);
  const atlases = RuntimePack.createAtlasesVector(builder, [(Atlas.startAtlas(builder), Atlas.addColumns(builder, 4), Atlas.addRows(builder, 4), Atlas.endAtlas(builder))]);
  const color = (red: number): [number, number, number] => [red, 0.5, 0.5];
  const daylight = vector(builder, 64, 2, 4, (i) =>
    (Daylight.createDaylight as (...values: unknown[]) => number)(builder, i ? 90 : -10, ...color(i), ...color(i), ...color(i), ...color(0.2), ...color(0.1)),
  );
  const sunHeights = RuntimePack.createSunHeightsVector(builder, [1000]);
  const sunColors = vector(builder, 12, 2, 4, (i) => Vec3.createVec3(builder, i, i, i));
  const seconds = shift ? [0, 3600] : [];
  const keyframes = RuntimePack.createKeyframesVector(
    builder,
    seconds.map((time, k) => {
      const named = there?.[k] ?? clouds.map((_, i) => i);
      const motions = vector(builder, 20, named.length, 4, (i) => Motion.createMotion(builder, ...(k && named[i] === 0 ? shift! : [0, 0, 0]) as [number, number, number], 1, 1));
      const cloudsAt = there ? Keyframe.createCloudsVector(builder, named) : 0;
      Keyframe.startKeyframe(builder);
      Keyframe.addSeconds(builder, time);
      Keyframe.addMotions(builder, motions);
      if (there) Keyframe.addClouds(builder, cloudsAt);
      return Keyframe.endKeyframe(builder);
    }),
  );
  RuntimePack.startRuntimePack(builder);
  RuntimePack.addVersion(builder, version);
  RuntimePack.addArchetypes(builder, archetypes);
  RuntimePack.addPuffs(builder, puffs);
  RuntimePack.addResponses(builder, responses);
  RuntimePack.addInstances(builder, instances);
  RuntimePack.addRecords(builder, records);
  RuntimePack.addRules(builder, rules);
  RuntimePack.addTiles(builder, tiles);
  RuntimePack.addAtlases(builder, atlases);
  RuntimePack.addSun(builder, (Sun.createSun as (...values: unknown[]) => number)(builder, 180, 45, 0, 0.7, 0.7));
  RuntimePack.addDaylight(builder, daylight);
  RuntimePack.addSunHeights(builder, sunHeights);
  RuntimePack.addSunColors(builder, sunColors);
  RuntimePack.addTone(builder, Tone.createTone(builder, 1, 1, 1, 0.9, 10, 1, 0.8, 0.2, 0.5, 0.5, 0.5, 1));
  if (shift) RuntimePack.addKeyframes(builder, keyframes);
  RuntimePack.finishRuntimePackBuffer(builder, RuntimePack.endRuntimePack(builder));
  return builder.asUint8Array().slice().buffer as ArrayBuffer;
}
