// SPDX-License-Identifier: Apache-2.0
// Pointer, wheel, touch and keys, as motions of the camera.

const KEYS = new Set([
  'KeyW', 'KeyA', 'KeyS', 'KeyD', 'KeyQ', 'KeyE', 'ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight',
  'PageUp', 'PageDown', 'Equal', 'Minus', 'NumpadAdd', 'NumpadSubtract', 'ShiftLeft', 'ShiftRight',
]);
/** A pointer that moves no farther than this, and not for long, has clicked. */
const CLICK_PIXELS = 5;
const CLICK_MILLISECONDS = 500;

export interface Motions {
  /** The pointer was dragged by so many pixels of the page. */
  drag(right: number, down: number): void;
  /** With the right button, Shift or two fingers. */
  pan(right: number, down: number): void;
  /** Nearer below 1, farther above. */
  zoom(factor: number): void;
  click(x: number, y: number): void;
  wake(): void;
}

/** What the held keys ask for, each -1 to 1. */
export interface HeldKeys {
  right: number;
  ahead: number;
  up: number;
  turnRight: number;
  turnUp: number;
  inward: number;
  fast: boolean;
}

export class Controls {
  private readonly pressed = new Set<string>();
  private readonly pointers = new Map<number, {x: number; y: number}>();
  private start = {x: 0, y: 0, time: 0, panning: false, moved: false};

  constructor(private readonly surface: HTMLElement, private readonly motions: Motions) {
    window.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !KEYS.has(event.code) || isControl(event.target)) return;
      this.pressed.add(event.code);
      event.preventDefault();
      motions.wake();
    });
    window.addEventListener('keyup', (event) => this.pressed.delete(event.code));
    window.addEventListener('blur', () => this.pressed.clear());
    surface.addEventListener('pointerdown', (event) => this.down(event));
    surface.addEventListener('pointermove', (event) => this.move(event));
    for (const name of ['pointerup', 'pointercancel'] as const) surface.addEventListener(name, (event) => this.up(event));
    surface.addEventListener('contextmenu', (event) => event.preventDefault());
    surface.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        motions.zoom(Math.exp(Math.sign(event.deltaY) * Math.min(0.2, Math.abs(event.deltaY) * 0.0015)));
      },
      {passive: false},
    );
  }

  /** What the keys ask for; null if none is held. */
  held(): HeldKeys | null {
    if (![...this.pressed].some((code) => !code.startsWith('Shift'))) return null;
    const is = (...codes: string[]) => (codes.some((code) => this.pressed.has(code)) ? 1 : 0);
    return {
      right: is('KeyD') - is('KeyA'),
      ahead: is('KeyW') - is('KeyS'),
      up: is('KeyE', 'PageUp') - is('KeyQ', 'PageDown'),
      turnRight: is('ArrowRight') - is('ArrowLeft'),
      turnUp: is('ArrowUp') - is('ArrowDown'),
      inward: is('Equal', 'NumpadAdd') - is('Minus', 'NumpadSubtract'),
      fast: is('ShiftLeft', 'ShiftRight') === 1,
    };
  }

  private down(event: PointerEvent): void {
    this.surface.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    const panning = event.button === 2 || event.shiftKey;
    this.start = {x: event.clientX, y: event.clientY, time: event.timeStamp, panning, moved: this.pointers.size > 1};
  }

  private move(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const [right, down] = [event.clientX - before.x, event.clientY - before.y];
    if (Math.hypot(event.clientX - this.start.x, event.clientY - this.start.y) > CLICK_PIXELS) this.start.moved = true;
    if (this.pointers.size === 1) {
      if (this.start.panning) this.motions.pan(right, down);
      else if (this.start.moved) this.motions.drag(right, down);
    } else {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)![1];
      const apart = (a: {x: number; y: number}) => Math.max(8, Math.hypot(a.x - other.x, a.y - other.y));
      this.motions.zoom(apart(before) / apart({x: event.clientX, y: event.clientY}));
      this.motions.pan(right / 2, down / 2);
    }
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  }

  private up(event: PointerEvent): void {
    const wasDown = this.pointers.delete(event.pointerId);
    if (!wasDown || event.type === 'pointercancel' || this.start.moved || this.start.panning) return;
    if (event.timeStamp - this.start.time < CLICK_MILLISECONDS) this.motions.click(event.clientX, event.clientY);
  }
}

function isControl(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('input, select, textarea, dialog') !== null;
}
