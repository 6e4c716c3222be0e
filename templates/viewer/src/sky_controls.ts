// SPDX-License-Identifier: Apache-2.0
// The sun slider, and the time slider where there are several hours.
import type {SceneData} from './scene_data';
import {atMinute, minuteOfDay, sunAt} from './sun_clock';
import type {Viewer} from './viewer';

const input = (id: string) => document.getElementById(id) as HTMLInputElement;
const twoDigits = (value: number) => String(value).padStart(2, '0');

export function connectSky(viewer: Viewer, data: SceneData): void {
  const valid = Date.parse(data.validTime);
  connectSun(viewer, data, valid);
  connectTime(viewer, valid);
}

function connectSun(viewer: Viewer, data: SceneData, valid: number): void {
  const slider = input('sun-minute');
  const text = document.getElementById('sun-text')!;
  const place = viewer.frame.toGeographic(viewer.frame.centerX, viewer.frame.centerZ) ?? [data.box.west, data.box.south];
  const show = (clock: string): void => {
    const {azimuthDegrees, elevationDegrees} = viewer.sun;
    const standing = `${Math.abs(elevationDegrees).toFixed(0)}° ${elevationDegrees < 0 ? 'below the horizon' : 'high'}`;
    text.textContent = `Sun ${clock}`;
    slider.setAttribute('aria-valuetext', `${clock}, ${standing}, azimuth ${azimuthDegrees.toFixed(0)}°`);
    document.getElementById('sun')!.textContent = `${standing}, azimuth ${azimuthDegrees.toFixed(0)}°`;
  };
  const clockOf = (minute: number) => `${twoDigits(Math.floor(minute / 60))}:${twoDigits(minute % 60)} UTC`;
  slider.value = String(minuteOfDay(valid));
  show(clockOf(minuteOfDay(valid)));
  slider.addEventListener('input', () => {
    void viewer.setSun(sunAt(atMinute(valid, slider.valueAsNumber), place[0], place[1]));
    show(clockOf(slider.valueAsNumber));
  });
}

function connectTime(viewer: Viewer, valid: number): void {
  const {root} = viewer.pack;
  const hours = root.keyframesLength();
  const box = document.getElementById('time-box')!;
  box.hidden = hours < 2;
  if (hours < 2) return;
  const slider = input('time');
  const first = root.keyframes(0)!.seconds();
  const last = root.keyframes(hours - 1)!.seconds();
  [slider.min, slider.max, slider.step] = ['0', '1000', '1'];
  slider.value = String((1000 * -first) / (last - first));
  const show = (seconds: number) => {
    const clock = new Date(valid + 1000 * seconds).toISOString().slice(0, 16).replace('T', ' ');
    document.getElementById('time-text')!.textContent = `${clock.slice(11)} UTC`;
    slider.setAttribute('aria-valuetext', `${clock} UTC`);
  };
  show(0);
  slider.addEventListener('input', () => {
    const seconds = first + (slider.valueAsNumber / 1000) * (last - first);
    void viewer.setTime(seconds);
    show(seconds);
  });
}
