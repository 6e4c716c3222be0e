// SPDX-License-Identifier: Apache-2.0
// Bundles the page into one file: node bundle.mjs OUTPUT.html
import {build} from 'esbuild';
import {mkdir, readFile, writeFile} from 'node:fs/promises';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2] ?? join(here, 'dist', 'viewer.html');

// One copy of three: the addons import `three`, the page `three/webgpu`, which holds all of it.
const oneThree = {
  name: 'one-three',
  setup: (build) =>
    build.onResolve({filter: /^three$/}, ({resolveDir}) => build.resolve('three/webgpu', {kind: 'import-statement', resolveDir})),
};

const bundled = await build({
  absWorkingDir: here,
  entryPoints: ['src/main.ts'],
  bundle: true,
  write: false,
  minify: true,
  format: 'iife',
  target: 'es2022',
  plugins: [oneThree],
  legalComments: 'inline',
});
const script = bundled.outputFiles[0].text.replaceAll('</script', '<\\/script');
const style = await readFile(join(here, 'src/style.css'), 'utf8');
const shell = await readFile(join(here, 'viewer.html'), 'utf8');

// Functions as replacements: a "$&" in the code must stay what it is.
const page = shell.replace('/* style */', () => style).replace('/* script */', () => script);
await mkdir(dirname(output), {recursive: true});
await writeFile(output, page);
