// SPDX-License-Identifier: Apache-2.0
// Puts labelled PNGs side by side into one JPEG: node sheet.mjs OUT.jpg COLUMNS LABEL PNG [LABEL PNG ...]
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const { chromium } = createRequire(new URL('../../tests/web/package.json', import.meta.url))('playwright-core');
const [out, columns, ...rest] = process.argv.slice(2);
const figures = [];
for (let i = 0; i + 1 < rest.length; i += 2) {
  const data = readFileSync(rest[i + 1]).toString('base64');
  figures.push(`<figure><img src="data:image/png;base64,${data}"><figcaption>${rest[i]}</figcaption></figure>`);
}
const page = `<style>
  body { margin: 0; display: inline-grid; grid-template-columns: repeat(${Number(columns)}, auto); gap: 4px; background: #fff }
  figure { margin: 0; position: relative } img { display: block }
  figcaption { position: absolute; left: 6px; bottom: 4px; font: 14px "DejaVu Sans", sans-serif; color: #fff; text-shadow: 0 0 3px #000 }
</style>${figures.join('')}`;

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
try {
  const tab = await browser.newPage({ viewport: { width: 2000, height: 1200 } });
  await tab.setContent(page);
  await tab.locator('body').screenshot({ path: out, type: 'jpeg', quality: 80 });
} finally {
  await browser.close();
}
