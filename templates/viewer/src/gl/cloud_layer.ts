// SPDX-License-Identifier: Apache-2.0
import {CORNER_BYTES, QUAD_BYTES} from '../pack/quads';
import {Program, type GL} from './gl';
import {GREY_SCALE} from './sprites';

const VERTEX = `
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

const FRAGMENT = `
in vec3 v_sprite;
in vec4 v_color;
uniform sampler2DArray u_sprites;
out vec4 color;
void main() {
  vec2 texel = texture(u_sprites, v_sprite).rg;
  color = vec4(v_color.rgb * texel.g, v_color.a * texel.r);
}`;

/**
 * A list of quads on the GPU, and how it is drawn. Quads are laid out as four corners each: one instance a quad would be shorter to
 * write, but software renderers take every instance for a draw of its own, at some microseconds each.
 */
export class QuadList {
  count = 0;
  private readonly vao: WebGLVertexArrayObject;
  private readonly vertices: WebGLBuffer;
  private capacity = 0;

  constructor(private readonly gl: GL, private readonly indices: QuadIndices) {
    this.vao = gl.createVertexArray();
    this.vertices = gl.createBuffer();
    gl.bindVertexArray(this.vao);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.vertices);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, CORNER_BYTES, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, CORNER_BYTES, 12);
    gl.enableVertexAttribArray(2);
    gl.vertexAttribPointer(2, 4, gl.UNSIGNED_BYTE, false, CORNER_BYTES, 16);
    gl.bindVertexArray(null);
  }

  set(buffer: ArrayBuffer): void {
    const {gl} = this;
    this.count = buffer.byteLength / (QUAD_BYTES);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.vertices);
    if (buffer.byteLength > this.capacity) {
      this.capacity = Math.ceil(1.3 * buffer.byteLength);
      gl.bufferData(gl.ARRAY_BUFFER, this.capacity, gl.DYNAMIC_DRAW);
    }
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, new Uint8Array(buffer));
  }

  draw(first: number, count: number): void {
    const {gl} = this;
    if (count <= 0) return;
    gl.bindVertexArray(this.vao);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices.forQuads(first + count));
    gl.drawElements(gl.TRIANGLES, 6 * count, gl.UNSIGNED_INT, 24 * first);
    gl.bindVertexArray(null);
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

/** Draws lists of quads into the target that is bound, over what is in it; colours are premultiplied. */
export class CloudPainter {
  private readonly program: Program;

  constructor(private readonly gl: GL, private readonly sprites: WebGLTexture) {
    this.program = new Program(gl, VERTEX, FRAGMENT);
  }

  draw(list: QuadList, first: number, count: number, clip: Float32Array, behindTerrain: boolean): void {
    const {gl} = this;
    this.program.use().matrix('u_clip', clip).texture('u_sprites', 3, this.sprites, gl.TEXTURE_2D_ARRAY);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    if (behindTerrain) gl.enable(gl.DEPTH_TEST);
    else gl.disable(gl.DEPTH_TEST);
    list.draw(first, count);
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);
  }
}
