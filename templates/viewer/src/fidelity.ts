// SPDX-License-Identifier: Apache-2.0
import type {Fidelity, SceneData, Score} from './scene_data';

function signed(value: number, digits: number): string {
  return `${value < 0 ? '−' : '+'}${Math.abs(value).toFixed(digits)}`;
}

const coverText = (score: Score) => `bias ${signed(score.bias ?? 0, 3)}, RMSE ${(score.rmse ?? 0).toFixed(3)}`;

function heightText(score: Score): string {
  if (score.bias === null || score.rmse === null) return 'nothing to compare';
  return `bias ${signed(score.bias, 0)} m, RMSE ${score.rmse.toFixed(0)} m`;
}

/** Name, text and the start of the names of the measures that break it. */
function rowsOf(fidelity: Fidelity): [string, string, string][] {
  const {cover, optical_depth: depth, genus} = fidelity;
  const correlation = depth.correlation === null ? '' : `, correlation ${depth.correlation.toFixed(3)}`;
  const rows: [string, string, string][] = [
    ['Cover', coverText(cover.total), 'cover.total'],
    ['low', coverText(cover.low), 'cover.low'],
    ['middle', coverText(cover.middle), 'cover.middle'],
    ['high', coverText(cover.high), 'cover.high'],
    ['Optical depth', `bias ${signed(100 * depth.bias_relative, 1)} %${correlation}`, 'optical_depth'],
    ['Base', heightText(fidelity.base_m), 'base_m'],
    ['Top', heightText(fidelity.top_m), 'top_m'],
  ];
  if (cover.populated?.columns) rows.splice(4, 0, ['populated', coverText(cover.populated.total), 'cover.populated']);
  if (genus.agreement !== null) rows.push(['Types', `${(100 * genus.agreement).toFixed(1)} % of ${genus.clouds.toLocaleString('en')} clouds`, 'genus']);
  return rows;
}

function append<Name extends keyof HTMLElementTagNameMap>(parent: HTMLElement, name: Name, text = '', kind = ''): HTMLElementTagNameMap[Name] {
  const made = parent.appendChild(document.createElement(name));
  made.textContent = text;
  if (kind) made.className = kind;
  return made;
}

/** How well the sky shows its model, as the build verified it; or that it did not. */
export function fillFidelity(data: SceneData): void {
  const panel = document.getElementById('fidelity');
  if (!panel) return;
  const fidelity = data.verification;
  panel.dataset.verified = fidelity ? (fidelity.passed ? 'passed' : 'failed') : 'no';
  if (!fidelity) {
    append(panel, 'p', 'Not verified when it was built (build --verify does; cloudgen verify compares it at any time).', 'quiet');
    return;
  }
  const broken = fidelity.broken.length;
  const verdict = fidelity.passed ? 'Passed: the sky shows its model' : `Failed: ${broken} ${broken === 1 ? 'tolerance is' : 'tolerances are'} broken`;
  append(panel, 'p', verdict, fidelity.passed ? 'passed' : 'broken');
  const list = append(panel, 'dl');
  for (const [name, text, measure] of rowsOf(fidelity)) {
    const row = append(list, 'div');
    append(row, 'dt', name);
    const isBroken = fidelity.broken.some((breach) => breach.measure.startsWith(measure));
    append(row, 'dd', isBroken ? `${text} ✗` : text, isBroken ? 'broken' : '').title = isBroken ? 'out of tolerance' : '';
  }
  append(panel, 'p', `Scene minus model over ${fidelity.columns.toLocaleString('en')} model column${fidelity.columns === 1 ? '' : 's'}, read from ${fidelity.read.file}.`, 'quiet');
  for (const map of data.maps ?? []) {
    const figure = append(panel, 'figure');
    const link = append(figure, 'a');
    link.href = map.file;
    link.target = '_blank';
    const picture = append(link, 'img');
    picture.src = map.picture;
    picture.alt = `Map of ${map.name}`;
    append(figure, 'figcaption', `${map.name}: model, scene, difference`);
  }
}
