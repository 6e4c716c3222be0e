// SPDX-License-Identifier: Apache-2.0

/** Root nodes of these types hold clouds; the rest of a scene is sky, ground, light and viewpoints. */
export const CLOUD_NODES = ['LOD', 'Group', 'StaticGroup', 'Transform', 'Inline', 'Billboard', 'Switch'];

const TOKEN = /<!--[\s\S]*?-->|<!\[CDATA\[[\s\S]*?\]\]>|<\?[\s\S]*?\?>|<!DOCTYPE[^>]*>|<(\/?)([A-Za-z][\w.-]*)(?:"[^"]*"|'[^']*'|[^>"'])*?(\/?)>/g;

/** The X3D document without the clouds: root nodes that hold them and routes between them are left out. */
export function withoutClouds(x3d) {
  let out = '';
  let copied = 0;
  let depth = 0;
  let sceneDepth = -1;
  let dropping = false;
  for (const match of x3d.matchAll(TOKEN)) {
    const [text, closing, name, selfClosing] = match;
    if (!name) continue;
    if (closing) --depth;
    const atRoot = sceneDepth >= 0 && depth === sceneDepth + 1;
    if (!closing && atRoot && (CLOUD_NODES.includes(name) || name === 'ROUTE')) {
      out += x3d.slice(copied, match.index);
      dropping = !selfClosing;
      copied = match.index + text.length;
    } else if (closing && atRoot && dropping) {
      copied = match.index + text.length;
      dropping = false;
    }
    if (!closing && name === 'Scene') sceneDepth = depth;
    if (!closing && !selfClosing) ++depth;
  }
  return out + x3d.slice(copied);
}
