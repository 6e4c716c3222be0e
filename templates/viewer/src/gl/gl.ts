// SPDX-License-Identifier: Apache-2.0

export type GL = WebGL2RenderingContext;

export class Program {
  readonly program: WebGLProgram;
  private readonly places = new Map<string, WebGLUniformLocation | null>();

  constructor(private readonly gl: GL, vertex: string, fragment: string) {
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, `#version 300 es\nprecision highp float;\nprecision highp sampler2DArray;\n${text}`);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error(`This browser's WebGL 2 refuses a shader of the page: ${gl.getShaderInfoLog(shader)}`);
    }
    gl.linkProgram(this.program);
  }

  use(): this {
    this.gl.useProgram(this.program);
    return this;
  }

  at(name: string): WebGLUniformLocation | null {
    let place = this.places.get(name);
    if (place === undefined) this.places.set(name, (place = this.gl.getUniformLocation(this.program, name)));
    return place;
  }

  set(name: string, ...values: number[]): this {
    const {gl} = this;
    const place = this.at(name);
    if (values.length === 1) gl.uniform1f(place, values[0]);
    else if (values.length === 2) gl.uniform2f(place, values[0], values[1]);
    else if (values.length === 3) gl.uniform3f(place, values[0], values[1], values[2]);
    else if (values.length === 4) gl.uniform4f(place, values[0], values[1], values[2], values[3]);
    else gl.uniformMatrix4fv(place, false, values);
    return this;
  }

  matrix(name: string, matrix: Float32Array): this {
    this.gl.uniformMatrix4fv(this.at(name), false, matrix);
    return this;
  }

  texture(name: string, unit: number, texture: WebGLTexture | null, target: number = this.gl.TEXTURE_2D): this {
    const {gl} = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, texture);
    gl.uniform1i(this.at(name), unit);
    return this;
  }
}

/** A mesh of floats, so many an attribute, in locations from 0 on; indexed triangles or plain lines. */
export class Mesh {
  private readonly vao: WebGLVertexArrayObject;
  private readonly count: number;

  constructor(private readonly gl: GL, values: number[], sizes: number[], indices: number[] | null, private readonly mode: number = gl.TRIANGLES) {
    this.vao = gl.createVertexArray();
    gl.bindVertexArray(this.vao);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(values), gl.STATIC_DRAW);
    const stride = sizes.reduce((sum, size) => sum + size, 0);
    let offset = 0;
    sizes.forEach((size, location) => {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * stride, 4 * offset);
      offset += size;
    });
    if (indices) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(indices), gl.STATIC_DRAW);
    }
    this.indexed = indices !== null;
    this.count = indices ? indices.length : values.length / stride;
    gl.bindVertexArray(null);
  }

  private readonly indexed: boolean;

  draw(): void {
    const {gl} = this;
    if (this.count === 0) return;
    gl.bindVertexArray(this.vao);
    if (this.indexed) gl.drawElements(this.mode, this.count, gl.UNSIGNED_INT, 0);
    else gl.drawArrays(this.mode, 0, this.count);
    gl.bindVertexArray(null);
  }
}

/** A texture to draw into, with depth where there is terrain. */
export class Target {
  width = 0;
  height = 0;
  color: WebGLTexture | null = null;
  depth: WebGLTexture | null = null;
  private frame: WebGLFramebuffer | null = null;

  constructor(private readonly gl: GL, private readonly withDepth: boolean) {}

  resize(width: number, height: number): void {
    if (this.width === width && this.height === height) return;
    const {gl} = this;
    this.free();
    [this.width, this.height] = [width, height];
    this.color = this.texture(gl.RGBA8, gl.LINEAR);
    if (this.withDepth) this.depth = this.texture(gl.DEPTH_COMPONENT24, gl.NEAREST);
    this.frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.color, 0);
    if (this.depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.depth, 0);
  }

  bind(): void {
    const {gl} = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.viewport(0, 0, this.width, this.height);
  }

  clear(): void {
    const {gl} = this;
    this.bind();
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  free(): void {
    const {gl} = this;
    gl.deleteTexture(this.color);
    gl.deleteTexture(this.depth);
    gl.deleteFramebuffer(this.frame);
    this.color = this.depth = this.frame = null;
    this.width = this.height = 0;
  }

  private texture(format: number, filter: number): WebGLTexture {
    const {gl} = this;
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, this.width, this.height);
    for (const parameter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, parameter, filter);
    for (const parameter of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, parameter, gl.CLAMP_TO_EDGE);
    return made;
  }
}

/** A texture of bytes, one or more a texel, bilinear. */
export function byteTexture(gl: GL, width: number, height: number, bytes: Uint8Array | null, channels: 1 | 4 = 1): WebGLTexture {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  const [inside, format] = channels === 1 ? [gl.R8, gl.RED] : [gl.RGBA8, gl.RGBA];
  gl.texImage2D(gl.TEXTURE_2D, 0, inside, width, height, 0, format, gl.UNSIGNED_BYTE, bytes);
  for (const parameter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, parameter, gl.LINEAR);
  for (const parameter of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, parameter, gl.CLAMP_TO_EDGE);
  return made;
}
