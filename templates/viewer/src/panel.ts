// SPDX-License-Identifier: Apache-2.0
import {fillFidelity} from './fidelity';
import type {SceneData} from './scene_data';

function timeText(iso: string): string {
  return iso.replace('T', ' ').replace(/:\d\dZ$/, ' UTC');
}

function hundredMeters(meters: number): string {
  return (Math.max(0, Math.round(meters / 100)) * 100).toLocaleString('en');
}

function setText(id: string, text: string): void {
  const found = document.getElementById(id);
  if (found) found.textContent = text;
}

/** Fills the title, the facts and the legend. Texts from the data are only ever set as text, never as markup. */
export function fillPanels(data: SceneData): void {
  document.title = data.title;
  setText('title', data.title);
  setText('valid', timeText(data.validTime));
  const model = [data.model, data.run && `run of ${timeText(data.run)}`].filter(Boolean).join(', ');
  setText('model', model || 'model not named in the input');
  setText('files', data.files.join(', '));
  setText('clouds', data.counts.clouds.toLocaleString('en'));
  fillLegend(data);
  fillFidelity(data);
  const panel = document.getElementById('panel') as HTMLDetailsElement | null;
  if (panel) panel.open = window.matchMedia('(min-width: 900px) and (min-height: 560px)').matches;
}

function fillLegend(data: SceneData): void {
  const list = document.getElementById('genera');
  if (!list) return;
  const most = Math.max(1, ...data.genera.map((genus) => genus.count));
  for (const genus of data.genera) {
    const row = document.createElement('li');
    row.dataset.genus = genus.abbreviation;
    const label = row.appendChild(document.createElement('label'));
    const box = label.appendChild(document.createElement('input'));
    [box.type, box.value, box.checked] = ['checkbox', genus.abbreviation, true];
    const add = (kind: string, text: string) => {
      const part = label.appendChild(document.createElement('span'));
      part.className = kind;
      part.textContent = text;
      return part;
    };
    add('genus', genus.abbreviation);
    add('name', genus.name);
    add('count', genus.count.toLocaleString('en'));
    add('heights', `${hundredMeters(genus.lowestBaseMeters)} to ${hundredMeters(genus.highestTopMeters)} m`);
    const bar = add('bar', '');
    bar.style.width = `${Math.max(3, (72 * genus.count) / most)}px`;
    bar.style.background = genus.color;
    list.append(row);
  }
  if (!data.genera.length) list.append(Object.assign(document.createElement('li'), {textContent: 'A clear sky: no clouds'}));
}

/** Shows how far loading is, or what went wrong. */
export function showStatus(text: string, failed = false): void {
  const status = document.getElementById('status');
  if (!status) return;
  status.textContent = text;
  status.hidden = text === '';
  status.classList.toggle('failed', failed);
  status.setAttribute('role', failed ? 'alert' : 'status');
}
