// SPDX-License-Identifier: Apache-2.0
import {PerspectiveCamera, Raycaster, Vector2, Vector3} from 'three/webgpu';
import {placeText, type Frame} from './frame';
import type {GroundLabel} from './ground';

const METERS_PER_FOOT = 0.3048;

function element(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found;
}

function lengthText(meters: number): string {
  return meters >= 1000 ? `${(meters / 1000).toLocaleString('en', {maximumFractionDigits: meters < 10_000 ? 1 : 0})} km` : `${Math.round(meters)} m`;
}

/** Scale bar, compass, coordinates, camera height and the labels of the graticule. */
export class Readout {
  private readonly caster = new Raycaster();
  private readonly pointer = new Vector2();
  private pointerInside = false;
  private readonly labelElements: HTMLElement[] = [];

  constructor(
    private readonly frame: Frame,
    private readonly camera: PerspectiveCamera,
    private readonly surface: HTMLElement,
    private readonly groundMeters: number,
    private readonly labels: GroundLabel[],
  ) {
    for (const label of labels) {
      const text = document.createElement('span');
      text.textContent = label.text;
      this.labelElements.push(element('labels').appendChild(text));
    }
    surface.addEventListener('pointermove', (event) => {
      this.pointerInside = event.pointerType === 'mouse';
      this.pointer.set((event.offsetX / surface.clientWidth) * 2 - 1, 1 - (event.offsetY / surface.clientHeight) * 2);
      this.showPlace();
    });
    surface.addEventListener('pointerleave', () => {
      this.pointerInside = false;
      this.showPlace();
    });
  }

  /** Everything that depends on the camera. */
  update(target: Vector3, exaggeration: number): void {
    const trueHeight = this.camera.position.y / exaggeration;
    element('height').textContent = `${lengthText(trueHeight)} / ${(Math.round(trueHeight / METERS_PER_FOOT / 10) * 10).toLocaleString('en')} ft`;
    this.showPlace();
    this.showScale(target);
    this.showCompass();
    this.placeLabels();
  }

  private onGround(screen: Vector2): Vector3 | null {
    this.caster.setFromCamera(screen, this.camera);
    const {origin, direction} = this.caster.ray;
    if (direction.y >= -1e-4) return null;
    const point = origin.clone().addScaledVector(direction, (this.groundMeters - origin.y) / direction.y);
    return point.distanceTo(origin) < 6 * this.frame.size + 100_000 ? point : null;
  }

  private showPlace(): void {
    const point = this.onGround(this.pointerInside ? this.pointer : new Vector2(0, 0));
    const place = point && this.frame.toGeographic(point.x, point.z);
    element('place-of').textContent = this.pointerInside ? 'Pointer' : 'Centre';
    element('place').textContent =
      place && point ? placeText(place[0], place[1], this.metersPerPixel(point.distanceTo(this.camera.position))) : 'sky';
  }

  private metersPerPixel(distance: number): number {
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.surface.clientHeight;
  }

  private showScale(target: Vector3): void {
    const center = this.onGround(new Vector2(0, 0));
    const distance = (center ?? target).distanceTo(this.camera.position);
    const widest = 110 * this.metersPerPixel(distance);
    const power = Math.pow(10, Math.floor(Math.log10(widest)));
    const length = [5, 2, 1].map((digit) => digit * power).find((candidate) => candidate <= widest) ?? power;
    element('scale-bar').style.width = `${length / this.metersPerPixel(distance)}px`;
    element('scale-text').textContent = `${lengthText(length)} at ${lengthText(distance)} away`;
  }

  private showCompass(): void {
    const heading = this.camera.getWorldDirection(new Vector3());
    // Looking straight down, the top of the picture is the heading.
    if (Math.hypot(heading.x, heading.z) < 0.05) heading.set(0, 1, 0).applyQuaternion(this.camera.quaternion);
    const north = this.frame.northAt(this.camera.position.x, this.camera.position.z);
    const degrees = ((Math.atan2(heading.x, -heading.z) - north) * 180) / Math.PI;
    element('needle').style.transform = `rotate(${-degrees}deg)`;
    const names = ['north', 'north-east', 'east', 'south-east', 'south', 'south-west', 'west', 'north-west'];
    const bearing = Math.round((degrees + 360) % 360) % 360;
    element('compass').setAttribute('aria-label', `Looking ${names[Math.round(bearing / 45) % 8]}, ${bearing} degrees. Turn the view to north`);
    element('bearing').textContent = `${String(bearing).padStart(3, '0')}°`;
  }

  private placeLabels(): void {
    const point = new Vector3();
    const taken: [number, number][] = [];
    this.labels.forEach((label, index) => {
      const text = this.labelElements[index];
      point.set(label.x, this.groundMeters, label.z);
      // From near the ground the far borders lie on the horizon, where labels would only crowd.
      const grazing = (this.camera.position.y - this.groundMeters) / point.distanceTo(this.camera.position);
      point.project(this.camera);
      const x = ((point.x + 1) / 2) * this.surface.clientWidth;
      const y = ((1 - point.y) / 2) * this.surface.clientHeight;
      const shown =
        grazing > 0.01 && point.z < 1 && Math.abs(point.x) < 0.98 && Math.abs(point.y) < 0.98 && taken.every(([a, b]) => Math.abs(a - x) > 44 || Math.abs(b - y) > 18);
      text.hidden = !shown;
      if (!shown) return;
      taken.push([x, y]);
      text.style.transform = label.kind === 'parallel' ? `translate(${x - 6}px, ${y}px) translate(-100%, -50%)` : `translate(${x}px, ${y + 6}px) translate(-50%, 0)`;
    });
  }
}
