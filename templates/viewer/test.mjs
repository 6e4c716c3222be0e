// SPDX-License-Identifier: Apache-2.0
// Runs test/*.test.ts, bundled, by node's own test runner: node test.mjs
import {build} from 'esbuild';
import {spawnSync} from 'node:child_process';
import {mkdtemp, readdir, rm} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const out = await mkdtemp(join(tmpdir(), 'cloudgen-viewer-'));
const files = (await readdir(join(here, 'test'))).filter((name) => name.endsWith('.test.ts'));
await build({absWorkingDir: here, entryPoints: files.map((name) => `test/${name}`), bundle: true, platform: 'node', format: 'esm', outdir: out, outExtension: {'.js': '.mjs'}});
const {status} = spawnSync(process.execPath, ['--test', ...files.map((name) => join(out, name.replace('.ts', '.mjs')))], {stdio: 'inherit'});
await rm(out, {recursive: true, force: true});
process.exit(status ?? 1);
