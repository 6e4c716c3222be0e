// SPDX-License-Identifier: Apache-2.0
import {ByteBuffer} from 'flatbuffers';
import {RuntimePack} from '../../dist/schema/cloudgen/pack/runtime-pack';
import {requireSound} from './pack_rules';

export const YAW_STEPS = 16;
/** More levels of detail than this are not looked at. */
const MOST_LEVELS = 8;

export interface Level {
  first: number;
  count: number;
  errorMeters: number;
}

/** An archetype as it is asked for every frame. */
export interface ArchetypeInfo {
  genus: string;
  levels: Level[];
  /** Middle of the sphere about it, above its origin, and its radius whatever the heading. */
  middleMeters: number;
  radiusMeters: number;
  widthMeters: number;
  depthMeters: number;
  opticalDepth: number;
  atlas: number;
  sunHeight: number;
  firstPuff: number;
  endPuff: number;
}

/** Where the numbers of clouds lie: 24 bytes each, as schemas/runtime_pack.fbs says. */
export class Clouds {
  static readonly BYTES = 24;
  readonly count: number;
  readonly floats: Float32Array;
  readonly shorts: Uint16Array;
  readonly bytes: Uint8Array;

  constructor(buffer: ArrayBuffer, offset: number, count: number) {
    this.count = count;
    this.floats = new Float32Array(buffer, offset, 6 * count);
    this.shorts = new Uint16Array(buffer, offset, 12 * count);
    this.bytes = new Uint8Array(buffer, offset, 24 * count);
  }

  /** The same clouds in memory of their own. */
  copied(): Clouds {
    return new Clouds(this.bytes.slice().buffer, 0, this.count);
  }

  archetype(i: number): number {
    return this.shorts[12 * i + 6];
  }
  yawStep(i: number): number {
    return this.bytes[24 * i + 14];
  }
  /** Share of the sun that other clouds let through. */
  sunlight(i: number): number {
    return this.bytes[24 * i + 15] / 255;
  }
  scale(i: number): number {
    return this.floats[6 * i + 4];
  }
  factor(i: number): number {
    return this.floats[6 * i + 5];
  }
}

/** Tiles: 40 bytes each. */
export interface Tiles {
  count: number;
  /** lower x y z, upper x y z of tile t from 10 t on. */
  floats: Float32Array;
  /** first, count, first child, children from 10 t + 6 on. */
  words: Uint32Array;
}

/** What a cloud is said to be. */
export interface CloudRecord {
  id: bigint;
  baseMeters: number;
  topMeters: number;
  opticalDepth: number;
  rule: string;
  layer: number;
}

export function floatOfHalf(half: number): number {
  const sign = half & 0x8000 ? -1 : 1;
  const exponent = (half >> 10) & 0x1f;
  const mantissa = half & 0x3ff;
  if (exponent === 0) return sign * mantissa * 2 ** -24;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
}

/** Quaternion x, y, z, w of the three smallest of its parts, 10 bits each; bits 30 and 31 name the one left out. */
export function rotationOf(bits: number): [number, number, number, number] {
  const left = bits >>> 30;
  const parts: number[] = [0, 0, 0, 0];
  let shift = 0;
  let sum = 0;
  for (let i = 0; i < 4; ++i) {
    if (i === left) continue;
    parts[i] = ((((bits >>> shift) & 1023) / 1023) * 2 - 1) * Math.SQRT1_2;
    sum += parts[i] * parts[i];
    shift += 10;
  }
  parts[left] = Math.sqrt(Math.max(0, 1 - sum));
  return parts as [number, number, number, number];
}

/** A pack whose rules hold: every index in it is in range. Arrays of clouds and tiles are those of the file. */
export class PackView {
  readonly archetypes: ArchetypeInfo[] = [];
  readonly puffs: number;
  /** Where puff p stands in its archetype: x, y, z from 3 p on. */
  readonly centers: Float32Array;
  /** Its covariance there: xx, xy, xz, yy, yz, zz from 6 p on. */
  readonly covariances: Float32Array;
  /** Through the centre along the shortest axis. */
  readonly opticalDepths: Float32Array;
  readonly sprites: Uint8Array;
  /** How far it is a level top; 255 is all. */
  readonly levelTops: Uint8Array;
  /** 36 bytes a puff. */
  readonly responses: Int8Array;
  readonly clouds: Clouds;
  readonly tiles: Tiles;
  readonly genera: string[];

  private constructor(readonly bytes: ArrayBuffer, readonly root: RuntimePack) {
    this.puffs = root.puffsLength();
    this.centers = new Float32Array(3 * this.puffs);
    this.covariances = new Float32Array(6 * this.puffs);
    this.opticalDepths = new Float32Array(this.puffs);
    this.sprites = new Uint8Array(this.puffs);
    this.levelTops = new Uint8Array(this.puffs);
    this.responses = new Int8Array(bytes, this.puffs ? root.responses(0)!.bb_pos : 0, 36 * this.puffs);
    const clouds = root.instancesLength();
    this.clouds = new Clouds(bytes, clouds ? root.instances(0)!.bb_pos : 0, clouds);
    const tiles = root.tilesLength();
    const at = root.tiles(0)!.bb_pos;
    this.tiles = {count: tiles, floats: new Float32Array(bytes, at, 10 * tiles), words: new Uint32Array(bytes, at, 10 * tiles)};
    for (let a = 0; a < root.archetypesLength(); ++a) this.decodeArchetype(a);
    this.genera = [...new Set(this.archetypes.map((archetype) => archetype.genus))];
  }

  /** Throws an Error of one line if the bytes are no pack that can be read. */
  static open(bytes: ArrayBuffer): PackView {
    const buffer = new ByteBuffer(new Uint8Array(bytes));
    return new PackView(bytes, requireSound(buffer));
  }

  record(cloud: number): CloudRecord | null {
    if (cloud >= this.root.recordsLength()) return null;
    const record = this.root.records(cloud)!;
    const rule = record.rule() < this.root.rulesLength() ? this.root.rules(record.rule()) : '';
    return {
      id: record.id(),
      baseMeters: record.baseMeters(),
      topMeters: record.topMeters(),
      opticalDepth: record.opticalDepth(),
      rule,
      layer: record.layer(),
    };
  }

  private decodeArchetype(index: number): void {
    const archetype = this.root.archetypes(index)!;
    const levels: Level[] = [];
    for (let l = 0; l < Math.min(archetype.levelsLength(), MOST_LEVELS); ++l) {
      const level = archetype.levels(l)!;
      levels.push({first: level.first(), count: level.count(), errorMeters: level.errorMeters()});
    }
    const lower = archetype.lower()!;
    const upper = archetype.upper()!;
    const acrossX = Math.max(Math.abs(lower.x()), Math.abs(upper.x()));
    const acrossZ = Math.max(Math.abs(lower.z()), Math.abs(upper.z()));
    const last = levels[levels.length - 1];
    const info: ArchetypeInfo = {
      genus: archetype.genus() ?? '',
      levels,
      middleMeters: 0.5 * (lower.y() + upper.y()),
      radiusMeters: Math.hypot(acrossX, acrossZ, 0.5 * (upper.y() - lower.y())),
      widthMeters: archetype.widthMeters(),
      depthMeters: archetype.depthMeters(),
      opticalDepth: archetype.opticalDepth(),
      atlas: archetype.atlas(),
      sunHeight: archetype.sunHeight(),
      firstPuff: levels[0].first,
      endPuff: last.first + last.count,
    };
    this.archetypes.push(info);
    const centerLower = archetype.centerLower()!;
    const centerUpper = archetype.centerUpper()!;
    const from = [centerLower.x(), centerLower.y(), centerLower.z()];
    const step = [centerUpper.x() - from[0], centerUpper.y() - from[1], centerUpper.z() - from[2]].map((width) => width / 65535);
    for (let p = info.firstPuff; p < info.endPuff; ++p) this.decodePuff(p, from, step);
  }

  private decodePuff(p: number, from: number[], step: number[]): void {
    const puff = this.root.puffs(p)!;
    this.centers[3 * p] = from[0] + step[0] * puff.centerX();
    this.centers[3 * p + 1] = from[1] + step[1] * puff.centerY();
    this.centers[3 * p + 2] = from[2] + step[2] * puff.centerZ();
    const [x, y, z, w] = rotationOf(puff.rotation());
    const s = [floatOfHalf(puff.sigmaX()), floatOfHalf(puff.sigmaY()), floatOfHalf(puff.sigmaZ())];
    // The columns of the rotation, times the deviations; the covariance is its product with its transpose.
    const m = [
      [(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - w * z) * s[1], 2 * (x * z + w * y) * s[2]],
      [2 * (x * y + w * z) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - w * x) * s[2]],
      [2 * (x * z - w * y) * s[0], 2 * (y * z + w * x) * s[1], (1 - 2 * (x * x + y * y)) * s[2]],
    ];
    const product = (i: number, j: number) => m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2];
    this.covariances.set([product(0, 0), product(0, 1), product(0, 2), product(1, 1), product(1, 2), product(2, 2)], 6 * p);
    this.opticalDepths[p] = floatOfHalf(puff.opticalDepth());
    this.sprites[p] = puff.sprite();
    this.levelTops[p] = puff.level();
  }
}
