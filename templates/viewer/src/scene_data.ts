// SPDX-License-Identifier: Apache-2.0

import type {Vec3} from './math';

export interface GenusCount {
  abbreviation: string;
  name: string;
  count: number;
  color: string;
  lowestBaseMeters: number;
  highestTopMeters: number;
}

/** Heights above mean sea level, row by row from the north; its border lies at the lowest ground. */
export interface TerrainData {
  columns: number;
  rows: number;
  origin: [number, number];
  step: [number, number];
  heights: number[];
}

/** Scene minus model; null where nothing could be compared. */
export interface Score {
  bias: number | null;
  rmse: number | null;
}

/** What `cloudgen verify` found (schemas/verify.schema.json), as far as it is shown. */
export interface Fidelity {
  passed: boolean;
  read: {file: string};
  columns: number;
  cover: {total: Score; low: Score; middle: Score; high: Score; populated: {total: Score; columns: number} | null};
  optical_depth: {bias_relative: number; correlation: number | null};
  base_m: Score;
  top_m: Score;
  genus: {agreement: number | null; clouds: number};
  broken: {measure: string}[];
}

/** What the writer says about the scene, in the slot `cloudgen-scene`. Lengths in metres, x east, y up, z south. */
export interface SceneData {
  title: string;
  validTime: string;
  run: string;
  model: string;
  files: string[];
  box: {west: number; south: number; east: number; north: number};
  frame: {definition: string; lower: [number, number]; upper: [number, number]};
  groundHeightMeters: number;
  terrain?: TerrainData;
  highestTopMeters: number;
  sun: {azimuthDegrees: number; elevationDegrees: number; direction: Vec3};
  counts: {clouds: number; puffs: number};
  genera: GenusCount[];
  pack: {bytes: number; file: string | null};
  /** Not there if the build did not verify the scene. */
  verification?: Fidelity;
  /** Maps of it: the file beside the page, and the picture itself as a data address. */
  maps?: {name: string; file: string; picture: string}[];
}

function slotText(id: string): string {
  const text = document.getElementById(id)?.textContent?.trim() ?? '';
  if (!text) throw new Error(`This page holds no scene (its slot "${id}" is empty). Make it with: cloudgen build … --formats pack,page`);
  return text;
}

export function readScene(): SceneData {
  return JSON.parse(slotText('cloudgen-scene')) as SceneData;
}

/** The bytes of a base64 text, decoded in slices so that no second copy of the whole text is made. */
export function bytesFromBase64(text: string): Uint8Array<ArrayBuffer> {
  const padding = text.endsWith('==') ? 2 : text.endsWith('=') ? 1 : 0;
  const bytes = new Uint8Array((text.length / 4) * 3 - padding);
  const slice = 4 * 65536;
  let at = 0;
  for (let start = 0; start < text.length; start += slice) {
    const part = atob(text.slice(start, start + slice));
    for (let i = 0; i < part.length; ++i) bytes[at++] = part.charCodeAt(i);
  }
  return bytes;
}

/** The runtime pack: from the page itself, or for very large scenes from the file beside it; `progress` gets the share that is there. */
export async function readPack(data: SceneData, progress: (share: number) => void): Promise<ArrayBuffer> {
  if (!data.pack.file) return bytesFromBase64(slotText('cloudgen-pack')).buffer;
  if (location.protocol === 'file:')
    throw new Error(
      `This scene is too large to stand inside the page. Serve its folder (for example: python3 -m http.server) ` +
        `and open index.html through that address; the page then reads ${data.pack.file} from beside it.`,
    );
  const answer = await fetch(data.pack.file);
  if (!answer.ok || !answer.body) throw new Error(`${data.pack.file}: the server answered ${answer.status}`);
  const bytes = new Uint8Array(data.pack.bytes);
  let at = 0;
  for (const reader = answer.body.getReader(); ; ) {
    const {done, value} = await reader.read();
    if (done) break;
    if (at + value.length > bytes.length) throw new Error(`${data.pack.file} is not the one that this page was made with`);
    bytes.set(value, at);
    at += value.length;
    progress(at / bytes.length);
  }
  if (at !== bytes.length) throw new Error(`${data.pack.file} is cut short: ${at} bytes of ${bytes.length}`);
  return bytes.buffer;
}
