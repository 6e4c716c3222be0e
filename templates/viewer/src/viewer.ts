// SPDX-License-Identifier: Apache-2.0
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {LinearSRGBColorSpace, PerspectiveCamera, Scene, Vector3, WebGPURenderer} from 'three/webgpu';
import {cloudExtent, type CloudExtent} from './cloud_extent';
import {Fly} from './fly';
import type {Frame} from './frame';
import {Ground} from './ground';
import {Readout} from './readout';
import type {SceneData} from './scene_data';
import {groundSunlight} from './shadow';
import {Sky} from './sky';
import {Splats} from './splats';
import {viewNamed, type ViewName} from './views';

export type Mode = 'orbit' | 'fly';

const SLOW_FRAME_MILLISECONDS = 55;
const LOWEST_EYE_METERS = 20;
/** After this long without a change the picture is drawn once more at full resolution. */
const REST_MILLISECONDS = 250;

/** The scene, its camera, and a loop that draws only when something changed. */
export class Viewer {
  view: ViewName = 'overview';
  mode: Mode = 'orbit';
  exaggeration = 1;
  /** Frames drawn since the start: constant while nothing changes. */
  frames = 0;
  onChange: () => void = () => {};

  private readonly camera = new PerspectiveCamera(45, 1, 5, 1e8);
  private readonly orbit: OrbitControls;
  private readonly fly: Fly;
  private readonly readout: Readout;
  private readonly clouds: CloudExtent;
  private readonly ground: Ground;
  private requested = false;
  private lastFrame = 0;
  private quality = 1;
  private rest = 0;

  static async create(data: SceneData, frame: Frame, bytes: ArrayBuffer): Promise<Viewer> {
    const renderer = await startRenderer();
    const sky = new Sky(data);
    const splats = await Splats.load(bytes, sky, data.terrain !== undefined);
    return new Viewer(data, frame, renderer, sky, splats);
  }

  private constructor(
    private readonly data: SceneData,
    private readonly frame: Frame,
    private readonly renderer: WebGPURenderer,
    private readonly sky: Sky,
    private readonly splats: Splats,
    private readonly scene = new Scene(),
  ) {
    const surface = renderer.domElement;
    const sun = new Vector3(...data.sun.direction).normalize();
    const sunlight = groundSunlight(splats, frame, data.frame.lower, sun, data.groundHeightMeters);
    const ground = new Ground(data, frame, sky, sunlight);
    this.ground = ground;
    scene.backgroundNode = sky.dome;
    scene.add(ground.root, splats.root);

    this.clouds = cloudExtent(splats, frame);
    this.orbit = new OrbitControls(this.camera, surface);
    this.orbit.enableDamping = true;
    this.orbit.dampingFactor = 0.12;
    this.orbit.minDistance = 300;
    this.orbit.maxDistance = frame.size * 6 + 100_000;
    this.orbit.maxPolarAngle = Math.PI / 2 - 0.004;
    this.orbit.addEventListener('change', () => this.requestFrame());
    this.fly = new Fly(surface, this.camera, () => this.requestFrame());
    this.readout = new Readout(frame, this.camera, surface, data.groundHeightMeters, ground.labels);
    new ResizeObserver(() => this.resize()).observe(surface.parentElement!);
    this.resize();
    this.setView('overview');
  }

  get cameraPosition(): [number, number, number] {
    return this.camera.position.toArray();
  }

  get splatCount(): number {
    return this.splats.count;
  }

  get backend(): 'webgpu' | 'webgl' {
    return 'isWebGPUBackend' in this.renderer.backend ? 'webgpu' : 'webgl';
  }

  setView(name: ViewName): void {
    this.view = name;
    const narrow = Math.min(1, this.camera.aspect) * Math.tan((this.camera.fov * Math.PI) / 360);
    const {position, target} = viewNamed(name, this.data, this.frame, this.clouds, 2 * Math.atan(narrow));
    const ground = this.data.groundHeightMeters;
    for (const place of [position, target]) place.y = ground + (place.y - ground) * (name === 'top' ? 1 : this.exaggeration);
    position.y = Math.max(position.y, this.groundUnder(position) + LOWEST_EYE_METERS);
    this.camera.position.copy(position);
    this.orbit.target.copy(target);
    this.camera.lookAt(target);
    // On the ground one looks up, which an orbit about a point on the ground cannot.
    if (name === 'ground') this.setMode('fly');
    else this.setMode('orbit');
    this.splats.sortAgain();
    this.requestFrame();
    this.onChange();
  }

  setMode(mode: Mode): void {
    if (mode === 'orbit' && this.mode === 'fly' && this.camera.position.distanceTo(this.orbit.target) > 1) this.aimOrbit();
    this.mode = mode;
    this.orbit.enabled = mode === 'orbit';
    this.fly.pointerLooks = mode === 'fly';
    this.requestFrame();
    this.onChange();
  }

  /** Heights are drawn this many times as large. */
  setExaggeration(factor: number): void {
    this.exaggeration = Math.min(10, Math.max(1, factor));
    this.sky.exaggeration.value = this.exaggeration;
    this.splats.exaggerate(this.exaggeration);
    if (this.ground.terrain.exists) {
      this.ground.root.scale.y = this.exaggeration;
      this.ground.root.position.y = this.exaggeration * this.data.groundHeightMeters;
    }
    this.splats.sortAgain();
    this.requestFrame();
    this.onChange();
  }

  showClouds(shown: boolean): void {
    this.splats.root.visible = shown;
    this.requestFrame();
  }

  turnNorth(): void {
    const target = this.mode === 'orbit' ? this.orbit.target : this.camera.position.clone().add(this.camera.getWorldDirection(new Vector3()).multiplyScalar(1000));
    const arm = this.camera.position.clone().sub(target);
    const north = this.frame.northAt(target.x, target.z);
    const reach = Math.hypot(arm.x, arm.z);
    if (this.mode === 'orbit') this.camera.position.set(target.x - reach * Math.sin(north), this.camera.position.y, target.z + reach * Math.cos(north));
    else target.set(this.camera.position.x + reach * Math.sin(north), target.y, this.camera.position.z - reach * Math.cos(north));
    this.camera.lookAt(target);
    this.requestFrame();
  }

  requestFrame(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((time) => this.draw(time));
  }

  /** Resolves when a frame with the clouds is on the screen. */
  async firstFrame(): Promise<void> {
    while (this.frames < 1) await new Promise((resolve) => requestAnimationFrame(resolve));
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }

  /** Points the orbit at what is in the middle of the view: the ground, else a place ahead. */
  private aimOrbit(): void {
    const forward = this.camera.getWorldDirection(new Vector3());
    const down = forward.y < -0.02 ? (this.data.groundHeightMeters - this.camera.position.y) / forward.y : 20_000;
    this.orbit.target.copy(this.camera.position).addScaledVector(forward, Math.min(Math.max(down, 1000), this.frame.size));
    this.orbit.target.y = Math.max(this.orbit.target.y, this.data.groundHeightMeters);
    this.camera.position.y = Math.max(this.camera.position.y, this.orbit.target.y + 50);
  }

  private draw(time: number): void {
    this.requested = false;
    const seconds = Math.min(0.25, (time - this.lastFrame) / 1000);
    const moving = seconds < 0.25;
    this.lastFrame = time;
    const lowest = this.groundUnder(this.camera.position) + LOWEST_EYE_METERS;
    if (this.fly.active) {
      this.fly.step(moving ? seconds : 1 / 60, lowest, this.mode === 'orbit' ? this.orbit.target : null);
      this.requestFrame();
    }
    if (this.mode === 'orbit') this.orbit.update();
    if (this.ground.terrain.exists) {
      this.camera.position.y = Math.max(this.camera.position.y, lowest);
      // Far mountains hide each other only as finely as the nearest thing is far.
      this.camera.near = Math.min(2000, Math.max(5, 0.25 * (this.camera.position.y - lowest)));
      this.camera.updateProjectionMatrix();
    }
    if (moving && seconds * 1000 > SLOW_FRAME_MILLISECONDS) this.setQuality(this.quality * 0.8);
    this.camera.updateMatrixWorld();
    this.splats.orderFrom(this.camera);
    this.renderer.render(this.scene, this.camera);
    this.readout.update(this.orbit.target, this.exaggeration);
    ++this.frames;
    window.clearTimeout(this.rest);
    if (this.quality < 1) this.rest = window.setTimeout(() => this.atRest(), REST_MILLISECONDS);
  }

  /** Height of the drawn ground under a place. */
  private groundUnder(place: Vector3): number {
    const lowest = this.data.groundHeightMeters;
    return this.ground.terrain.exists ? this.exaggeration * (lowest + this.ground.terrain.rise(place.x, place.z)) : lowest;
  }

  private atRest(): void {
    this.lastFrame = 0;
    this.setQuality(1);
    this.splats.sortAgain();
    this.requestFrame();
  }

  private setQuality(quality: number): void {
    this.quality = Math.max(0.35, quality);
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio) * this.quality);
  }

  private resize(): void {
    const {clientWidth, clientHeight} = this.renderer.domElement.parentElement!;
    if (!clientWidth || !clientHeight) return;
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(clientWidth, clientHeight);
    this.requestFrame();
  }
}

/** WebGPU where there is a real adapter for it, else WebGL 2. The address parts #webgl and #webgpu ask for one of them. */
async function startRenderer(): Promise<WebGPURenderer> {
  const gpu = (navigator as {gpu?: {requestAdapter(): Promise<{info?: {isFallbackAdapter?: boolean}} | null>}}).gpu;
  const adapter = location.hash === '#webgl' ? null : await gpu?.requestAdapter().catch(() => null);
  const forceWebGL = !adapter || (adapter.info?.isFallbackAdapter === true && location.hash !== '#webgpu');
  if (forceWebGL && !document.createElement('canvas').getContext('webgl2'))
    throw new Error('This browser offers neither WebGPU nor WebGL 2, one of which is needed to draw the clouds.');
  const renderer = new WebGPURenderer({antialias: false, forceWebGL});
  renderer.outputColorSpace = LinearSRGBColorSpace;
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
  await renderer.init();
  if (!forceWebGL) {
    // A driver that gives up on WebGPU, or refuses a shader of it, still draws by WebGL.
    const useWebGL = () => {
      location.hash = '#webgl';
      location.reload();
    };
    renderer.onDeviceLost = useWebGL;
    renderer.onError = useWebGL;
  }
  const surface = renderer.domElement;
  surface.tabIndex = 0;
  surface.setAttribute('role', 'application');
  surface.setAttribute('aria-label', 'Three-dimensional view of the clouds. Move with W A S D, turn with the arrow keys, H for help.');
  document.getElementById('stage')!.prepend(surface);
  return renderer;
}
