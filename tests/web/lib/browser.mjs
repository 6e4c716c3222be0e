// SPDX-License-Identifier: Apache-2.0
// One browser at a time, with a fresh profile and no way to the network.
import {mkdtemp, rm} from 'node:fs/promises';
import {existsSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {chromium} from 'playwright-core';

const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';

const args = [
  '--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle', '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--js-flags=--max-old-space-size=4000',
];

export function hasBrowser() {
  return existsSync(executablePath);
}

/**
 * Opens a page, hands it to `use`, and ends the browser whatever happens.
 * `use(page, seen)`: seen.errors are console errors and uncaught exceptions, seen.warnings console warnings, seen.requests the addresses asked for.
 */
export async function withPage({width, height}, use) {
  const profile = await mkdtemp(join(tmpdir(), 'cloudgen-web-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath, args, headless: true, ignoreDefaultArgs: ['--disable-gpu'], viewport: {width, height}, offline: false,
  });
  try {
    const page = context.pages()[0] ?? (await context.newPage());
    const seen = {errors: [], warnings: [], requests: []};
    page.on('console', (message) => message.type() === 'error' && seen.errors.push(message.text().slice(0, 300)));
    page.on('console', (message) => message.type() === 'warning' && seen.warnings.push(message.text().slice(0, 300)));
    page.on('pageerror', (error) => seen.errors.push(`uncaught: ${String(error).slice(0, 300)}`));
    page.on('request', (request) => seen.requests.push(request.url().slice(0, 200)));
    return await use(page, seen);
  } finally {
    await Promise.race([context.close(), new Promise((resolve) => setTimeout(resolve, 8000))]);
    await rm(profile, {recursive: true, force: true, maxRetries: 3});
  }
}
