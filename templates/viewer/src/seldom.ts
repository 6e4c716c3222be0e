// SPDX-License-Identifier: Apache-2.0

/** Calls at once, but no more often than this, and at last with what came last. */
export function seldom<Value>(act: (value: Value) => void, milliseconds: number): (value: Value) => void {
  let [last, timer] = [-Infinity, 0];
  return (value) => {
    window.clearTimeout(timer);
    const now = () => {
      last = performance.now();
      act(value);
    };
    const wait = last + milliseconds - performance.now();
    if (wait <= 0) now();
    else timer = window.setTimeout(now, wait);
  };
}
