import {withPage} from './lib/browser.mjs';
import {writeFileSync} from 'node:fs';
const [folder, ...views] = process.argv.slice(2);
await withPage({width:1280,height:720}, async (page, seen) => {
  const t0 = Date.now();
  await page.goto('file://' + folder + '/index.html');
  for (let i = 0; i < 120; ++i) { if (await page.evaluate(() => window.cloudgenReady || window.cloudgenError)) break; await page.waitForTimeout(250); }
  console.log('ready', Date.now() - t0, await page.evaluate(() => window.cloudgenError), seen.errors);
  if (!(await page.evaluate(() => window.cloudgenReady))) return;
  for (const v of views) {
    const quick = v.endsWith('!'); const name = v.replace('!', '');
    if (name.startsWith('{')) await page.evaluate(name.slice(1, -1)); else await page.evaluate((n) => window.cloudgen.setView(n), name);
    if (quick) { await page.evaluate(() => { clearTimeout(window.cloudgen.rest); window.cloudgen.refine = async () => {}; }); await page.waitForTimeout(1500); }
    else for (let i = 0; i < 200 && !(await page.evaluate(() => window.cloudgen.isAtRest)); ++i) await page.waitForTimeout(200);
    console.log(v, Date.now() - t0, await page.evaluate(() => JSON.stringify({...window.cloudgen.drawing, fine: window.cloudgen.renderer.fine.count})));
    writeFileSync(folder + '/shot_' + views.indexOf(v) + '.png', await page.screenshot({timeout: 60000}));
  }
  console.log(seen.errors);
});
