// SPDX-License-Identifier: Apache-2.0
import {connectCard} from './card';
import {Frame} from './frame';
import {connectLayers} from './layers';
import {PackView} from './pack/pack_view';
import {SkyClient} from './pack/sky_client';
import {fillPanels, showStatus} from './panel';
import {Readout} from './readout';
import {readPack, readScene} from './scene_data';
import {connectSky} from './sky_controls';
import {connectControls} from './toolbar';
import {Viewer} from './viewer';

async function main(): Promise<void> {
  const data = readScene();
  fillPanels(data);
  const megabytes = (data.pack.bytes / 1e6).toFixed(1);
  showStatus(`Reading ${megabytes} MB of clouds…`);
  // Lets the browser paint the panels before the long work starts.
  await new Promise((resolve) => setTimeout(resolve, 20));
  const bytes = await readPack(data, (share) => showStatus(`Reading ${megabytes} MB of clouds… ${Math.round(100 * share)} %`));
  const [pack, sky] = [PackView.open(bytes), await SkyClient.open(bytes)];
  const viewer = await Viewer.create(data, new Frame(data), pack, sky);
  const readout = new Readout(viewer);
  viewer.onFrame = () => readout.update(true);
  viewer.onRest = () => readout.update(false);
  connectControls(viewer);
  connectSky(viewer, data);
  connectLayers(viewer);
  connectCard(viewer, data);
  viewer.requestFrame();
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
