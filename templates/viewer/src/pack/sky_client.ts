// SPDX-License-Identifier: Apache-2.0
import workerSource from 'worker:./worker.ts';
import type {SkyMaker} from './sky_maker';
import type {Answer, SkyMethod} from './worker';

/** The sky in its worker: calls are answered in the order in which they are made. */
export class SkyClient {
  private readonly waiting: {resolve: (result: never) => void; reject: (error: Error) => void}[] = [];

  private constructor(private readonly worker: Worker) {
    worker.onmessage = ({data}: MessageEvent<Answer>) => {
      const call = this.waiting.shift();
      if (data.error !== undefined) call?.reject(new Error(data.error));
      else call?.resolve(data.result as never);
    };
    worker.onerror = (event) => this.waiting.splice(0).forEach((call) => call.reject(new Error(event.message || 'the worker failed')));
  }

  /** The bytes are copied into the worker. */
  static async open(bytes: ArrayBuffer): Promise<SkyClient> {
    const address = URL.createObjectURL(new Blob([workerSource], {type: 'text/javascript'}));
    const client = new SkyClient(new Worker(address));
    await client.send('open', [bytes], []);
    URL.revokeObjectURL(address);
    return client;
  }

  call<Name extends SkyMethod>(method: Name, ...values: Parameters<SkyMaker[Name]>): Promise<ReturnType<SkyMaker[Name]>> {
    return this.send(method, values, []);
  }

  private send<Result>(method: string, values: unknown[], moved: Transferable[]): Promise<Result> {
    return new Promise((resolve, reject) => {
      this.waiting.push({resolve: resolve as (result: never) => void, reject});
      this.worker.postMessage({method, arguments: values}, moved);
    });
  }
}
