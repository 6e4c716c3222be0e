// SPDX-License-Identifier: Apache-2.0
import type {Viewer} from './viewer';
import {VIEW_NAMES, type ViewName} from './views';

function button(id: string): HTMLButtonElement {
  return document.getElementById(id) as HTMLButtonElement;
}

/** Connects buttons, slider and single-key commands with the viewer, and keeps them in step with it. */
export function connectControls(viewer: Viewer): void {
  const help = document.getElementById('help') as HTMLDialogElement;
  const slider = document.getElementById('exaggeration') as HTMLInputElement;
  const panel = document.getElementById('panel') as HTMLDetailsElement;
  const toggleMode = () => viewer.setMode(viewer.mode === 'orbit' ? 'fly' : 'orbit');
  const toggleHelp = () => (help.open ? help.close() : help.showModal());

  for (const name of VIEW_NAMES) button(`view-${name}`).addEventListener('click', () => viewer.setView(name));
  button('mode').addEventListener('click', toggleMode);
  button('compass').addEventListener('click', () => viewer.turnNorth());
  button('help-button').addEventListener('click', toggleHelp);
  slider.addEventListener('input', () => viewer.setExaggeration(slider.valueAsNumber));

  const commands: Record<string, () => void> = {
    Digit1: () => viewer.setView('overview'),
    Digit2: () => viewer.setView('near'),
    Digit3: () => viewer.setView('ground'),
    Digit4: () => viewer.setView('top'),
    KeyF: toggleMode,
    KeyN: () => viewer.turnNorth(),
    KeyL: () => (panel.open = !panel.open),
    KeyH: toggleHelp,
  };
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    if (help.open && event.code !== 'KeyH') return;
    const command = commands[event.code] ?? (event.key === '?' ? toggleHelp : undefined);
    if (!command) return;
    event.preventDefault();
    command();
  });

  viewer.onChange = () => {
    for (const name of VIEW_NAMES) button(`view-${name}`).setAttribute('aria-pressed', String(name === (viewer.view as ViewName)));
    const flying = viewer.mode === 'fly';
    button('mode').textContent = flying ? 'Flying' : 'Orbiting';
    button('mode').setAttribute('aria-pressed', String(flying));
    slider.value = String(viewer.exaggeration);
    const text = viewer.exaggeration === 1 ? 'true heights' : `heights × ${viewer.exaggeration}`;
    slider.setAttribute('aria-valuetext', text);
    const note = document.getElementById('exaggeration-text')!;
    note.textContent = text;
    note.classList.toggle('stretched', viewer.exaggeration !== 1);
  };
  viewer.onChange();
}
