// SPDX-License-Identifier: Apache-2.0
import coastText from 'coast:land';
import type {Frame} from './frame';
import type {LandMap} from './gl/backdrop';
import {bytesFromBase64} from './scene_data';

/** Longitude and latitude in degrees. */
type Place = [number, number];

const MAP_PIXELS = 1024;
/** The map reaches so many widths of the scene's rectangle beyond it on each side. */
const BEYOND = 1;
/** Steps of a coastline are no shorter than this part of the scene: lines cost as much as triangles. */
const FINEST_STEPS = 400;
const HEADER_BYTES = 32;

export interface Coast {
  map: LandMap;
  /** Pairs of points, x and z each. */
  lines: number[];
}

/** The coastlines of the world as closed rings, land on the inside (even-odd). */
export async function worldRings(): Promise<Place[][]> {
  const bytes = bytesFromBase64(coastText);
  const header = new DataView(bytes.buffer, 0, HEADER_BYTES);
  const [scaleX, scaleY, left, low] = [0, 8, 16, 24].map((at) => header.getFloat64(at, true));
  const stream = new Blob([bytes.subarray(HEADER_BYTES)]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  const steps = new Uint8Array(await new Response(stream).arrayBuffer());
  let at = 0;
  const next = () => {
    let value = 0;
    for (let unit = 1; ; unit *= 128) {
      const byte = steps[at++];
      value += (byte & 127) * unit;
      if (byte < 128) break;
    }
    return value % 2 ? -(value + 1) / 2 : value / 2;
  };
  return Array.from({length: next()}, () => {
    let [x, y] = [0, 0];
    return Array.from({length: next()}, (): Place => {
      x += next();
      y += next();
      return [left + scaleX * x, low + scaleY * y];
    });
  });
}

export interface Box {
  west: number;
  south: number;
  east: number;
  north: number;
}

/** What of a ring lies in a box of longitudes and latitudes (Sutherland and Hodgman 1974); empty if nothing does. */
export function clipped(ring: Place[], box: Box): Place[] {
  const sides: [number, number, number][] = [[0, box.west, 1], [0, box.east, -1], [1, box.south, 1], [1, box.north, -1]];
  let out = ring;
  for (const [axis, limit, sign] of sides) {
    const from = out;
    out = [];
    for (let i = 0; i < from.length; ++i) {
      const [a, b] = [from[i], from[(i + 1) % from.length]];
      const [da, db] = [sign * (a[axis] - limit), sign * (b[axis] - limit)];
      if (da >= 0) out.push(a);
      if (da * db < 0) {
        const t = da / (da - db);
        out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
      }
    }
  }
  return out;
}

/** Land, sea and coastlines about a scene. */
export function coastAbout(rings: Place[][], frame: Frame): Coast {
  const {west, south, north} = frame.box;
  const east = west + frame.longitudeSpan;
  const [wide, high] = [(BEYOND + 0.6) * frame.longitudeSpan, (BEYOND + 0.6) * (north - south)];
  const box: Box = {west: Math.max(west - wide, east - 359), south: Math.max(-88, south - high), east: Math.min(east + wide, west + 359), north: Math.min(88, north + high)};
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = MAP_PIXELS;
  const context = canvas.getContext('2d', {willReadFrequently: true})!;
  context.fillStyle = '#fff';
  const place: LandMap['place'] = [-BEYOND, -BEYOND, 1 + 2 * BEYOND, 1 + 2 * BEYOND];
  const [left, top] = [frame.centerX - (0.5 + BEYOND) * frame.width, frame.centerZ - (0.5 + BEYOND) * frame.depth];
  const [across, down] = [MAP_PIXELS / (place[2] * frame.width), MAP_PIXELS / (place[3] * frame.depth)];
  const lines: number[] = [];
  const onBorder = ([x, y]: Place) => x <= box.west || x >= box.east || y <= box.south || y >= box.north;
  context.beginPath();
  for (const ring of rings)
    for (const turn of [-360, 0, 360]) {
      const part = clipped(turn ? ring.map(([x, y]): Place => [x + turn, y]) : ring, box);
      if (part.length < 3) continue;
      const points = part.map(([longitude, latitude]) => frame.toScene(longitude, latitude));
      const shortest = frame.size / FINEST_STEPS;
      let last = 0;
      points.forEach(([x, z], i) => (i ? context.lineTo((x - left) * across, (z - top) * down) : context.moveTo((x - left) * across, (z - top) * down)));
      context.closePath();
      for (let i = 1; i <= part.length; ++i) {
        const next = i % part.length;
        if (next !== 0 && Math.hypot(points[next][0] - points[last][0], points[next][1] - points[last][1]) < shortest) continue;
        if (!(onBorder(part[last]) && onBorder(part[next]))) lines.push(...points[last], ...points[next]);
        last = next;
      }
    }
  context.fill('evenodd');
  const {data} = context.getImageData(0, 0, MAP_PIXELS, MAP_PIXELS);
  const pixels = Uint8Array.from({length: MAP_PIXELS * MAP_PIXELS}, (_, i) => data[4 * i]);
  return {map: {pixels, width: MAP_PIXELS, height: MAP_PIXELS, place}, lines};
}
