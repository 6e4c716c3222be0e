// SPDX-License-Identifier: Apache-2.0
// Runs named checks one after another and counts.

export class Skip extends Error {}

export class Runner {
  counts = {passed: 0, failed: 0, skipped: 0};

  constructor(wanted = /./) {
    this.wanted = wanted;
  }

  /** `check` returns a short note on what it saw, or throws; Skip is not a failure. */
  async run(name, seconds, check) {
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

  finish() {
    const {passed, failed, skipped} = this.counts;
    console.log(`${passed} passed, ${failed} failed, ${skipped} skipped`);
    return failed ? 1 : 0;
  }
}
