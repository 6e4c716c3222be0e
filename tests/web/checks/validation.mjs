// SPDX-License-Identifier: Apache-2.0
// Khronos's glTF validator, and JSON files against the schemas of this project.
import {existsSync} from 'node:fs';
import {readFile, readdir} from 'node:fs/promises';
import {dirname, join} from 'node:path';
import {Ajv} from 'ajv';
import Ajv2020 from 'ajv/dist/2020.js';
import validator from 'gltf-validator';
import {Skip} from '../lib/runner.mjs';

const WARNING = 1;

const bytesOf = async (file) => new Uint8Array(await readFile(file));

async function messages(file) {
  const beside = (uri) => bytesOf(join(dirname(file), decodeURIComponent(uri)));
  const report = await validator.validateBytes(await bytesOf(file), {maxIssues: 0, externalResourceFunction: beside});
  return report.issues.messages;
}

function tell(issues) {
  return issues.slice(0, 3).map(({code, pointer, message}) => `${code} at ${pointer}: ${message}`).join('; ');
}

/** The validator does not know KHR_gaussian_splatting yet: that its attributes have colons in their names is expected, no other error or warning is. */
const isOfSplats = ({code, pointer, message}) => code === 'MESH_PRIMITIVE_INVALID_ATTRIBUTE' && `${pointer} ${message}`.includes('KHR_gaussian_splatting:');

/** No error and no warning but those; returns how many of those there are. */
export async function glbIsClean(...files) {
  let known = 0;
  for (const file of files) {
    const found = (await messages(file)).filter(({severity}) => severity <= WARNING);
    const others = found.filter((issue) => !isOfSplats(issue));
    if (others.length) throw new Error(`${file}: ${others.length} messages: ${tell(others)}`);
    known += found.length;
  }
  return `${files.length > 1 ? `${files.length} files, ` : ''}${known} messages, all about names of splat attributes`;
}

/** The contents of a tileset; of many, evenly chosen ones. */
export async function tilesAreClean(folder, most = 24) {
  const files = (await readdir(folder)).filter((file) => file.endsWith('.glb')).sort();
  const step = Math.max(1, files.length / most);
  const chosen = Array.from({length: Math.min(most, files.length)}, (_, i) => files[Math.floor(i * step)]);
  return glbIsClean(...chosen.map((file) => join(folder, file)));
}

export async function jsonIsValid(file, schemaFile) {
  for (const needed of [schemaFile, file]) if (!existsSync(needed)) throw new Skip(`there is no ${needed}`);
  const schema = JSON.parse(await readFile(schemaFile, 'utf8'));
  const ajv = new (schema.$schema?.includes('2020-12') ? (Ajv2020.default ?? Ajv2020) : Ajv)({allErrors: true, strict: false, validateFormats: false});
  const validate = ajv.compile(schema);
  if (!validate(JSON.parse(await readFile(file, 'utf8')))) throw new Error(ajv.errorsText(validate.errors, {separator: '; '}).slice(0, 500));
}
