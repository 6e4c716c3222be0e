// SPDX-License-Identifier: Apache-2.0
import {ColorManagement} from 'three/webgpu';
import {Frame} from './frame';
import {fillPanels, showStatus} from './panel';
import {readScene, readSplats} from './scene_data';
import {connectControls} from './toolbar';
import {Viewer} from './viewer';

// Splats carry display values and blend in them, so no colour is converted on its way to the screen.
ColorManagement.enabled = false;

async function main(): Promise<void> {
  const data = readScene();
  fillPanels(data);
  showStatus(`Reading ${(data.splats.bytes / 1e6).toFixed(1)} MB of clouds…`);
  // Lets the browser paint the panels before the long work starts.
  await new Promise((resolve) => setTimeout(resolve, 20));
  const viewer = await Viewer.create(data, new Frame(data), await readSplats(data));
  connectControls(viewer);
  await viewer.firstFrame();
  showStatus('');
  window.cloudgen = viewer;
  window.cloudgenReady = true;
}

declare global {
  interface Window {
    cloudgen?: Viewer;
    cloudgenReady?: boolean;
    cloudgenError?: string;
  }
}

main().catch((error: unknown) => {
  window.cloudgenError = error instanceof Error ? error.message : String(error);
  showStatus(window.cloudgenError, true);
});
