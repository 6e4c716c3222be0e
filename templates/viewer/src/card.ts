// SPDX-License-Identifier: Apache-2.0
// What is known of a cloud that was picked.
import {placeText} from './frame';
import {heightText} from './heights';
import type {CloudRecord} from './pack/pack_view';
import type {SceneData} from './scene_data';
import type {Viewer} from './viewer';

/** A cloud's number is made of its cell, its layer (8 bits) and its number in the layer (24 bits). */
export function cellOf(record: Pick<CloudRecord, 'id'>): {cell: bigint; layer: number; number: number} {
  return {cell: record.id >> 32n, layer: Number((record.id >> 24n) & 255n), number: Number(record.id & 0xffffffn)};
}

export function connectCard(viewer: Viewer, data: SceneData): void {
  const card = document.getElementById('card')!;
  const close = () => (card.hidden = true);
  document.getElementById('card-close')!.addEventListener('click', () => {
    close();
    viewer.canvas.focus();
  });
  viewer.onPick = (cloud) => (cloud === null ? close() : show(viewer, data, cloud));
}

function show(viewer: Viewer, data: SceneData, cloud: number): void {
  const set = (id: string, text: string) => (document.getElementById(id)!.textContent = text);
  const {clouds, archetypes} = viewer.pack;
  const genus = archetypes[clouds.archetype(cloud)].genus;
  const record = viewer.pack.record(cloud);
  const name = data.genera.find((entry) => entry.abbreviation === genus)?.name ?? genus;
  set('card-genus', `${name} (${genus})`);
  set('card-base', record ? heightText(record.baseMeters) : 'not told');
  set('card-top', record ? heightText(record.topMeters) : 'not told');
  set('card-depth', record ? record.opticalDepth.toPrecision(3) : 'not told');
  set('card-rule', record?.rule || 'not told');
  const place = viewer.frame.toGeographic(clouds.floats[6 * cloud], clouds.floats[6 * cloud + 2]);
  set('card-place', place ? placeText(place[0], place[1]) : '');
  const cell = record && cellOf(record);
  set('card-cell', cell ? `${cell.cell}, layer ${record.layer}, cloud ${cell.number}` : 'not told');
  set('card-id', record ? `cloudgen explain DIR ${record.id}` : '');
  document.getElementById('card')!.hidden = false;
}
