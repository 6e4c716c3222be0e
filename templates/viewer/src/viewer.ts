// SPDX-License-Identifier: Apache-2.0
import {focalPixels, looking, rayThrough, type Camera} from './camera';
import {cloudExtent, type CloudExtent} from './cloud_extent';
import {coastAbout, worldRings} from './coast';
import {Controls, type HeldKeys} from './controls';
import type {Frame} from './frame';
import {Backdrop} from './gl/backdrop';
import {Mesh, type GL} from './gl/gl';
import {PACE_OF_GPU, PACE_OF_SOFTWARE, PACES, Renderer, type Pace} from './gl/renderer';
import {spriteTexture} from './gl/sprites';
import {groundLines, type GroundLines} from './ground_lines';
import {along, clamp, distance, dot, UP, type Vec3} from './math';
import {daylightUnder, directionTo, type SunPlace} from './pack/daylight';
import type {Area} from './pack/ground_shadow';
import type {PackView} from './pack/pack_view';
import type {Shape} from './pack/quads';
import type {Layers, ListOrder, SkyMaker} from './pack/sky_maker';
import type {SkyClient} from './pack/sky_client';
import type {Moment} from './pack/timeline';
import {pathAbout, type FlightPath} from './path';
import {forwardOf, orbited, panned, poseTowards, sideOf, targetOf, turned, zoomed, type Pose} from './pose';
import {Quality} from './quality';
import type {SceneData} from './scene_data';
import {seldom} from './seldom';
import {Terrain} from './terrain';
import {viewNamed, type ViewName} from './views';

export const MODES = ['orbit', 'fly', 'walk', 'follow'] as const;
export type Mode = (typeof MODES)[number];

const FIELD_RADIANS = Math.PI / 4;
const LOWEST_EYE_METERS = 20;
const WALKER_EYE_METERS = 2;
const WALK_METERS_PER_SECOND = 60;
const FOLLOW_METERS_PER_SECOND = 240;
const TURN_RADIANS_PER_SECOND = 0.7;
/** After this long without a change the clouds are drawn at full resolution. */
const REST_MILLISECONDS = 220;
/** The shadows on the ground follow the sun after this long. */
const SHADE_MILLISECONDS = 120;
/** And then again, while it goes on. */
const RESHADE_MILLISECONDS = 1500;
/** The sky follows the sun after this long. */
const SUN_MILLISECONDS = 100;
/** What a list of quads may lose while the view moves, in pixels of the coarse picture; and at rest, in those of the screen. */
const QUICK_ERROR_PIXELS = 1.5;
const FINE_ERROR_PIXELS = 2;
const MOST_FINE_PUFFS = 1_500_000;
const MOST_SOFTWARE_FILL = 6e7;
/** Processors have other things to do, too: where they draw, the aim is nearly the screen's rate. */
const SLOW_SOFTWARE_SECONDS = 0.022;

type Fine = 'none' | 'asked' | 'drawing' | 'shown';

/** The scene, its camera, and a loop that draws only when something changed. */
export class Viewer {
  view: ViewName = 'overview';
  mode: Mode = 'orbit';
  exaggeration = 1;
  /** How fast the flight path is flown; 0 stands still. */
  followSpeed = 1;
  followMeters = 0;
  /** Frames drawn since the start: constant while nothing changes. */
  frames = 0;
  onChange: () => void = () => {};
  /** A frame of a view that moves was drawn; the picture is complete. */
  onFrame: () => void = () => {};
  onRest: () => void = () => {};
  onPick: (cloud: number | null) => void = () => {};
  readonly extent: CloudExtent;
  readonly lines: GroundLines;
  path: FlightPath;
  sun: SunPlace;
  private readonly showSun = seldom((sun: SunPlace) => {
    this.backdrop.setDaylight(daylightUnder(this.pack.root, sun.elevationDegrees), directionTo(sun));
    this.onChange();
    this.touch();
  }, SUN_MILLISECONDS);
  /** What time of a sky that moves is shown, seconds from the pack's valid time. */
  seconds = 0;

  private pose: Pose = {eye: [0, 1000, 0], heading: 0, pitch: 0, reach: 1000};
  private readonly controls: Controls;
  private readonly terrain: Terrain;
  private readonly quality: Quality;
  /** Pixels that puffs of the picture at rest may cover together before it is made coarser. */
  private readonly mostFill: number;
  private changed = true;
  private requested = false;
  private fine: Fine = 'none';
  private lastFrame = 0;
  private lastChange = 0;
  private rest = 0;
  private listed: {camera: Camera; margin: number} | null = null;
  private listing = false;
  private listAgain = false;
  private nearestMeters = 1000;
  /** The time that the list was made for. */
  private moment: Moment = {seconds: 0, from: 0, to: 0};
  private cloudsShown = true;
  private turnFrom = 0;
  private readonly wanted = new Map<string, unknown>();
  private changing: Promise<void> | null = null;
  private shading = 0;
  private shaded = -Infinity;
  /** Pixels of the screen under the canvas. */
  private screen = {widthPixels: 1280, heightPixels: 720};

  static async create(data: SceneData, frame: Frame, pack: PackView, sky: SkyClient): Promise<Viewer> {
    const canvas = document.createElement('canvas');
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', 'Three-dimensional view of the clouds. Move with W A S D, turn with the arrow keys, H for help.');
    const gl = canvas.getContext('webgl2', {antialias: false, alpha: false, depth: data.terrain !== undefined, stencil: false, powerPreference: 'high-performance'});
    if (!gl) throw new Error('This browser does not offer WebGL 2, which is needed to draw the clouds.');
    canvas.addEventListener('webglcontextlost', () => location.reload());
    const terrain = new Terrain(data);
    const area: Area = {
      lower: data.frame.lower,
      width: frame.width,
      depth: frame.depth,
      groundMeters: data.groundHeightMeters,
    };
    const backdrop = new Backdrop(gl, area, terrain.mesh(gl));
    const renderer = new Renderer(gl, await spriteTexture(gl, pack), backdrop, terrain.exists);
    document.getElementById('stage')!.prepend(canvas);
    const viewer = new Viewer(data, frame, pack, sky, canvas, gl, backdrop, renderer, terrain, area);
    await viewer.setSun(viewer.sun);
    void viewer.addCoast();
    return viewer;
  }

  private constructor(
    private readonly data: SceneData,
    readonly frame: Frame,
    readonly pack: PackView,
    private readonly sky: SkyClient,
    readonly canvas: HTMLCanvasElement,
    private readonly gl: GL,
    private readonly backdrop: Backdrop,
    private readonly renderer: Renderer,
    terrain: Terrain,
    private readonly area: Area,
  ) {
    this.terrain = terrain;
    const {azimuthDegrees, elevationDegrees} = data.sun;
    this.sun = {azimuthDegrees, elevationDegrees};
    this.extent = cloudExtent(pack, frame);
    this.path = pathAbout(this.extent, data.groundHeightMeters);
    this.lines = groundLines(frame);
    this.addLines(this.lines.minor, 0.13, [0.97, 0.98, 1]);
    this.addLines(this.lines.major, 0.42, [0.97, 0.98, 1]);
    this.addLines(this.lines.border, 0.85, [0.97, 0.98, 1]);
    const software = isSoftware(gl);
    this.mostFill = software ? MOST_SOFTWARE_FILL : Infinity;
    this.quality = new Quality(PACES.length, software ? PACE_OF_SOFTWARE : PACE_OF_GPU, software ? SLOW_SOFTWARE_SECONDS : undefined);
    renderer.pace = PACES[this.quality.step];
    this.controls = new Controls(canvas, {
      drag: (right, down) => this.drag(right, down),
      pan: (right, down) => this.pan(right, down),
      zoom: (factor) => this.zoom(factor),
      click: (x, y) => void this.pickAt(x, y),
      wake: () => this.requestFrame(),
    });
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
    this.setView('overview');
  }

  get cameraPosition(): Vec3 {
    return [...this.pose.eye];
  }

  get target(): Vec3 {
    return targetOf(this.pose);
  }

  get camera(): Camera {
    return looking(this.pose.eye, forwardOf(this.pose), FIELD_RADIANS, this.screen.widthPixels, this.screen.heightPixels);
  }

  get groundMeters(): number {
    return this.data.groundHeightMeters;
  }

  /** How the view is drawn while it moves, and how many puffs that are. */
  get drawing(): Pace & {puffs: number} {
    return {puffs: this.renderer.quick.count, ...this.renderer.pace};
  }

  setView(name: ViewName): void {
    this.view = name;
    const narrow = Math.min(1, this.screen.widthPixels / this.screen.heightPixels) * Math.tan(FIELD_RADIANS / 2);
    const ground = this.data.groundHeightMeters;
    const {position, target} = viewNamed(name, ground, directionTo(this.data.sun), this.frame, this.extent, 2 * Math.atan(narrow));
    const stretch = name === 'top' ? 1 : this.exaggeration;
    for (const place of [position, target]) place[1] = ground + (place[1] - ground) * stretch;
    position[1] = Math.max(position[1], this.groundUnder(position) + LOWEST_EYE_METERS);
    // On the ground one looks up, which an orbit about a point on the ground cannot.
    this.mode = name === 'ground' ? 'fly' : 'orbit';
    this.place(position, target);
    this.onChange();
  }

  /** Puts the camera in a place, in drawn metres. */
  place(eye: Vec3, target: Vec3): void {
    this.pose = poseTowards(eye, target);
    this.touch();
  }

  setMode(mode: Mode): void {
    if (mode === 'orbit' && this.mode !== 'orbit') this.aimOrbit();
    if (mode === 'walk') {
      const [x, , z] = this.pose.eye;
      this.pose.eye = [x, this.groundUnder([x, 0, z]) + WALKER_EYE_METERS, z];
      this.pose.pitch = Math.max(this.pose.pitch, 0.12);
    }
    if (mode === 'follow') this.turnFrom = 0;
    this.mode = mode;
    this.touch();
    this.onChange();
  }

  /** Heights are drawn this many times as large. */
  setExaggeration(factor: number): void {
    this.exaggeration = clamp(factor, 1, 10);
    void this.sky.call('setExaggeration', this.exaggeration);
    this.skyChanged();
    this.onChange();
  }

  /** Resolves when the clouds are lit by the sun that was set last. */
  async setSun(sun: SunPlace): Promise<void> {
    this.sun = sun;
    this.showSun(sun);
    await this.changeSky('setSun', sun);
  }

  setTime(seconds: number): Promise<void> {
    this.seconds = seconds;
    this.touch();
    return this.changeSky('setTime', seconds);
  }

  setLayers(layers: Layers): Promise<void> {
    return this.changeSky('setLayers', layers);
  }

  /** A slider asks for more skies than can be made: only the last that is asked for meanwhile is made next. */
  private async changeSky<Name extends 'setSun' | 'setTime' | 'setLayers'>(method: Name, value: Parameters<SkyMaker[Name]>[0]): Promise<void> {
    this.wanted.set(method, value);
    while (this.changing) await this.changing;
    if (!this.wanted.has(method)) return;
    this.changing = this.makeWanted();
    await this.changing.finally(() => (this.changing = null));
    this.shading ||= window.setTimeout(() => void this.shadeGround(), Math.max(SHADE_MILLISECONDS, this.shaded + RESHADE_MILLISECONDS - performance.now()));
  }

  private async makeWanted(): Promise<void> {
    const calls = [...this.wanted].map(([method, value]) => (this.sky.call as (name: string, value: unknown) => Promise<void>)(method, value));
    this.wanted.clear();
    const start = performance.now();
    await Promise.all(calls);
    this.skyChanged();
    await this.askList();
    // While the sky goes on and on, the worker leaves most of the time to the drawing.
    if (this.wanted.size > 0) await new Promise((later) => window.setTimeout(later, Math.min(500, 3 * (performance.now() - start))));
  }

  showClouds(shown: boolean): void {
    this.cloudsShown = shown;
    this.skyChanged();
  }

  turnNorth(): void {
    const target = targetOf(this.pose);
    const [x, , z] = this.mode === 'orbit' ? target : this.pose.eye;
    const turn = this.frame.northAt(x, z) - this.pose.heading;
    this.pose = this.mode === 'orbit' ? orbited(this.pose, turn, 0, this.lowestEye()) : turned(this.pose, turn, 0);
    this.touch();
  }

  /** The cloud at a place of the page, or in the middle of the view; null if there is none. */
  async pickAt(x?: number, y?: number): Promise<number | null> {
    const box = this.canvas.getBoundingClientRect();
    const [u, v] = x === undefined || y === undefined ? [0.5, 0.5] : [(x - box.left) / box.width, (y - box.top) / box.height];
    const picked = await this.sky.call('pick', this.pose.eye, rayThrough(this.camera, u, v));
    this.onPick(picked?.cloud ?? null);
    return picked?.cloud ?? null;
  }

  /** What is on the screen, as PNG. */
  screenshot(): Promise<Blob> {
    // All of the screen's pixels, though fewer are drawn while the view moves.
    this.fitCanvas(1);
    this.renderer.compose(this.camera, this.near(), this.exaggeration);
    return new Promise((resolve, reject) => this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture'))), 'image/png'));
  }

  requestFrame(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((time) => this.step(time));
  }

  /** Resolves when a frame with the clouds is on the screen. */
  async firstFrame(): Promise<void> {
    while (this.frames < 1) await new Promise((resolve) => requestAnimationFrame(resolve));
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }

  /** Nothing moves and the picture is complete. */
  get isAtRest(): boolean {
    return this.fine === 'shown' && !this.changed;
  }

  /** One frame as while the view moves, without waiting for the screen. */
  drawNow(): void {
    this.fitCanvas(this.renderer.pace.canvas);
    this.renderer.quick.aheadSeconds = clamp(this.seconds, this.moment.from, this.moment.to) - this.moment.seconds;
    this.renderer.drawQuick(this.camera, this.near(), this.exaggeration);
    ++this.frames;
    if (this.needsList()) void this.askList();
  }

  private step(time: number): void {
    this.requested = false;
    const between = (time - this.lastFrame) / 1000;
    const seconds = Math.min(0.25, between);
    const wasMoving = time - this.lastChange < 100 && between < 0.5;
    this.lastFrame = time;
    this.moveByKeys(wasMoving ? seconds : 1 / 60);
    if (this.mode === 'follow') this.follow(wasMoving ? seconds : 1 / 60);
    if (this.changed) {
      if (wasMoving && this.quality.frame(between)) this.setPace(this.quality.step);
      this.changed = false;
      this.lastChange = time;
      this.fine = 'none';
      this.drawNow();
      this.onFrame();
      if (this.controls.held() || (this.mode === 'follow' && this.followSpeed > 0)) this.requestFrame();
      window.clearTimeout(this.rest);
      this.rest = window.setTimeout(() => void this.refine(), REST_MILLISECONDS);
      return;
    }
    if (this.fine !== 'drawing') return;
    ++this.frames;
    if (!this.renderer.advanceFine(this.camera, this.near())) return this.requestFrame();
    this.fitCanvas(1);
    this.renderer.showFine(this.camera, this.near(), this.exaggeration);
    this.fine = 'shown';
    this.onRest();
  }

  /** Draws the clouds once more in all detail. */
  private async refine(): Promise<void> {
    if (this.changed || this.fine !== 'none') return;
    if (this.listing) {
      this.rest = window.setTimeout(() => void this.refine(), REST_MILLISECONDS);
      return;
    }
    this.fine = 'asked';
    const {camera} = this;
    const list = await this.sky.call('list', this.orderFor(camera, 'quads', 0, 0, FINE_ERROR_PIXELS, MOST_FINE_PUFFS));
    if (this.fine !== 'asked' || this.changed) return;
    const fine = this.cloudsShown ? list : {buffer: new ArrayBuffer(0), fillPixels: 0};
    const divisor = clamp(Math.sqrt(fine.fillPixels / this.mostFill), 1, 2.5);
    this.renderer.startFine(fine, camera, divisor, this.near(), this.exaggeration);
    this.fine = 'drawing';
    this.requestFrame();
  }

  private orderFor(camera: Camera, shape: Shape, marginRadians: number, marginMeters: number, errorPixels: number, mostPuffs: number): ListOrder {
    return {camera, shape, marginRadians, marginMeters, detail: {errorPixels, hysteresis: 0.15, mostPuffs}};
  }

  /** A list holds until the camera has moved or turned enough. */
  private needsList(): boolean {
    if (!this.listed) return true;
    const {camera: made, margin} = this.listed;
    const now = this.camera;
    const turnedBy = Math.acos(clamp(dot(made.forward, now.forward), -1, 1));
    return distance(made.eye, now.eye) > margin / 3 || turnedBy > 0.04;
  }

  /** Asks for the list that is drawn while the view moves; one question at a time. */
  async askList(): Promise<void> {
    if (this.listing) {
      this.listAgain = true;
      return;
    }
    this.listing = true;
    const {camera} = this;
    const margin = clamp(0.04 * this.nearestMeters, 20, 5000);
    const {pace} = this.renderer;
    const coarse = {...camera, widthPixels: camera.widthPixels / pace.divisor, heightPixels: camera.heightPixels / pace.divisor};
    try {
      const list = await this.sky.call('list', this.orderFor(coarse, 'triangles', 0.12, margin, QUICK_ERROR_PIXELS, pace.mostPuffs));
      this.nearestMeters = Number.isFinite(list.nearestMeters) ? Math.max(list.nearestMeters, 200) : 20_000;
      if (this.cloudsShown) this.renderer.quick.set(list.buffer, list.motions);
      else this.renderer.quick.set(new ArrayBuffer(0));
      this.moment = list.moment;
      this.listed = {camera, margin};
    } finally {
      this.listing = false;
    }
    this.touch(false);
    if (this.listAgain) {
      this.listAgain = false;
      if (this.needsList()) void this.askList();
    }
  }

  /** Draws again, as the camera moved or the sky changed. */
  private touch(moved = true): void {
    // A new list for a picture that is already drawn finely changes nothing in it.
    if (!moved && (this.fine === 'drawing' || this.fine === 'shown')) return;
    this.changed = true;
    this.requestFrame();
  }

  private skyChanged(): void {
    this.listed = null;
    this.fine = 'none';
    if (this.listing) this.listAgain = true;
    this.touch();
  }

  private async shadeGround(): Promise<void> {
    this.shading = 0;
    this.shaded = performance.now();
    const light = await this.sky.call('sunlight', this.area);
    this.backdrop.setSunlight(light);
    this.touch();
  }

  private async addCoast(): Promise<void> {
    const coast = coastAbout(await worldRings(), this.frame);
    this.backdrop.setLand(coast.map);
    this.addLines(coast.lines, 0.75, [0.1, 0.16, 0.2]);
    this.touch();
  }

  /** Pairs of points on the ground, laid on the terrain. */
  private addLines(points: number[], opacity: number, color: Vec3): void {
    const values: number[] = [];
    for (let i = 0; i < points.length; i += 2) values.push(points[i], this.terrain.rise(points[i], points[i + 1]) + (this.terrain.exists ? 15 : 0), points[i + 1]);
    this.backdrop.lines.push({mesh: new Mesh(this.gl, values, [3], null, this.gl.LINES), opacity, color});
  }

  private drag(right: number, down: number): void {
    const perPixel = FIELD_RADIANS / this.canvas.clientHeight;
    if (this.mode === 'orbit') this.pose = orbited(this.pose, right * 4 * perPixel, -down * 4 * perPixel, this.lowestEye());
    else {
      this.pose = turned(this.pose, -right * perPixel, down * perPixel);
      this.turnFrom -= right * perPixel;
    }
    this.touch();
  }

  private pan(right: number, down: number): void {
    if (this.mode === 'follow' || this.mode === 'walk') return;
    const metersPerPixel = (this.mode === 'orbit' ? this.pose.reach : Math.max(500, this.pose.eye[1])) / focalPixels({...this.camera, heightPixels: this.canvas.clientHeight});
    this.pose = panned(this.pose, -right * metersPerPixel, down * metersPerPixel);
    this.keepAboveGround();
    this.touch();
  }

  private zoom(factor: number): void {
    if (this.mode === 'orbit') this.pose = zoomed(this.pose, factor, 300, this.frame.size * 6 + 100_000);
    else if (this.mode !== 'follow') this.pose.eye = along(this.pose.eye, -Math.log(factor) * 4 * this.speed(false), this.headingAhead());
    this.keepAboveGround();
    this.touch();
  }

  private headingAhead(): Vec3 {
    const forward = forwardOf(this.pose);
    return this.mode === 'walk' ? [Math.sin(this.pose.heading), 0, -Math.cos(this.pose.heading)] : forward;
  }

  /** Height above the ground sets the pace: slow between clouds, fast over a continent. Metres a second. */
  private speed(fast: boolean): number {
    const pace = this.mode === 'walk' ? WALK_METERS_PER_SECOND : clamp(0.5 * this.pose.eye[1], 400, 400_000);
    return pace * (fast ? 4 : 1);
  }

  private moveByKeys(seconds: number): void {
    const held = this.controls.held();
    if (!held) return;
    const turn = TURN_RADIANS_PER_SECOND * seconds;
    if (this.mode === 'orbit') {
      if (held.turnRight || held.turnUp) this.pose = orbited(this.pose, held.turnRight * turn, -held.turnUp * turn, this.lowestEye());
      if (held.inward) this.pose = zoomed(this.pose, Math.exp(-held.inward * seconds), 300, this.frame.size * 6 + 100_000);
    } else {
      this.pose = turned(this.pose, held.turnRight * turn, held.turnUp * turn);
      this.turnFrom += held.turnRight * turn;
    }
    if (this.mode !== 'follow') this.walk(held, seconds);
    this.touch();
  }

  private walk(held: HeldKeys, seconds: number): void {
    const step = this.speed(held.fast) * seconds;
    const ahead: Vec3 = this.mode === 'orbit' ? [Math.sin(this.pose.heading), 0, -Math.cos(this.pose.heading)] : this.headingAhead();
    const inward = this.mode === 'orbit' ? 0 : held.inward;
    let eye = along(this.pose.eye, (held.ahead + inward) * step, ahead);
    eye = along(eye, held.right * step, sideOf(this.pose));
    this.pose.eye = this.mode === 'walk' ? eye : along(eye, held.up * step, UP);
    this.keepAboveGround();
  }

  private follow(seconds: number): void {
    if (this.followSpeed > 0 || this.changed) {
      this.followMeters = (this.followMeters + this.followSpeed * FOLLOW_METERS_PER_SECOND * seconds) % this.path.lengthMeters;
      this.flyTo(this.followMeters);
    }
  }

  /** To a place of the flight path, looking along it but for what the pointer turned. */
  flyTo(meters: number): void {
    this.followMeters = meters;
    const stretched = ([x, y, z]: Vec3): Vec3 => [x, y * this.exaggeration, z];
    const eye = stretched(this.path.placeAt(meters));
    const ahead = stretched(this.path.placeAt(meters + Math.min(3000, 0.02 * this.path.lengthMeters)));
    const pitch = this.pose.pitch;
    this.pose = poseTowards(eye, distance(eye, ahead) > 1 ? ahead : along(eye, 1000, forwardOf(this.pose)));
    this.pose.heading += this.turnFrom;
    this.pose.pitch = pitch;
    this.keepAboveGround();
    this.touch();
    this.onChange();
  }

  private lowestEye(): number {
    return this.groundUnder(this.pose.eye) + LOWEST_EYE_METERS;
  }

  private keepAboveGround(): void {
    const [x, y, z] = this.pose.eye;
    const ground = this.groundUnder(this.pose.eye);
    if (this.mode === 'walk') this.pose.eye = [x, ground + WALKER_EYE_METERS, z];
    else if (y < ground + LOWEST_EYE_METERS) this.pose.eye = [x, ground + LOWEST_EYE_METERS, z];
  }

  /** Height of the drawn ground under a place. */
  groundUnder(place: Vec3): number {
    const lowest = this.data.groundHeightMeters;
    return this.terrain.exists ? this.exaggeration * (lowest + this.terrain.rise(place[0], place[2])) : lowest;
  }

  /** Points the orbit at what is in the middle of the view: the ground, else a place ahead. */
  private aimOrbit(): void {
    const ahead = forwardOf(this.pose);
    const down = ahead[1] < -0.02 ? (this.data.groundHeightMeters - this.pose.eye[1]) / ahead[1] : 20_000;
    this.pose.reach = clamp(down, 1000, this.frame.size + 20_000);
    this.keepAboveGround();
  }

  /** Far mountains hide each other only as finely as the nearest thing is far. */
  private near(): number {
    return this.terrain.exists ? clamp(0.25 * (this.pose.eye[1] - this.groundUnder(this.pose.eye)), 2, 2000) : 2;
  }

  /** Gives the canvas this share of the screen's pixels across. */
  private fitCanvas(share: number): void {
    const {widthPixels, heightPixels} = this.screen;
    const [width, height] = [Math.max(1, Math.round(widthPixels * share)), Math.max(1, Math.round(heightPixels * share))];
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.canvas.width = width;
    this.canvas.height = height;
  }

  setPace(step: number): void {
    this.renderer.pace = PACES[step];
    this.listed = null;
  }

  private resize(): void {
    const {clientWidth, clientHeight} = this.canvas.parentElement!;
    if (!clientWidth || !clientHeight) return;
    const ratio = Math.min(2, window.devicePixelRatio);
    this.screen = {widthPixels: Math.round(clientWidth * ratio), heightPixels: Math.round(clientHeight * ratio)};
    this.listed = null;
    this.touch();
  }
}

/** Whether the picture is made by the processor. */
function isSoftware(gl: GL): boolean {
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
