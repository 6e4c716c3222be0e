// SPDX-License-Identifier: Apache-2.0
// Opens what `cloudgen build` wrote in the viewers that people use.
//   node tests/web/run.mjs --scenes DIR... [--spread] [--page] [--only WORDS]
// Of a folder levels_NAME only the levels of its clouds are looked at.
// A folder NAME.still beside a sky that moves is one of its times alone: its picture is compared.
// --spread: not every scene in every viewer: of four scenes each viewer has the first and third or the second and fourth, and the page
// is opened in one size of two. --page: only index.html; --only: only checks whose name matches this regular expression.
// Pictures are kept in out/.
import {existsSync} from 'node:fs';
import {mkdir, readFile, readdir, writeFile} from 'node:fs/promises';
import {basename, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {hasBrowser} from './lib/browser.mjs';
import {CLOUD_NODES, withoutClouds} from './lib/empty_sky.mjs';
import {Runner} from './lib/runner.mjs';
import {serve} from './lib/server.mjs';
import {drawsByComparison, drawsByRemoval} from './checks/drawing.mjs';
import {skyMoves} from './checks/film.mjs';
import {fliesOnceChosen} from './checks/flight.mjs';
import {looksTheSameOnTheGlobe} from './checks/globe.mjs';
import {levelsSwitchUnseen} from './checks/levels.mjs';
import {pageWorks} from './checks/page.mjs';
import {folderIsStreamed} from './checks/page_folder.mjs';
import {movingPageWorks} from './checks/page_time.mjs';
import {cesiumPage, tilesStandInPlace} from './checks/tiles.mjs';
import {glbIsClean, jsonIsValid, tilesAreClean} from './checks/validation.mjs';
import {view3dsceneDraws} from './checks/view3dscene.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const repository = resolve(here, '../..');

function parsed(words) {
  const options = {scenes: [], spread: false, page: false, only: /./};
  for (let i = 0; i < words.length; ++i) {
    if (words[i] === '--scenes') while (words[i + 1] && !words[i + 1].startsWith('--')) options.scenes.push(resolve(words[++i]));
    else if (words[i] === '--spread') options.spread = true;
    else if (words[i] === '--page') options.page = true;
    else if (words[i] === '--only') options.only = new RegExp(words[++i] ?? '.');
    else throw new Error(`unknown option ${words[i]}`);
  }
  if (!options.scenes.length) throw new Error('usage: node tests/web/run.mjs --scenes DIR... [--spread] [--page] [--only WORDS]');
  for (const folder of options.scenes) if (!existsSync(folder)) throw new Error(`${folder}: no such folder`);
  return options;
}

const SIZES = [{width: 1280, height: 720}, {width: 360, height: 740}];

/** `turn`: null, or the number of this scene, where viewers and sizes take turns. */
async function checkScene(runner, folder, onlyPage, turn) {
  const scene = basename(folder);
  const out = join(here, 'out', scene);
  const has = (file) => existsSync(join(folder, file));
  const picture = (name) => join(out, name);
  const browser = hasBrowser();
  if (!browser) console.log(`skipped ${scene}: everything in a browser, there is no Chromium (set CHROMIUM to its path)`);

  if (has('index.html') && browser)
    for (const size of turn === null ? SIZES : [SIZES[turn % SIZES.length]])
      runner.addAlone(`${scene}: index.html works at ${size.width}x${size.height}`, 300, () => pageWorks(folder, size, picture(`page_${size.width}`)));
  const moves = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8')).valid_times.length > 1;
  if (has('index.html') && browser) {
    if (!turn) runner.addAlone(`${scene}: index.html reads a pack from beside it`, 120, () => folderIsStreamed(folder));
    if (moves)
      runner.addAlone(`${scene}: index.html plays the sky`, 300, () => movingPageWorks(folder, `${folder}.still`, picture('page_time')));
  }
  if (onlyPage) return;

  const texts = {};
  const emptyFile = join(out, 'scene.empty.x3d');
  if (has('scene.x3d')) {
    texts['/empty.x3d'] = withoutClouds(await readFile(join(folder, 'scene.x3d'), 'utf8'));
    await mkdir(out, {recursive: true});
    await writeFile(emptyFile, texts['/empty.x3d']);
  }
  const server = await serve(folder, texts);
  runner.addAfterwards(() => server.close());
  const at = (page, file) => `${server.address}/pages/${page}.html?scene=${file}`;
  // The splats beside a tileset are those of a scene that has no tiles.
  let viewers = 0;
  const isItsTurn = () => turn === null || (!has('tileset.json') && viewers++ % 2 === turn % 2);
  const draws = (viewer, page, file, settle) => {
    if (isItsTurn() && has(file) && browser && !(moves && file === 'scene.x3d'))
      runner.add(`${scene}: ${viewer} draws ${file}`, 300, () =>
        drawsByRemoval(at(page, `/scene/${file}`), picture(`${page}_${file}`), page === 'xite' ? CLOUD_NODES : [], settle),
      );
  };
  const isForLevels = scene.startsWith('levels_');
  if (browser && has('scene.x3d') && !has('index.html') && !moves)
    for (const [way, wantsFull] of [['from picture to picture', false], ['into a cloud', true]])
      if (turn === null || wantsFull === (!isForLevels && turn % 2 === 0))
        runner.add(`${scene}: X_ITE goes ${way} unseen`, 200, () =>
          levelsSwitchUnseen(at('xite', '/scene/scene.x3d'), wantsFull, picture(`levels_${wantsFull ? 'full' : 'pictures'}`)),
        );
  if (isForLevels) return;
  draws('X_ITE', 'xite', 'scene.x3d', 3000);
  draws('X_ITE', 'xite', 'scene.wrl', 3000);
  if (browser && has('scene.geo.x3d'))
    runner.add(`${scene}: X_ITE has scene.geo.x3d in place`, 200, () =>
      looksTheSameOnTheGlobe({globe: at('xite', '/scene/scene.geo.x3d'), plane: at('xite', '/scene/scene.x3d')}, picture('globe')),
    );
  if (browser && has('scene.x3d') && texts['/empty.x3d'].includes('View_Flight'))
    runner.add(`${scene}: X_ITE flies along --fly in scene.x3d`, 200, () => fliesOnceChosen(at('xite', '/scene/scene.x3d')));
  if (has('scene.x3d')) {
    // Where a film is when somebody opens it is chance: see `plays`.
    if (isItsTurn() && browser && !moves)
      runner.add(`${scene}: X3DOM draws scene.x3d`, 400, () =>
        drawsByComparison(at('x3dom', '/scene/scene.x3d'), at('x3dom', '/empty.x3d'), picture('x3dom_scene.x3d')),
      );
    if (isItsTurn())
      runner.add(`${scene}: view3dscene draws scene.x3d`, 200, () =>
        view3dsceneDraws(join(folder, 'scene.x3d'), emptyFile, picture('view3dscene_scene.x3d')),
      );
  }
  if (has('scene.wrl') && has('scene.x3d') && isItsTurn())
    runner.add(`${scene}: view3dscene draws scene.wrl`, 200, () => view3dsceneDraws(join(folder, 'scene.wrl'), emptyFile, picture('view3dscene_scene.wrl')));
  draws('three.js', 'three', 'scene.splats.glb');
  draws('Babylon.js', 'babylon', 'scene.splats.glb', 3000);
  draws('three.js', 'three', 'scene.glb');
  draws('Babylon.js', 'babylon', 'scene.glb');
  const plays = (viewer, page, file) => {
    if (moves && has(file) && browser)
      runner.add(`${scene}: ${viewer} plays ${file}`, 300, () => skyMoves(at(page, `/scene/${file}`), folder, picture(`${page}_${file}_film`)));
  };
  plays('X_ITE', 'xite', 'scene.x3d');
  plays('X3DOM', 'x3dom', 'scene.x3d');
  plays('three.js', 'three', 'scene.glb');
  plays('Babylon.js', 'babylon', 'scene.glb');
  if (has('tileset.json') && browser) await checkTiles(runner, scene, folder, picture);
  for (const file of ['scene.glb', 'scene.splats.glb'])
    if (has(file)) runner.addAlone(`${scene}: gltf-validator has nothing against ${file}`, 120, () => glbIsClean(join(folder, file)));
  if (has('tileset.json')) runner.addAlone(`${scene}: gltf-validator has nothing against tiles/`, 240, () => tilesAreClean(join(folder, 'tiles')));
  runner.addAlone(`${scene}: report.json fits its schema`, 20, () => jsonIsValid(join(folder, 'report.json'), join(repository, 'schemas/report.schema.json')));
}

/** CesiumJS draws packed splats and cards, three.js plain splats. */
async function checkTiles(runner, scene, folder, picture) {
  const tileset = JSON.parse(await readFile(join(folder, 'tileset.json'), 'utf8'));
  const used = tileset.extensions['3DTILES_content_gltf'].extensionsUsed.join();
  const isForCesium = used.includes('spz') || !used.includes('splatting');
  const [viewer, page] = isForCesium ? ['CesiumJS', 'cesium'] : ['3d-tiles-renderer', 'tiles'];
  runner.add(`${scene}: ${viewer} has the clouds of tileset.json in place`, 300, async () => {
    const server = await serve(folder, isForCesium ? {'/cesium_page.js': await cesiumPage()} : {});
    try {
      return await tilesStandInPlace(`${server.address}/pages/${page}.html?tileset=/scene/tileset.json`, folder, picture(`${page}_tileset`));
    } finally {
      server.close();
    }
  });
}

async function checkRecipes(runner) {
  const folder = join(repository, 'templates/types');
  const recipes = existsSync(folder) ? (await readdir(folder)).filter((file) => file.endsWith('.json')).sort() : [];
  for (const recipe of recipes)
    runner.addAlone(`templates/types/${recipe} fits its schema`, 20, () => jsonIsValid(join(folder, recipe), join(repository, 'schemas/recipe.schema.json')));
}

try {
  const options = parsed(process.argv.slice(2));
  const runner = new Runner(options.only);
  for (const [number, folder] of options.scenes.entries()) await checkScene(runner, folder, options.page, options.spread ? number : null);
  if (!options.page) await checkRecipes(runner);
  process.exitCode = await runner.finish();
} catch (error) {
  console.error(error.message);
  process.exitCode = 2;
}
