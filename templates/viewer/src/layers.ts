// SPDX-License-Identifier: Apache-2.0
// Which genera and which levels are shown.
import {LEVEL_NAMES} from './pack/sky_maker';
import type {Viewer} from './viewer';

export function connectLayers(viewer: Viewer): void {
  const boxes = [...document.querySelectorAll<HTMLInputElement>('#genera input')];
  const levels = LEVEL_NAMES.map((name) => document.getElementById(`level-${name}`) as HTMLInputElement);
  const off = (all: HTMLInputElement[]) => all.filter((box) => !box.checked).map((box) => box.value);
  const apply = () => void viewer.setLayers({hiddenGenera: off(boxes), hiddenLevels: off(levels)});
  for (const box of [...boxes, ...levels]) box.addEventListener('change', apply);
}
