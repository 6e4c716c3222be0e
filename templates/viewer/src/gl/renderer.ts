// SPDX-License-Identifier: Apache-2.0
import {clipMatrix, type Camera} from '../camera';
import type {Backdrop} from './backdrop';
import {CloudPainter, QuadIndices, QuadList} from './cloud_layer';
import {Target, type GL} from './gl';

/** Widths of a pixel of the cloud picture while the view moves, in those of the screen. */
export const DIVISORS = [1, 1.5, 2, 3, 4, 5, 6, 8];
/** A picture at rest is drawn in so many parts, a frame each. */
const PARTS = 12;
const LEAST_PART = 1500;

/**
 * Draws clouds into a picture of their own and lays it over sky and ground: coarse and at once while the view moves, at full
 * resolution and in parts once it rests.
 */
export class Renderer {
  divisor = 4;
  readonly quick: QuadList;
  private readonly fine: QuadList;
  private readonly painter: CloudPainter;
  private readonly quickTarget: Target;
  private readonly fineTarget: Target;
  private fineDone = 0;
  private shown: Target;

  constructor(
    private readonly gl: GL,
    sprites: WebGLTexture,
    private readonly backdrop: Backdrop,
    private readonly hasTerrain: boolean,
  ) {
    const indices = new QuadIndices(gl);
    this.quick = new QuadList(gl, indices);
    this.fine = new QuadList(gl, indices);
    this.painter = new CloudPainter(gl, sprites);
    this.quickTarget = new Target(gl, hasTerrain);
    this.fineTarget = new Target(gl, hasTerrain);
    this.shown = this.quickTarget;
  }

  /** Clouds as they are known now, coarse. */
  drawQuick(camera: Camera, near: number, exaggeration: number): void {
    const {gl} = this;
    const size = (pixels: number) => Math.max(1, Math.ceil(pixels / this.divisor));
    this.quickTarget.resize(size(gl.drawingBufferWidth), size(gl.drawingBufferHeight));
    const clip = clipMatrix(camera, near);
    this.begin(this.quickTarget, camera, clip, exaggeration);
    this.painter.draw(this.quick, 0, this.quick.count, clip, this.hasTerrain);
    this.shown = this.quickTarget;
    this.compose(camera, near, exaggeration);
  }

  /** Takes a finer list; advanceFine then draws it. */
  startFine(list: ArrayBuffer, camera: Camera, near: number, exaggeration: number): void {
    const {gl} = this;
    this.fine.set(list);
    this.fineTarget.resize(gl.drawingBufferWidth, gl.drawingBufferHeight);
    this.begin(this.fineTarget, camera, clipMatrix(camera, near), exaggeration);
    this.fineDone = 0;
  }

  /** Draws a part more; true once all of it is on the screen. */
  advanceFine(camera: Camera, near: number, exaggeration: number): boolean {
    const part = Math.max(LEAST_PART, Math.ceil(this.fine.count / PARTS));
    const count = Math.min(part, this.fine.count - this.fineDone);
    this.fineTarget.bind();
    this.painter.draw(this.fine, this.fineDone, count, clipMatrix(camera, near), this.hasTerrain);
    this.fineDone += count;
    if (this.fineDone < this.fine.count) {
      this.gl.flush();
      return false;
    }
    this.shown = this.fineTarget;
    this.compose(camera, near, exaggeration);
    return true;
  }

  /** Sky and ground under the clouds that were drawn last. */
  compose(camera: Camera, near: number, exaggeration: number): void {
    const {gl} = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    this.backdrop.draw(clipMatrix(camera, near), camera, exaggeration, near, this.shown);
  }

  private begin(target: Target, camera: Camera, clip: Float32Array, exaggeration: number): void {
    target.clear();
    // The backdrop's shaders name the cloud picture even where only depth is drawn: not the one that is drawn into.
    if (this.hasTerrain) this.backdrop.drawDepth(clip, camera, exaggeration, target === this.fineTarget ? this.quickTarget : this.fineTarget);
  }
}
