// SPDX-License-Identifier: Apache-2.0
import {PerspectiveCamera, Vector3} from 'three/webgpu';

const KEYS = new Set([
  'KeyW', 'KeyA', 'KeyS', 'KeyD', 'KeyQ', 'KeyE', 'ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight',
  'PageUp', 'PageDown', 'Equal', 'Minus', 'NumpadAdd', 'NumpadSubtract', 'ShiftLeft', 'ShiftRight',
]);
const TURN_RADIANS_PER_SECOND = 0.7;
const UP = new Vector3(0, 1, 0);

/** Keys for both ways of moving, and the pointer for flying. The caller asks for steps while `active`. */
export class Fly {
  pointerLooks = false;
  private readonly pressed = new Set<string>();
  private drag: {id: number; x: number; y: number} | null = null;

  constructor(private readonly surface: HTMLElement, private readonly camera: PerspectiveCamera, private readonly wake: () => void) {
    window.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !KEYS.has(event.code) || isControl(event.target)) return;
      this.pressed.add(event.code);
      event.preventDefault();
      this.wake();
    });
    window.addEventListener('keyup', (event) => this.pressed.delete(event.code));
    window.addEventListener('blur', () => this.pressed.clear());
    surface.addEventListener('pointerdown', (event) => {
      if (!this.pointerLooks) return;
      this.drag = {id: event.pointerId, x: event.clientX, y: event.clientY};
      surface.setPointerCapture(event.pointerId);
    });
    surface.addEventListener('pointermove', (event) => {
      if (!this.drag || event.pointerId !== this.drag.id) return;
      const scale = ((this.camera.fov * Math.PI) / 180) / this.surface.clientHeight;
      this.turn((event.clientX - this.drag.x) * scale, (event.clientY - this.drag.y) * scale);
      this.drag = {id: event.pointerId, x: event.clientX, y: event.clientY};
      this.wake();
    });
    const release = () => (this.drag = null);
    surface.addEventListener('pointerup', release);
    surface.addEventListener('pointercancel', release);
    surface.addEventListener(
      'wheel',
      (event) => {
        if (!this.pointerLooks) return;
        event.preventDefault();
        this.camera.position.addScaledVector(this.forward(), -Math.sign(event.deltaY) * this.speed() * 0.25);
        this.wake();
      },
      {passive: false},
    );
  }

  get active(): boolean {
    return [...this.pressed].some((code) => !code.startsWith('Shift'));
  }

  /** Height above the ground sets the pace: slow between clouds, fast over a continent. Metres a second. */
  private speed(): number {
    const fast = this.pressed.has('ShiftLeft') || this.pressed.has('ShiftRight') ? 4 : 1;
    return fast * Math.min(400_000, Math.max(400, 0.5 * this.camera.position.y));
  }

  private forward(): Vector3 {
    return this.camera.getWorldDirection(new Vector3());
  }

  private turn(rightToLeft: number, downToUp: number): void {
    const forward = this.forward();
    forward.applyAxisAngle(UP, rightToLeft);
    const right = new Vector3().crossVectors(forward, UP).normalize();
    const pitched = forward.clone().applyAxisAngle(right, downToUp);
    if (Math.abs(pitched.y) < 0.999) forward.copy(pitched);
    this.camera.lookAt(this.camera.position.clone().add(forward));
  }

  /** Moves the camera for the keys held down. In orbit (`target` given) arrows turn about it and plus/minus approach it. */
  step(seconds: number, lowest: number, target: Vector3 | null): void {
    const held = (...codes: string[]) => (codes.some((code) => this.pressed.has(code)) ? 1 : 0);
    const turn = TURN_RADIANS_PER_SECOND * seconds;
    const sideways = held('ArrowLeft') - held('ArrowRight');
    const upward = held('ArrowUp') - held('ArrowDown');
    const inward = held('Equal', 'NumpadAdd') - held('Minus', 'NumpadSubtract');
    if (target) this.orbit(target, -sideways * turn, upward * turn, Math.exp(-inward * seconds));
    else {
      if (sideways || upward) this.turn(sideways * turn, upward * turn);
      this.camera.position.addScaledVector(this.forward(), inward * this.speed() * seconds);
    }
    const forward = this.forward();
    const right = new Vector3().crossVectors(forward, UP).normalize();
    const ahead = target ? new Vector3().crossVectors(UP, right) : forward;
    const way = new Vector3()
      .addScaledVector(ahead, held('KeyW') - held('KeyS'))
      .addScaledVector(right, held('KeyD') - held('KeyA'))
      .addScaledVector(UP, held('KeyE', 'PageUp') - held('KeyQ', 'PageDown'))
      .multiplyScalar(this.speed() * seconds);
    this.camera.position.add(way);
    target?.add(way.setY(0));
    this.camera.position.y = Math.max(lowest, this.camera.position.y);
  }

  private orbit(target: Vector3, around: number, over: number, nearer: number): void {
    const arm = this.camera.position.clone().sub(target).multiplyScalar(nearer).applyAxisAngle(UP, around);
    const right = new Vector3().crossVectors(UP, arm).normalize();
    const lifted = arm.clone().applyAxisAngle(right, -over);
    if (lifted.angleTo(UP) > 0.02 && lifted.y > 0) arm.copy(lifted);
    this.camera.position.copy(target).add(arm);
  }
}

function isControl(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('input, select, textarea, dialog') !== null;
}
