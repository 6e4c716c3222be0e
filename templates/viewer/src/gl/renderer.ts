// SPDX-License-Identifier: Apache-2.0
import {clipMatrix, type Camera} from '../camera';
import type {Backdrop} from './backdrop';
import {CloudPainter, PuffList, QuadIndices} from './cloud_layer';
import {Target, type GL} from './gl';

/** How the view is drawn while it moves. */
export interface Pace {
  /** Of the canvas's pixels across, to those of the screen. */
  canvas: number;
  /** Width of a pixel of the cloud picture, in those of the screen: that of the canvas's own, and clouds are drawn straight into it. */
  divisor: number;
  mostPuffs: number;
}

/** From fine to coarse. */
export const PACES: Pace[] = [
  {canvas: 1, divisor: 1, mostPuffs: 400_000},
  {canvas: 1, divisor: 1.5, mostPuffs: 200_000},
  {canvas: 1, divisor: 2, mostPuffs: 100_000},
  {canvas: 1, divisor: 3, mostPuffs: 40_000},
  {canvas: 0.75, divisor: 4, mostPuffs: 12_000},
  {canvas: 0.5, divisor: 4, mostPuffs: 6_000},
  {canvas: 0.5, divisor: 2, mostPuffs: 4_000},
  {canvas: 0.4, divisor: 2.5, mostPuffs: 3_000},
  {canvas: 0.3125, divisor: 3.2, mostPuffs: 2_000},
  {canvas: 0.25, divisor: 4, mostPuffs: 1_500},
  {canvas: 0.25, divisor: 4, mostPuffs: 800},
  {canvas: 0.2, divisor: 5, mostPuffs: 700},
];
export const PACE_OF_SOFTWARE = 7;
export const PACE_OF_GPU = 2;

/** A picture at rest is drawn in so many parts, a frame each. */
const PARTS = 12;
/** A part should not cover more than so many pixels, each puff for itself, or the page stands still meanwhile. */
const MOST_PART_PIXELS = 8e6;

/**
 * Draws clouds into a picture of their own and lays it over sky and ground: coarse and at once while the view moves, at full
 * resolution and in parts once it rests.
 */
export class Renderer {
  pace: Pace = PACES[PACE_OF_GPU];
  readonly quick: PuffList;
  private readonly fine: PuffList;
  private readonly painter: CloudPainter;
  private readonly quickTarget: Target;
  private readonly fineTarget: Target;
  private fineDone = 0;
  private fineParts = PARTS;
  private shown: Target;
  /** Whether clouds are drawn straight over sky and ground, without a picture of their own. */
  private isStraight = false;

  constructor(
    private readonly gl: GL,
    sprites: WebGLTexture,
    private readonly backdrop: Backdrop,
    private readonly hasTerrain: boolean,
  ) {
    const indices = new QuadIndices(gl);
    this.quick = new PuffList(gl, 'triangles', indices);
    this.fine = new PuffList(gl, 'quads', indices);
    this.painter = new CloudPainter(gl, sprites);
    this.quickTarget = new Target(gl, hasTerrain);
    this.fineTarget = new Target(gl, hasTerrain);
    this.shown = this.quickTarget;
  }

  /** Clouds as they are known now, coarse. */
  drawQuick(camera: Camera, near: number, exaggeration: number): void {
    const {gl} = this;
    this.shown = this.quickTarget;
    this.backdrop.faintest = this.pace.canvas < 1 ? 0.3 : 0;
    this.backdrop.lineOpacity = Math.min(1, 2 * this.pace.canvas);
    this.isStraight = this.pace.canvas * this.pace.divisor === 1;
    if (!this.isStraight) {
      const size = (pixels: number) => Math.max(1, Math.ceil(pixels / (this.pace.divisor * this.pace.canvas)));
      this.quickTarget.resize(size(gl.drawingBufferWidth), size(gl.drawingBufferHeight));
      this.begin(this.quickTarget, camera, clipMatrix(camera, near), exaggeration);
      this.painter.draw(this.quick, 0, this.quick.count, clipMatrix(camera, near), this.hasTerrain);
    }
    this.compose(camera, near, exaggeration);
  }

  /** Takes a finer list for a picture of the camera's size over `divisor`; advanceFine then draws it. */
  startFine(list: {buffer: ArrayBuffer; fillPixels: number}, camera: Camera, divisor: number, near: number, exaggeration: number): void {
    this.fine.set(list.buffer);
    this.fineTarget.resize(Math.ceil(camera.widthPixels / divisor), Math.ceil(camera.heightPixels / divisor));
    this.begin(this.fineTarget, camera, clipMatrix(camera, near), exaggeration);
    this.fineDone = 0;
    this.fineParts = Math.max(PARTS, list.fillPixels / (divisor * divisor) / MOST_PART_PIXELS);
  }

  /** Draws a part more; true once all of it is drawn and `showFine` may come. */
  advanceFine(camera: Camera, near: number): boolean {
    const part = this.fine.count / this.fineParts;
    const count = Math.min(Math.ceil(part), this.fine.count - this.fineDone);
    this.fineTarget.bind();
    this.painter.draw(this.fine, this.fineDone, count, clipMatrix(camera, near), this.hasTerrain);
    this.fineDone += count;
    this.gl.flush();
    return this.fineDone >= this.fine.count;
  }

  showFine(camera: Camera, near: number, exaggeration: number): void {
    this.shown = this.fineTarget;
    this.isStraight = false;
    this.backdrop.faintest = 0;
    this.backdrop.lineOpacity = 1;
    this.compose(camera, near, exaggeration);
  }

  /** Sky and ground under the clouds that were drawn last. */
  compose(camera: Camera, near: number, exaggeration: number): void {
    const {gl} = this;
    const clip = clipMatrix(camera, near);
    this.backdrop.prepare();
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    this.backdrop.draw({camera, clip, near, exaggeration, clouds: this.isStraight ? null : this.shown});
    if (this.isStraight) this.painter.draw(this.quick, 0, this.quick.count, clip, this.hasTerrain);
  }

  private begin(target: Target, camera: Camera, clip: Float32Array, exaggeration: number): void {
    target.clear();
    if (this.hasTerrain) this.backdrop.drawDepth(clip, camera, exaggeration);
  }
}
