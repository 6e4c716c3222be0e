// SPDX-License-Identifier: Apache-2.0
// A bare globe and a tileset, seen from a place (?eye=longitude,latitude,height&pitch=degrees). Bundled by checks/tiles.mjs.
import {Cartesian2, Cartesian3, Cesium3DTileset, CesiumWidget, Color, EllipsoidTerrainProvider, Math as CesiumMath, SceneTransforms} from '@cesium/engine';

const frames = (count) => new Promise((done) => { const next = () => (count-- ? requestAnimationFrame(next) : done()); next(); });
const words = new URLSearchParams(location.search);

try {
  const widget = new CesiumWidget('globe', {
    baseLayer: false, skyBox: false, skyAtmosphere: false, terrainProvider: new EllipsoidTerrainProvider(), creditContainer: 'credits',
    useBrowserRecommendedResolution: true, contextOptions: {webgl: {preserveDrawingBuffer: true}},
  });
  const {scene} = widget;
  scene.globe.baseColor = new Color(0.1, 0.22, 0.35);
  scene.globe.showGroundAtmosphere = false;
  for (const body of [scene.sun, scene.moon]) if (body) body.show = false;
  scene.fog.enabled = false;
  scene.highDynamicRange = false;
  const [longitude, latitude, height] = words.get('eye').split(',').map(Number);
  scene.camera.setView({
    destination: Cartesian3.fromDegrees(longitude, latitude, height),
    orientation: {heading: 0, pitch: CesiumMath.toRadians(Number(words.get('pitch') ?? -90)), roll: 0},
  });
  const tileset = await Cesium3DTileset.fromUrl(words.get('tileset'));
  tileset.tileFailed.addEventListener(({url, message}) => { window.state.error = `${url}: ${message}`; });
  scene.primitives.add(tileset);
  await new Promise((done) => tileset.initialTilesLoaded.addEventListener(done));
  window.removeClouds = async () => { tileset.show = false; await frames(8); };
  /** Where places (longitude, latitude, height) are on the screen. */
  window.project = (places) => places.map((place) => {
    const {x, y} = SceneTransforms.worldToWindowCoordinates(scene, Cartesian3.fromDegrees(...place), new Cartesian2());
    return [x, y];
  });
  await frames(60);
  window.state.ready = true;
} catch (error) {
  window.state.error = String(error?.stack ?? error);
}
