// SPDX-License-Identifier: Apache-2.0
// Serves folders and texts on this machine only: /lib/ is node_modules, /pages/ the test pages, /scene/ one output folder, /cesium/
// what CesiumJS asks for beside its script.
import {createServer} from 'node:http';
import {readFile} from 'node:fs/promises';
import {extname, join, normalize} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = fileURLToPath(new URL('..', import.meta.url));
const types = {
  '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.json': 'application/json',
  '.png': 'image/png', '.x3d': 'model/x3d+xml', '.wrl': 'model/vrml', '.glb': 'model/gltf-binary', '.wasm': 'application/wasm',
};

/** Starts a server for one output folder; `texts` maps further addresses to their content. */
export function serve(sceneFolder, texts = {}) {
  const roots = {'/lib/': join(here, 'node_modules'), '/pages/': join(here, 'pages'), '/scene/': sceneFolder,
    '/cesium/Workers/': join(here, 'node_modules/@cesium/engine/Build/Workers'), '/cesium/': join(here, 'node_modules/@cesium/engine/Source')};
  const server = createServer(async (request, answer) => {
    const path = normalize(decodeURIComponent(request.url.split('?')[0]));
    try {
      const root = Object.keys(roots).find((prefix) => path.startsWith(prefix));
      const bytes = path in texts ? Buffer.from(texts[path]) : root ? await readFile(join(roots[root], path.slice(root.length))) : null;
      if (!bytes) throw new Error('not here');
      answer.writeHead(200, {'Content-Type': types[extname(path)] ?? 'application/octet-stream', 'Content-Length': bytes.length});
      answer.end(bytes);
    } catch {
      answer.writeHead(404);
      answer.end();
    }
  });
  return new Promise((resolve) =>
    server.listen(0, '127.0.0.1', () =>
      resolve({address: `http://127.0.0.1:${server.address().port}`, close: () => (server.closeAllConnections(), server.close())}),
    ),
  );
}
