// SPDX-License-Identifier: Apache-2.0
// Khronos's glTF validator, and JSON files against the schemas of this project.
import {existsSync} from 'node:fs';
import {readFile} from 'node:fs/promises';
import {Ajv} from 'ajv';
import Ajv2020 from 'ajv/dist/2020.js';
import validator from 'gltf-validator';
import {Skip} from '../lib/runner.mjs';

const ERROR = 0;
const WARNING = 1;

async function messages(file) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {maxIssues: 0});
  return report.issues.messages;
}

function tell(issues) {
  return issues.slice(0, 3).map(({code, pointer, message}) => `${code} at ${pointer}: ${message}`).join('; ');
}

export async function glbHasNoErrors(file) {
  const found = await messages(file);
  const errors = found.filter(({severity}) => severity === ERROR);
  if (errors.length) throw new Error(`${errors.length} errors: ${tell(errors)}`);
  return `${found.filter(({severity}) => severity === WARNING).length} warnings`;
}

/** The validator does not know KHR_gaussian_splatting yet; what it says about that extension is expected, nothing else is. */
export async function splatsHaveOnlyKnownErrors(file) {
  const found = await messages(file);
  const known = ({code, pointer, message}) =>
    code === 'UNSUPPORTED_EXTENSION' || (code === 'MESH_PRIMITIVE_INVALID_ATTRIBUTE' && `${pointer} ${message}`.includes('KHR_gaussian_splatting:'));
  const others = found.filter((issue) => issue.severity <= WARNING && !known(issue));
  if (others.length) throw new Error(`${others.length} other messages: ${tell(others)}`);
  return `${found.length} messages, all about the extension`;
}

export async function jsonIsValid(file, schemaFile) {
  for (const needed of [schemaFile, file]) if (!existsSync(needed)) throw new Skip(`there is no ${needed}`);
  const schema = JSON.parse(await readFile(schemaFile, 'utf8'));
  const ajv = new (schema.$schema?.includes('2020-12') ? (Ajv2020.default ?? Ajv2020) : Ajv)({allErrors: true, strict: false, validateFormats: false});
  const validate = ajv.compile(schema);
  if (!validate(JSON.parse(await readFile(file, 'utf8')))) throw new Error(ajv.errorsText(validate.errors, {separator: '; '}).slice(0, 500));
}
