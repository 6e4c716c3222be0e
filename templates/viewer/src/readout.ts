// SPDX-License-Identifier: Apache-2.0
import {axesOf, projected, rayThrough, type Camera} from './camera';
import {placeText, type Frame} from './frame';
import {heightText, lengthText} from './heights';
import {along, distance, type Vec3} from './math';
import type {Viewer} from './viewer';

const TEXT_MILLISECONDS = 120;

function element(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found;
}

/** Scale bar, compass, coordinates, camera height and the labels of the graticule. */
export class Readout {
  private due = 0;
  private pointer: {u: number; v: number} | null = null;
  private readonly labelElements: HTMLElement[] = [];
  private readonly frame: Frame;

  constructor(private readonly viewer: Viewer) {
    this.frame = viewer.frame;
    for (const label of viewer.lines.labels) {
      const text = document.createElement('span');
      text.textContent = label.text;
      this.labelElements.push(element('labels').appendChild(text));
    }
    const {canvas} = viewer;
    canvas.addEventListener('pointermove', (event) => {
      this.pointer = event.pointerType === 'mouse' ? {u: event.offsetX / canvas.clientWidth, v: event.offsetY / canvas.clientHeight} : null;
      this.showPlace(viewer.camera);
    });
    canvas.addEventListener('pointerleave', () => {
      this.pointer = null;
      this.showPlace(viewer.camera);
    });
  }

  /**
   * Everything that depends on the camera. Texts follow a little later, as they cost more than the eye can read; labels on the ground
   * wait for the view to rest where it is drawn coarsely, as a layer over the whole picture costs a fifth of a frame there.
   */
  update(moving: boolean): void {
    const labels = element('labels');
    labels.hidden = moving && this.viewer.drawing.canvas < 1;
    if (!labels.hidden) this.placeLabels(this.viewer.camera);
    if (this.due) return;
    this.due = window.setTimeout(() => this.updateTexts(), TEXT_MILLISECONDS);
  }

  private updateTexts(): void {
    const {camera} = this.viewer;
    this.due = 0;
    element('height').textContent = heightText(camera.eye[1] / this.viewer.exaggeration);
    this.showPlace(camera);
    this.showScale(camera);
    this.showCompass(camera);
  }

  private onGround(camera: Camera, u: number, v: number): Vec3 | null {
    const ray = rayThrough(camera, u, v);
    if (ray[1] >= -1e-4) return null;
    const way = (this.viewer.groundMeters - camera.eye[1]) / ray[1];
    return way < 6 * this.frame.size + 100_000 ? along(camera.eye, way, ray) : null;
  }

  private showPlace(camera: Camera): void {
    const point = this.onGround(camera, this.pointer?.u ?? 0.5, this.pointer?.v ?? 0.5);
    const place = point && this.frame.toGeographic(point[0], point[2]);
    element('place-of').textContent = this.pointer ? 'Pointer' : 'Centre';
    element('place').textContent = place && point ? placeText(place[0], place[1], this.metersPerPixel(camera, distance(point, camera.eye))) : 'sky';
  }

  private metersPerPixel(camera: Camera, away: number): number {
    return (2 * away * Math.tan(0.5 * camera.fieldRadians)) / this.viewer.canvas.clientHeight;
  }

  private showScale(camera: Camera): void {
    const center = this.onGround(camera, 0.5, 0.5) ?? this.viewer.target;
    const away = distance(center, camera.eye);
    const widest = 110 * this.metersPerPixel(camera, away);
    const power = Math.pow(10, Math.floor(Math.log10(widest)));
    const length = [5, 2, 1].map((digit) => digit * power).find((candidate) => candidate <= widest) ?? power;
    element('scale-bar').style.width = `${length / this.metersPerPixel(camera, away)}px`;
    element('scale-text').textContent = `${lengthText(length)} at ${lengthText(away)} away`;
  }

  private showCompass(camera: Camera): void {
    const {forward, up} = axesOf(camera);
    // Looking straight down, the top of the picture is the heading.
    const heading = Math.hypot(forward[0], forward[2]) < 0.05 ? up : forward;
    const north = this.frame.northAt(camera.eye[0], camera.eye[2]);
    const degrees = ((Math.atan2(heading[0], -heading[2]) - north) * 180) / Math.PI;
    element('needle').style.transform = `rotate(${-degrees}deg)`;
    const names = ['north', 'north-east', 'east', 'south-east', 'south', 'south-west', 'west', 'north-west'];
    const bearing = Math.round((degrees + 360) % 360) % 360;
    const shown = `${String(bearing).padStart(3, '0')}°`;
    element('compass').setAttribute('aria-label', `N ${shown}: looking ${names[Math.round(bearing / 45) % 8]}. Turn the view to north`);
    element('bearing').textContent = shown;
  }

  private placeLabels(camera: Camera): void {
    const {canvas, groundMeters, lines} = this.viewer;
    const taken: [number, number][] = [];
    lines.labels.forEach((label, index) => {
      const text = this.labelElements[index];
      const place: Vec3 = [label.x, groundMeters, label.z];
      const seen = projected(camera, place);
      // From near the ground the far borders lie on the horizon, where labels would only crowd.
      const grazing = (camera.eye[1] - groundMeters) / distance(place, camera.eye);
      const [x, y] = [(seen?.u ?? 2) * canvas.clientWidth, (seen?.v ?? 2) * canvas.clientHeight];
      const inside = seen !== null && Math.abs(2 * seen.u - 1) < 0.98 && Math.abs(2 * seen.v - 1) < 0.98;
      const shown = grazing > 0.01 && inside && taken.every(([a, b]) => Math.abs(a - x) > 44 || Math.abs(b - y) > 18);
      text.hidden = !shown;
      if (!shown) return;
      taken.push([x, y]);
      text.style.transform = label.kind === 'parallel' ? `translate(${x - 6}px, ${y}px) translate(-100%, -50%)` : `translate(${x}px, ${y + 6}px) translate(-50%, 0)`;
    });
  }
}
