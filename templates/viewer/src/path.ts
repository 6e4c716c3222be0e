// SPDX-License-Identifier: Apache-2.0
// A way to fly along: given as places, or made past the thickest clouds.
import type {CloudExtent} from './cloud_extent';
import type {Frame} from './frame';
import {distance, type Vec3} from './math';

const STEPS_BETWEEN = 16;

/** A smooth way through places (Catmull and Rom 1974), known by the metres from its start. */
export class FlightPath {
  readonly lengthMeters: number;
  private readonly points: Vec3[] = [];
  private readonly upTo: number[] = [0];

  constructor(places: Vec3[], closed: boolean) {
    if (places.length < 2) throw new Error('a flight path needs two places or more');
    const count = places.length;
    const at = (i: number) => (closed ? places[((i % count) + count) % count] : places[Math.min(count - 1, Math.max(0, i))]);
    for (let i = 0; i < (closed ? count : count - 1); ++i)
      for (let s = 0; s < STEPS_BETWEEN; ++s) this.points.push(between(at(i - 1), at(i), at(i + 1), at(i + 2), s / STEPS_BETWEEN));
    this.points.push(closed ? places[0] : places[count - 1]);
    for (let i = 1; i < this.points.length; ++i) this.upTo.push(this.upTo[i - 1] + distance(this.points[i - 1], this.points[i]));
    this.lengthMeters = this.upTo[this.upTo.length - 1];
  }

  placeAt(meters: number): Vec3 {
    const wanted = Math.min(Math.max(meters, 0), this.lengthMeters);
    let i = 1;
    while (i + 1 < this.points.length && this.upTo[i] < wanted) ++i;
    const span = this.upTo[i] - this.upTo[i - 1];
    const t = span > 0 ? (wanted - this.upTo[i - 1]) / span : 0;
    const [a, b] = [this.points[i - 1], this.points[i]];
    return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])];
  }
}

function between(a: Vec3, b: Vec3, c: Vec3, d: Vec3, t: number): Vec3 {
  const part = (k: number) =>
    0.5 * (2 * b[k] + (c[k] - a[k]) * t + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * t * t + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * t * t * t);
  return [part(0), part(1), part(2)];
}

/** A round about the thickest clouds, at the height of their upper half. */
export function pathAbout(clouds: CloudExtent, groundMeters: number): FlightPath {
  const [x, , z] = clouds.densest;
  const height = Math.max(groundMeters + 600, 0.35 * clouds.densest[1] + 0.65 * clouds.densestTop);
  const radius = Math.max(6_000, Math.min(0.35 * clouds.spread, 60_000));
  const corners = 10;
  const places = Array.from({length: corners}, (_, i): Vec3 => {
    const angle = (2 * Math.PI * i) / corners;
    const reach = radius * (i % 2 ? 0.75 : 1);
    return [x + reach * Math.sin(angle), height + 0.15 * (height - groundMeters) * Math.cos(2 * angle), z - reach * Math.cos(angle)];
  });
  return new FlightPath(places, true);
}

/** The places of a text: GeoJSON with a LineString, or lines of longitude, latitude and metres; throws an Error of one line. */
export function pathFromText(text: string, frame: Frame, usualMeters: number): FlightPath {
  const places = (text.trimStart().startsWith('{') ? lineStringIn(JSON.parse(text) as unknown) : tableIn(text)) ?? [];
  const known = places.filter(([longitude, latitude]) => Math.abs(longitude) <= 360 && Math.abs(latitude) <= 90);
  if (known.length < 2) throw new Error('no flight path in this file: it needs a GeoJSON LineString, or lines of longitude, latitude, metres');
  return new FlightPath(
    known.map(([longitude, latitude, height]): Vec3 => {
      const [x, z] = frame.toScene(longitude, latitude);
      return [x, height ?? usualMeters, z];
    }),
    false,
  );
}

function tableIn(text: string): number[][] {
  return text
    .split(/\r?\n/)
    .map((line) => line.split(/[,;\t ]+/).filter(Boolean).map(Number))
    .filter((row) => row.length >= 2 && row.every(Number.isFinite));
}

function lineStringIn(value: unknown): number[][] | null {
  if (typeof value !== 'object' || value === null) return null;
  const object = value as Record<string, unknown>;
  if (object.type === 'LineString' && Array.isArray(object.coordinates)) return object.coordinates as number[][];
  for (const inner of [object.geometry, ...((object.features ?? object.geometries ?? []) as unknown[])]) {
    const found = lineStringIn(inner);
    if (found) return found;
  }
  return null;
}
