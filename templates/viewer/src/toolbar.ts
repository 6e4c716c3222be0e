// SPDX-License-Identifier: Apache-2.0
import {pathFromText} from './path';
import {showStatus} from './panel';
import {MODES, type Mode, type Viewer} from './viewer';
import {VIEW_NAMES} from './views';

const button = (id: string) => document.getElementById(id) as HTMLButtonElement;
const input = (id: string) => document.getElementById(id) as HTMLInputElement;

/** Connects buttons, sliders and single-key commands with the viewer, and keeps them in step with it. */
export function connectControls(viewer: Viewer): void {
  const help = document.getElementById('help') as HTMLDialogElement;
  const panel = document.getElementById('panel') as HTMLDetailsElement;
  const toggleHelp = () => (help.open ? help.close() : help.showModal());
  const stretch = input('exaggeration');

  for (const name of VIEW_NAMES) button(`view-${name}`).addEventListener('click', () => viewer.setView(name));
  for (const mode of MODES) button(`mode-${mode}`).addEventListener('click', () => viewer.setMode(mode));
  button('compass').addEventListener('click', () => viewer.turnNorth());
  button('help-button').addEventListener('click', toggleHelp);
  button('screenshot').addEventListener('click', () => void saveScreenshot(viewer));
  stretch.addEventListener('input', () => viewer.setExaggeration(stretch.valueAsNumber));
  connectPath(viewer);

  const next = (mode: Mode): Mode => MODES[(MODES.indexOf(mode) + 1) % MODES.length];
  const commands: Record<string, () => void> = {
    KeyF: () => viewer.setMode(next(viewer.mode)),
    KeyN: () => viewer.turnNorth(),
    KeyL: () => (panel.open = !panel.open),
    KeyP: () => void saveScreenshot(viewer),
    KeyH: toggleHelp,
    Enter: () => void viewer.pickAt(),
    Space: () => button(viewer.mode === 'follow' ? 'path-play' : 'time-play').click(),
  };
  VIEW_NAMES.forEach((name, i) => (commands[`Digit${i + 1}`] = () => viewer.setView(name)));
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    if (help.open && event.code !== 'KeyH') return;
    const onControl = event.target instanceof Element && event.target.closest('button, summary, input, select, a') !== null;
    if (onControl && (event.code === 'Enter' || event.code === 'Space')) return;
    const command = commands[event.code] ?? (event.key === '?' ? toggleHelp : undefined);
    if (!command) return;
    event.preventDefault();
    command();
  });

  const follow = input('path-place');
  viewer.onChange = () => {
    for (const name of VIEW_NAMES) button(`view-${name}`).setAttribute('aria-pressed', String(name === viewer.view));
    for (const mode of MODES) button(`mode-${mode}`).setAttribute('aria-pressed', String(mode === viewer.mode));
    document.getElementById('path-box')!.hidden = viewer.mode !== 'follow';
    follow.value = String((1000 * viewer.followMeters) / viewer.path.lengthMeters);
    stretch.value = String(viewer.exaggeration);
    const text = viewer.exaggeration === 1 ? 'true heights' : `heights × ${viewer.exaggeration}`;
    stretch.setAttribute('aria-valuetext', text);
    const note = document.getElementById('exaggeration-text')!;
    note.textContent = text;
    note.classList.toggle('stretched', viewer.exaggeration !== 1);
  };
  viewer.onChange();
}

/** Play and pause, the place on the path, and a path of one's own. */
function connectPath(viewer: Viewer): void {
  const play = button('path-play');
  const place = input('path-place');
  const file = input('path-file');
  const setSpeed = (speed: number) => {
    viewer.followSpeed = speed;
    play.textContent = speed ? 'Pause' : 'Fly on';
    viewer.requestFrame();
  };
  play.addEventListener('click', () => setSpeed(viewer.followSpeed ? 0 : 1));
  place.addEventListener('input', () => viewer.flyTo((place.valueAsNumber / 1000) * viewer.path.lengthMeters));
  file.addEventListener('change', () => {
    const chosen = file.files?.[0];
    if (!chosen) return;
    chosen
      .text()
      .then((text) => {
        viewer.path = pathFromText(text, viewer.frame, viewer.path.placeAt(0)[1]);
        viewer.flyTo(0);
      })
      .catch((error: Error) => {
        showStatus(error.message, true);
        window.setTimeout(() => showStatus(''), 6000);
      });
  });
}

async function saveScreenshot(viewer: Viewer): Promise<void> {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(await viewer.screenshot());
  link.download = 'clouds.png';
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
