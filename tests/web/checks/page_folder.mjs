// SPDX-License-Identifier: Apache-2.0
// The page of a scene that is too large to stand inside it: scene.cgpack is read from beside it, through a server.
import {readFile} from 'node:fs/promises';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {withPage} from '../lib/browser.mjs';
import {serve} from '../lib/server.mjs';
import {until} from './drawing.mjs';
import {expect, rest, SECONDS} from './page_state.mjs';

/** The page as the writer makes it for packs over 64 MB: the name of the file, and nothing in the pack's slot. */
function withoutPack(page) {
  const named = page.replace(/"pack":\s*\{"bytes":\s*(\d+),\s*"file":\s*null\}/, '"pack":{"bytes":$1,"file":"scene.cgpack"}');
  expect(named !== page, 'the page does not say where its pack is');
  return named.replace(/(id="cloudgen-pack">)[^<]*/, '$1');
}

async function messageOf(page) {
  await until(() => page.evaluate(() => window.cloudgenReady || window.cloudgenError), SECONDS, 'the page is not ready');
  return page.evaluate(() => window.cloudgenError);
}

export async function folderIsStreamed(folder) {
  const text = withoutPack(await readFile(join(folder, 'index.html'), 'utf8'));
  const server = await serve(folder, {'/scene/streamed.html': text, '/cut/index.html': text, '/cut/scene.cgpack': 'CGPK'});
  const alone = await mkdtemp(join(tmpdir(), 'cloudgen-alone-'));
  try {
    return await withPage({width: 640, height: 360}, async (page, seen) => {
      await page.goto(`${server.address}/scene/streamed.html`);
      expect(!(await messageOf(page)), 'a page beside its pack does not open');
      await rest(page);
      expect((await page.evaluate(() => window.cloudgen.drawing.puffs)) > 0, 'no puffs are drawn');
      expect(seen.requests.some((request) => request.endsWith('/scene.cgpack')), 'the pack was not asked for');
      expect(!seen.errors.length, `console: ${seen.errors.join(' | ')}`);

      await page.goto(`${server.address}/cut/index.html`);
      expect(/cut short/.test(await messageOf(page)), 'a pack that is cut short is not told');
      // From the disk no page may read files: it says what to do.
      await writeFile(join(alone, 'index.html'), text);
      await page.goto(pathToFileURL(join(alone, 'index.html')).href);
      expect(/http\.server/.test(await messageOf(page)), 'opened by double-click, it does not say how to serve its folder');
    });
  } finally {
    server.close();
    await rm(alone, {recursive: true, force: true});
  }
}
