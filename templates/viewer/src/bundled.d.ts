// SPDX-License-Identifier: Apache-2.0
// What bundle.mjs makes of addresses that are not files.

/** The script of a worker, bundled, as text. */
declare module 'worker:*' {
  const source: string;
  export default source;
}

/** Coastlines: see coast.mjs. Bytes in base64. */
declare module 'coast:*' {
  const base64: string;
  export default base64;
}
