// SPDX-License-Identifier: Apache-2.0
import {clamp} from './math';

/** Runs through the time of a sky: once it has come to the end, again from the start. */
export class TimePlayer {
  /** Seconds of the sky's time that pass in a second. */
  speed = 1800;
  private running = false;
  private before = 0;

  constructor(
    readonly first: number,
    readonly last: number,
    public seconds: number,
    private readonly show: (seconds: number) => void,
    private readonly nextFrame: (step: (milliseconds: number) => void) => void = (step) => void requestAnimationFrame(step),
  ) {}

  get isPlaying(): boolean {
    return this.running;
  }

  play(): void {
    if (this.running) return;
    this.running = true;
    if (this.seconds >= this.last) this.seconds = this.first;
    this.nextFrame((now) => {
      this.before = now;
      this.step(now);
    });
  }

  pause(): void {
    this.running = false;
  }

  goTo(seconds: number): void {
    this.seconds = clamp(seconds, this.first, this.last);
    this.show(this.seconds);
  }

  private step(now: number): void {
    if (!this.running) return;
    // After a pause of the browser's the sky goes on from where it was.
    const passed = Math.min(0.25, (now - this.before) / 1000);
    this.before = now;
    const later = this.seconds + this.speed * passed;
    this.goTo(later > this.last ? this.first : later);
    this.nextFrame((next) => this.step(next));
  }
}
