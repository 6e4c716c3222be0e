// SPDX-License-Identifier: Apache-2.0
// The sun slider, and the time slider where there are several hours.
import type {SceneData} from './scene_data';
import {seldom} from './seldom';
import {TimePlayer} from './time_player';
import {atMinute, minuteOfDay, sunAt} from './sun_clock';
import type {Viewer} from './viewer';

const input = (id: string) => document.getElementById(id) as HTMLInputElement;
const twoDigits = (value: number) => String(value).padStart(2, '0');

/** To paint texts takes long. */
const TEXT_MILLISECONDS = 150;

/** Clock time of the sun, shown and set. */
interface SunClock {
  goTo(milliseconds: number): void;
}

export function connectSky(viewer: Viewer, data: SceneData): void {
  const valid = Date.parse(data.validTime);
  connectTime(viewer, valid, connectSun(viewer, data, valid));
}

function connectSun(viewer: Viewer, data: SceneData, valid: number): SunClock {
  const slider = input('sun-minute');
  const text = document.getElementById('sun-text')!;
  const place = viewer.frame.toGeographic(viewer.frame.centerX, viewer.frame.centerZ) ?? [data.box.west, data.box.south];
  const show = seldom((minute: number): void => {
    slider.value = String(minute);
    const clock = `${twoDigits(Math.floor(minute / 60))}:${twoDigits(minute % 60)} UTC`;
    const {azimuthDegrees, elevationDegrees} = viewer.sun;
    const standing = `${Math.abs(elevationDegrees).toFixed(0)}° ${elevationDegrees < 0 ? 'below the horizon' : 'high'}`;
    text.textContent = `Sun ${clock}`;
    slider.setAttribute('aria-valuetext', `${clock}, ${standing}, azimuth ${azimuthDegrees.toFixed(0)}°`);
    document.getElementById('sun')!.textContent = `${standing}, azimuth ${azimuthDegrees.toFixed(0)}°`;
  }, TEXT_MILLISECONDS);
  const goTo = (milliseconds: number): void => {
    void viewer.setSun(sunAt(milliseconds, place[0], place[1]));
    show(minuteOfDay(milliseconds));
  };
  show(minuteOfDay(valid));
  slider.addEventListener('input', () => goTo(atMinute(valid, slider.valueAsNumber)));
  return {goTo};
}

/** Play and pause, speed and place in time of a sky that moves; the sun goes with it. */
function connectTime(viewer: Viewer, valid: number, sun: SunClock): void {
  const {root} = viewer.pack;
  const hours = root.keyframesLength();
  document.getElementById('time-box')!.hidden = hours < 2;
  if (hours < 2) return;
  const slider = input('time');
  const play = document.getElementById('time-play')!;
  const speed = document.getElementById('time-speed') as HTMLSelectElement;
  const show = seldom((seconds: number): void => {
    const clock = new Date(valid + 1000 * seconds).toISOString().slice(0, 16).replace('T', ' ');
    document.getElementById('time-text')!.textContent = `${clock.slice(11)} UTC`;
    slider.value = String(seconds);
    slider.setAttribute('aria-valuetext', `${clock} UTC`);
  }, TEXT_MILLISECONDS);
  const player = new TimePlayer(root.keyframes(0)!.seconds(), root.keyframes(hours - 1)!.seconds(), 0, (seconds) => {
    void viewer.setTime(seconds);
    sun.goTo(valid + 1000 * seconds);
    show(seconds);
  });
  const showPlaying = (): void => {
    play.textContent = player.isPlaying ? 'Pause' : 'Play';
    play.setAttribute('aria-label', player.isPlaying ? 'Pause the sky' : 'Play the sky');
  };
  [slider.min, slider.max, slider.step] = [String(player.first), String(player.last), '1'];
  show(0);
  slider.addEventListener('input', () => player.goTo(slider.valueAsNumber));
  play.addEventListener('click', () => {
    if (player.isPlaying) player.pause();
    else player.play();
    showPlaying();
  });
  speed.addEventListener('change', () => (player.speed = Number(speed.value)));
  player.speed = Number(speed.value);
  showPlaying();
}
