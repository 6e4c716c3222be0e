// SPDX-License-Identifier: Apache-2.0
// The worker's side: SkyMaker, one call a message, in the order in which they come.
import {SkyMaker} from './sky_maker';

export type Call =
  | {method: 'open'; arguments: [ArrayBuffer]}
  | {[Name in SkyMethod]: {method: Name; arguments: Parameters<SkyMaker[Name]>}}[SkyMethod];
export type SkyMethod = 'setSun' | 'setTime' | 'setExaggeration' | 'setLayers' | 'list' | 'sunlight' | 'pick';

export interface Answer {
  result?: unknown;
  error?: string;
}

let sky: SkyMaker | null = null;

self.onmessage = ({data}: MessageEvent<Call>) => {
  try {
    const result = answerTo(data);
    (self as unknown as Worker).postMessage({result} satisfies Answer, buffersOf(result));
  } catch (error) {
    (self as unknown as Worker).postMessage({error: error instanceof Error ? error.message : String(error)} satisfies Answer);
  }
};

/** What is handed over, not copied. */
function buffersOf(result: unknown): ArrayBuffer[] {
  if (!result || typeof result !== 'object') return [];
  return (ArrayBuffer.isView(result) ? [result.buffer] : Object.values(result)).filter((value) => value instanceof ArrayBuffer);
}

function answerTo(call: Call): unknown {
  if (call.method === 'open') {
    sky = new SkyMaker(call.arguments[0]);
    return null;
  }
  if (!sky) throw new Error('the sky is not open');
  return (sky[call.method] as (...values: unknown[]) => unknown)(...call.arguments);
}
