// SPDX-License-Identifier: Apache-2.0
// Runs named checks and counts: two at a time, so that one draws while another waits; those that need the machine for
// themselves come first, one after another.

export class Skip extends Error {}

export class Runner {
  counts = {passed: 0, failed: 0, skipped: 0};

  #alone = [];
  #together = [];
  #afterwards = [];

  constructor(wanted = /./) {
    this.wanted = wanted;
  }

  /** `check` returns a short note on what it saw, or throws; Skip is not a failure. */
  add(name, seconds, check) {
    this.#together.push([name, seconds, check]);
  }

  /** The same for a check whose time limits are short, or that keeps this process busy itself. */
  addAlone(name, seconds, check) {
    this.#alone.push([name, seconds, check]);
  }

  /** To be done after the last check. */
  addAfterwards(task) {
    this.#afterwards.push(task);
  }

  async #run(name, seconds, check) {
    if (!this.wanted.test(name)) return;
    const start = Date.now();
    let timer;
    const late = new Promise((_, reject) => {
      timer = setTimeout(() => reject(new Error(`no result after ${seconds} s (software rendering is slow: is the machine busy?)`)), seconds * 1000);
    });
    try {
      const note = await Promise.race([check(), late]);
      ++this.counts.passed;
      console.log(`ok      ${name}${note ? `: ${note}` : ''} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
      if (error instanceof Skip) {
        ++this.counts.skipped;
        console.log(`skipped ${name}: ${error.message}`);
      } else {
        ++this.counts.failed;
        console.log(`FAILED  ${name}: ${error?.message ?? error}`);
      }
    } finally {
      clearTimeout(timer);
    }
  }

  async finish() {
    const work = async (checks) => {
      for (let next; (next = checks.shift()); ) await this.#run(...next);
    };
    await work(this.#alone);
    await Promise.all([work(this.#together), work(this.#together)]);
    for (const task of this.#afterwards) await task();
    const {passed, failed, skipped} = this.counts;
    console.log(`${passed} passed, ${failed} failed, ${skipped} skipped`);
    return failed ? 1 : 0;
  }
}
