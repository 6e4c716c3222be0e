// SPDX-License-Identifier: Apache-2.0
// Frames a second, first frame and memory over the number of billboards, both axes logarithmic.
//   node tests/bench/web/plot.mjs LINES.jsonl FILE.svg: of the lines that bench.mjs printed
import {readFileSync, writeFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

const WIDTH = 1180, HEIGHT = 400, PANEL = 300, GAP = 80, TOP = 40, LEFT = 60;
const COLORS = {'xite ours': '#1f5fbf', 'xite thesis': '#9db9e0', 'x3dom ours': '#c2571a', 'x3dom thesis': '#e6bfa3'};
const PANELS = [
  {key: 'fps', title: 'frames a second', low: 0.1, high: 100},
  {key: 'first_frame_s', title: 'first frame, seconds', low: 0.1, high: 100},
  {key: 'memory_mb', title: 'memory, megabytes', low: 100, high: 10000},
];

const share = (value, low, high) => (Math.log(value) - Math.log(low)) / (Math.log(high) - Math.log(low));
const text = (x, y, words, anchor = 'middle') => `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}">${words}</text>`;

function panel({key, title, low, high}, left, series, most) {
  const bottom = TOP + PANEL;
  const x = (billboards) => left + PANEL * share(billboards, 1, most);
  const y = (value) => bottom - PANEL * Math.min(1, Math.max(0, share(value, low, high)));
  const parts = [text(left + PANEL / 2, TOP - 14, title)];
  for (let value = low; value <= high * 1.001; value *= 10)
    parts.push(`<path d="M${left} ${y(value).toFixed(1)}h${PANEL}" stroke="#ddd"/>`, text(left - 6, y(value) + 4, Number(value.toPrecision(1)), 'end'));
  for (let value = 1; value <= most; value *= 10) parts.push(text(x(value), bottom + 18, value));
  for (const [name, lines] of series) {
    const points = lines.filter((line) => line[key] > 0).map((line) => [x(line.billboards), y(line[key])]);
    if (!points.length) continue;
    const path = points.map(([px, py], i) => `${i ? 'L' : 'M'}${px.toFixed(1)} ${py.toFixed(1)}`).join('');
    parts.push(`<path d="${path}" fill="none" stroke="${COLORS[name] ?? '#555'}" stroke-width="2"/>`);
    for (const [px, py] of points) parts.push(`<circle cx="${px.toFixed(1)}" cy="${py.toFixed(1)}" r="3" fill="${COLORS[name] ?? '#555'}"/>`);
  }
  return parts.join('\n');
}

/** An SVG of the lines that bench.mjs prints; of a case that ran twice the last counts. */
export function plot(all) {
  const lines = all.filter(({bench}) => bench === 'billboards');
  const cases = new Map();
  for (const line of lines) cases.set(`${line.viewer} ${line.kind} ${line.billboards}`, {...line, first_frame_s: line.first_frame_ms / 1000});
  const series = new Map();
  for (const line of [...cases.values()].sort((a, b) => a.billboards - b.billboards)) {
    const name = `${line.viewer} ${line.kind}`;
    series.set(name, [...(series.get(name) ?? []), line]);
  }
  const most = Math.max(10, ...lines.map((line) => line.billboards));
  const panels = PANELS.map((each, i) => panel(each, LEFT + i * (PANEL + GAP), series, most));
  const legend = [...series.keys()].map((name, i) =>
    `<rect x="${LEFT + 160 * i}" y="${HEIGHT - 22}" width="12" height="12" fill="${COLORS[name] ?? '#555'}"/>${text(LEFT + 18 + 160 * i, HEIGHT - 12, name, 'start')}`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${HEIGHT}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="#fff"/>
${[...panels, ...legend].join('\n')}
</svg>
`;
}

export const linesOf = (file) => readFileSync(file, 'utf8').trim().split('\n').map((line) => JSON.parse(line));

const [, program, lines, file] = process.argv;
if (import.meta.url === pathToFileURL(program).href) {
  if (!file) throw new Error('usage: node tests/bench/web/plot.mjs LINES.jsonl FILE.svg');
  writeFileSync(file, plot(linesOf(lines)));
}
