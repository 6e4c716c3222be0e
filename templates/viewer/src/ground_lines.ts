// SPDX-License-Identifier: Apache-2.0
import type {Frame} from './frame';

const STEPS_DEGREES = [0.05, 0.1, 0.2, 0.25, 0.5, 1, 2, 2.5, 5, 10, 15, 30];
const WANTED_LINES = 7;
const MINOR_LINES = 5;
/** A line of so many degrees is drawn straight: on the maps in use it bends by less than a thousandth of its length. */
const STRAIGHT_DEGREES = 1.5;

export interface GroundLabel {
  text: string;
  x: number;
  z: number;
  kind: 'parallel' | 'meridian';
}

/** Lines on the ground as pairs of points, x and z each. */
export interface GroundLines {
  border: number[];
  major: number[];
  minor: number[];
  labels: GroundLabel[];
}

/** The border of the scene's box, its meridians and parallels, and their labels. */
export function groundLines(frame: Frame): GroundLines {
  const {box} = frame;
  const span = Math.max(frame.longitudeSpan * Math.cos((box.south + box.north) * (Math.PI / 360)), box.north - box.south);
  const step = STEPS_DEGREES.find((candidate) => span / candidate <= WANTED_LINES) ?? 45;
  const east = box.west + frame.longitudeSpan;
  const lines: GroundLines = {border: [], major: [], minor: [], labels: []};
  const line = (from: [number, number], to: [number, number], points: number[]) => {
    const segments = Math.max(2, Math.ceil(Math.max(Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1])) / STRAIGHT_DEGREES));
    for (let i = 0; i < segments; ++i)
      for (const t of [i / segments, (i + 1) / segments])
        points.push(...frame.toScene(from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t));
  };
  line([box.west, box.south], [east, box.south], lines.border);
  line([east, box.south], [east, box.north], lines.border);
  line([east, box.north], [box.west, box.north], lines.border);
  line([box.west, box.north], [box.west, box.south], lines.border);

  const fine = step / MINOR_LINES;
  for (let k = Math.ceil(box.south / fine); k * fine <= box.north; ++k)
    if (k % MINOR_LINES) line([box.west, k * fine], [east, k * fine], lines.minor);
  for (let k = Math.ceil(box.west / fine); k * fine <= east; ++k)
    if (k % MINOR_LINES) line([k * fine, box.south], [k * fine, box.north], lines.minor);

  const decimals = step < 0.1 || step === 0.25 ? 2 : step < 1 || step === 2.5 ? 1 : 0;
  const degrees = (value: number, positive: string, negative: string) =>
    `${Math.abs(value).toFixed(decimals)}°${Math.abs(value) < 1e-9 ? '' : value < 0 ? negative : positive}`;
  for (let k = Math.ceil(box.south / step); k * step <= box.north + 1e-9; ++k) {
    line([box.west, k * step], [east, k * step], lines.major);
    const [x, z] = frame.toScene(box.west, k * step);
    lines.labels.push({text: degrees(k * step, 'N', 'S'), x, z, kind: 'parallel'});
  }
  for (let k = Math.ceil(box.west / step); k * step <= east + 1e-9; ++k) {
    line([k * step, box.south], [k * step, box.north], lines.major);
    const [x, z] = frame.toScene(k * step, box.south);
    const wrapped = ((((k * step + 180) % 360) + 360) % 360) - 180;
    lines.labels.push({text: degrees(wrapped, 'E', 'W'), x, z, kind: 'meridian'});
  }
  return lines;
}
