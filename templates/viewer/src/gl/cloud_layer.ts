// SPDX-License-Identifier: Apache-2.0
import {bytesOf, CORNER_BYTES, TRIANGLE, type Shape} from '../pack/quads';
import {Program, type GL} from './gl';
import {GREY_SCALE} from './sprites';

const QUAD_VERTEX = `
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 color;
layout(location = 2) in vec4 sprite;
uniform mat4 u_clip;
out vec3 v_sprite;
out vec4 v_color;
void main() {
  gl_Position = u_clip * vec4(place, 1.0);
  v_sprite = vec3(sprite.xy / 255.0, sprite.z + 256.0 * sprite.w);
  v_color = vec4(color.rgb * (color.a * ${GREY_SCALE}), color.a);
}`;

const QUAD_FRAGMENT = `
in vec3 v_sprite;
in vec4 v_color;
uniform sampler2DArray u_sprites;
out vec4 color;
void main() {
  vec2 texel = texture(u_sprites, v_sprite).rg;
  color = vec4(v_color.rgb * texel.g, v_color.a * texel.r);
}`;

const TRIANGLE_VERTEX = `
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 color;
layout(location = 2) in vec3 motion;
uniform mat4 u_clip;
uniform float u_ahead;
out vec2 v_corner;
flat out vec4 v_color;
const vec2 corners[3] = vec2[3](${[0, 2, 4].map((i) => `vec2(${TRIANGLE[i].toFixed(6)}, ${TRIANGLE[i + 1].toFixed(6)})`).join(', ')});
void main() {
  gl_Position = u_clip * vec4(place + u_ahead * motion, 1.0);
  v_corner = corners[gl_VertexID % 3];
  v_color = color;
}`;

/** A round blob that falls off much as a sprite does, and ends where it ends. */
const TRIANGLE_FRAGMENT = `
in vec2 v_corner;
flat in vec4 v_color;
out vec4 color;
void main() {
  float inside = max(0.0, 1.0 - dot(v_corner, v_corner));
  float alpha = v_color.a * inside * inside;
  color = vec4(v_color.rgb * alpha, alpha);
}`;

/**
 * A list of puffs on the GPU. They are laid out corner by corner: one instance a puff would be shorter, but software renderers take
 * every instance for a draw of its own, at some microseconds each.
 */
export class PuffList {
  count = 0;
  /** How many seconds of the pack's time later than it was made the list is drawn. */
  aheadSeconds = 0;
  private readonly vao: WebGLVertexArrayObject;
  private readonly vertices: VertexBuffer;
  private readonly motions: VertexBuffer;

  constructor(private readonly gl: GL, readonly shape: Shape, private readonly indices: QuadIndices) {
    this.vao = gl.createVertexArray();
    this.vertices = new VertexBuffer(gl);
    this.motions = new VertexBuffer(gl);
    const bytes = shape === 'quads' ? CORNER_BYTES + 4 : CORNER_BYTES;
    gl.bindVertexArray(this.vao);
    this.vertices.bind();
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, bytes, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, bytes, 12);
    if (shape === 'quads') {
      gl.enableVertexAttribArray(2);
      gl.vertexAttribPointer(2, 4, gl.UNSIGNED_BYTE, false, bytes, 16);
    }
    gl.bindVertexArray(null);
  }

  set(buffer: ArrayBuffer, motions: ArrayBuffer | null = null): void {
    this.count = buffer.byteLength / bytesOf(this.shape);
    this.vertices.set(buffer);
    this.aheadSeconds = 0;
    if (this.shape === 'triangles') this.setMotions(motions);
  }

  private setMotions(motions: ArrayBuffer | null): void {
    const {gl} = this;
    gl.bindVertexArray(this.vao);
    if (motions) {
      this.motions.set(motions);
      gl.enableVertexAttribArray(2);
      gl.vertexAttribPointer(2, 3, gl.FLOAT, false, 12, 0);
    } else {
      gl.disableVertexAttribArray(2);
      gl.vertexAttrib3f(2, 0, 0, 0);
    }
    gl.bindVertexArray(null);
  }

  draw(first: number, count: number): void {
    const {gl} = this;
    if (count <= 0) return;
    gl.bindVertexArray(this.vao);
    if (this.shape === 'triangles') gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * count);
    else {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices.forQuads(first + count));
      gl.drawElements(gl.TRIANGLES, 6 * count, gl.UNSIGNED_INT, 24 * first);
    }
    gl.bindVertexArray(null);
  }
}

/** Bytes that are replaced often. */
class VertexBuffer {
  private readonly buffer: WebGLBuffer;
  private capacity = 0;

  constructor(private readonly gl: GL) {
    this.buffer = gl.createBuffer();
  }

  bind(): void {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffer);
  }

  set(bytes: ArrayBuffer): void {
    const {gl} = this;
    this.bind();
    if (bytes.byteLength > this.capacity) {
      this.capacity = Math.ceil(1.3 * bytes.byteLength);
      gl.bufferData(gl.ARRAY_BUFFER, this.capacity, gl.DYNAMIC_DRAW);
    }
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, new Uint8Array(bytes));
  }
}

/** Two triangles a quad, for all lists. */
export class QuadIndices {
  private readonly buffer: WebGLBuffer;
  private quads = 0;

  constructor(private readonly gl: GL) {
    this.buffer = gl.createBuffer();
  }

  forQuads(count: number): WebGLBuffer {
    if (count <= this.quads) return this.buffer;
    const {gl} = this;
    this.quads = Math.max(4096, Math.ceil(1.5 * count));
    const indices = new Uint32Array(6 * this.quads);
    for (let i = 0; i < this.quads; ++i) indices.set([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 2, 4 * i + 1, 4 * i + 3], 6 * i);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    return this.buffer;
  }
}

/** Draws lists into the target that is bound, over what is in it; colours are premultiplied. */
export class CloudPainter {
  private readonly programs: Record<Shape, Program>;

  constructor(private readonly gl: GL, private readonly sprites: WebGLTexture) {
    this.programs = {triangles: new Program(gl, TRIANGLE_VERTEX, TRIANGLE_FRAGMENT), quads: new Program(gl, QUAD_VERTEX, QUAD_FRAGMENT)};
  }

  draw(list: PuffList, first: number, count: number, clip: Float32Array, behindTerrain: boolean): void {
    const {gl} = this;
    const program = this.programs[list.shape].use().matrix('u_clip', clip);
    if (list.shape === 'triangles') program.set('u_ahead', list.aheadSeconds);
    if (list.shape === 'quads') program.texture('u_sprites', 3, this.sprites, gl.TEXTURE_2D_ARRAY);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    if (behindTerrain) gl.enable(gl.DEPTH_TEST);
    list.draw(first, count);
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);
  }
}
