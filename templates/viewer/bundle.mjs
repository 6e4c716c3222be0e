// SPDX-License-Identifier: Apache-2.0
// Bundles the page into one file: node bundle.mjs OUTPUT.html. dist/schema must hold what flatc makes of schemas/runtime_pack.fbs.
import {build} from 'esbuild';
import {mkdir, readFile, writeFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {coastBase64} from './coast.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2] ?? join(here, 'dist', 'viewer.html');
const atlas = createRequire(import.meta.url).resolve('world-atlas/land-50m.json');

const options = {absWorkingDir: here, bundle: true, write: false, minify: true, format: 'iife', target: 'es2022', legalComments: 'inline'};

/** `worker:./file.ts` is the bundled text of a worker, `coast:land` the coastlines. */
const texts = {
  name: 'texts',
  setup(setup) {
    setup.onResolve({filter: /^worker:/}, ({path, resolveDir}) => ({namespace: 'worker', path: join(resolveDir, path.slice('worker:'.length))}));
    setup.onLoad({filter: /./, namespace: 'worker'}, async ({path}) => {
      const worker = await build({...options, entryPoints: [path]});
      return {contents: worker.outputFiles[0].text, loader: 'text'};
    });
    setup.onResolve({filter: /^coast:/}, ({path}) => ({namespace: 'coast', path}));
    setup.onLoad({filter: /./, namespace: 'coast'}, async () => ({contents: await coastBase64(atlas), loader: 'text'}));
  },
};

const bundled = await build({...options, entryPoints: ['src/main.ts'], plugins: [texts]});
const script = bundled.outputFiles[0].text.replaceAll('</script', '<\\/script');
const style = await readFile(join(here, 'src/style.css'), 'utf8');
const shell = await readFile(join(here, 'viewer.html'), 'utf8');

// Functions as replacements: a "$&" in the code must stay what it is.
const page = shell.replace('/* style */', () => style).replace('/* script */', () => script);
await mkdir(dirname(output), {recursive: true});
await writeFile(output, page);
