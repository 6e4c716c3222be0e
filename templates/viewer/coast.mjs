// SPDX-License-Identifier: Apache-2.0
// The coastlines of Natural Earth (public domain; npm world-atlas) as the page holds them: rings of steps on the atlas's own lattice
// as zigzag varints, deflated, in base64. src/coast.ts reads them.
import {readFile} from 'node:fs/promises';
import {deflateRawSync} from 'node:zlib';

export async function coastBase64(topojsonFile) {
  const topology = JSON.parse(await readFile(topojsonFile, 'utf8'));
  const bytes = [];
  const put = (value) => {
    let rest = value < 0 ? -2 * value - 1 : 2 * value;
    for (; rest > 127; rest = Math.floor(rest / 128)) bytes.push((rest % 128) + 128);
    bytes.push(rest);
  };
  /** The places of an arc on the lattice; a negative number names one from its end. */
  const placesOf = (arc) => {
    let [x, y] = [0, 0];
    const places = topology.arcs[arc < 0 ? ~arc : arc].map(([dx, dy]) => [(x += dx), (y += dy)]);
    return arc < 0 ? places.reverse() : places;
  };
  const polygons = topology.objects.land.geometries.flatMap(({type, arcs}) => (type === 'Polygon' ? [arcs] : arcs));
  const rings = polygons.flat().map((arcs) => arcs.flatMap((arc, i) => placesOf(arc).slice(i ? 1 : 0)));
  put(rings.length);
  for (const ring of rings) {
    put(ring.length);
    let [x, y] = [0, 0];
    for (const place of ring) {
      put(place[0] - x);
      put(place[1] - y);
      [x, y] = place;
    }
  }
  const header = Buffer.alloc(32);
  [...topology.transform.scale, ...topology.transform.translate].forEach((value, i) => header.writeDoubleLE(value, 8 * i));
  return Buffer.concat([header, deflateRawSync(Buffer.from(bytes), {level: 9})]).toString('base64');
}
