// SPDX-License-Identifier: Apache-2.0

const SLOW_SECONDS = 0.04;
const FAST_SECONDS = 0.0175;
const SLOW_FRAMES = 4;
const FAST_FRAMES = 24;

/** Chooses among steps from fine to coarse by how long frames take while the view moves. */
export class Quality {
  step: number;
  private slow = 0;
  private fast = 0;
  /** How long it is left alone after a finer step was too slow. */
  private patience = FAST_FRAMES;
  private wentFiner = false;

  constructor(private readonly steps: number, start: number, private readonly slowSeconds = SLOW_SECONDS) {
    this.step = start;
  }

  /** The time between two frames; true if the step changed. */
  frame(seconds: number): boolean {
    this.slow = seconds > this.slowSeconds ? this.slow + 1 : 0;
    this.fast = seconds < FAST_SECONDS ? this.fast + 1 : 0;
    if (this.slow >= SLOW_FRAMES && this.step + 1 < this.steps) {
      if (this.wentFiner) this.patience *= 4;
      return this.moveTo(this.step + 1, false);
    }
    if (this.fast >= this.patience && this.step > 0) return this.moveTo(this.step - 1, true);
    return false;
  }

  private moveTo(step: number, finer: boolean): boolean {
    this.step = step;
    this.wentFiner = finer;
    this.slow = this.fast = 0;
    return true;
  }
}
