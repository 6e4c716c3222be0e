// SPDX-License-Identifier: Apache-2.0
import type {PackView} from '../pack/pack_view';
import type {GL} from './gl';

const PIXELS = 128;
/** What a byte of 255 stands for in the second channel, times the mean grey of the atlas. */
export const GREY_SCALE = 1.25;

/**
 * The sprites of all atlases, a layer a tile in the order of the atlases: opacity, and opacity times grey, where 1 is the mean
 * grey of the atlas as it is seen: so a sprite gives structure to a puff and neither lightens nor darkens it.
 */
export async function spriteTexture(gl: GL, pack: PackView): Promise<WebGLTexture> {
  const layers: Uint8Array[] = [];
  for (let a = 0; a < pack.root.atlasesLength(); ++a) {
    const atlas = pack.root.atlases(a)!;
    layers.push(...tilesOf(await pixelsOf(atlas.colorArray()), Math.max(1, atlas.columns()), Math.max(1, atlas.rows())));
  }
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
  gl.texStorage3D(gl.TEXTURE_2D_ARRAY, Math.log2(PIXELS) + 1, gl.RG8, PIXELS, PIXELS, Math.max(1, layers.length));
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  layers.forEach((layer, i) => gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, i, PIXELS, PIXELS, 1, gl.RG, gl.UNSIGNED_BYTE, layer));
  gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
  gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
  gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  for (const parameter of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D_ARRAY, parameter, gl.CLAMP_TO_EDGE);
  return texture;
}

/** The pixels of a PNG file; a soft round blob where there is none that can be read. */
async function pixelsOf(png: Uint8Array | null): Promise<ImageData> {
  const bitmap = await createImageBitmap(new Blob([(png ?? new Uint8Array()) as BlobPart], {type: 'image/png'}), {premultiplyAlpha: 'none', colorSpaceConversion: 'none'}).catch(() => null);
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = bitmap ? [bitmap.width, bitmap.height] : [PIXELS, PIXELS];
  const context = canvas.getContext('2d', {willReadFrequently: true})!;
  if (bitmap) context.drawImage(bitmap, 0, 0);
  else {
    const blob = context.createRadialGradient(PIXELS / 2, PIXELS / 2, 0, PIXELS / 2, PIXELS / 2, PIXELS / 2);
    for (let r = 0; r <= 1; r += 0.1) blob.addColorStop(r, `rgba(255,255,255,${r < 1 ? Math.exp(-2.42 * r * r) : 0})`);
    context.fillStyle = blob;
    context.fillRect(0, 0, PIXELS, PIXELS);
  }
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

function tilesOf(picture: ImageData, columns: number, rows: number): Uint8Array[] {
  const {width, height, data} = picture;
  let [weighted, weights] = [0, 1e-9];
  for (let i = 0; i < data.length; i += 4) {
    weighted += data[i] * data[i + 3];
    weights += data[i + 3];
  }
  const gain = 1 / (Math.max(1, weighted / weights) * GREY_SCALE);
  const [tileWidth, tileHeight] = [width / columns, height / rows];
  const tiles: Uint8Array[] = [];
  for (let tile = 0; tile < columns * rows; ++tile) {
    const [left, top] = [(tile % columns) * tileWidth, Math.floor(tile / columns) * tileHeight];
    const out = new Uint8Array(2 * PIXELS * PIXELS);
    for (let y = 0; y < PIXELS; ++y)
      for (let x = 0; x < PIXELS; ++x) {
        // The first row of a texture is its lower border.
        const px = Math.floor(left + ((x + 0.5) / PIXELS) * tileWidth);
        const py = Math.floor(top + (1 - (y + 0.5) / PIXELS) * tileHeight);
        const at = 4 * (py * width + px);
        const to = 2 * (y * PIXELS + x);
        out[to] = data[at + 3];
        out[to + 1] = Math.min(255, Math.round(data[at] * data[at + 3] * gain));
      }
    tiles.push(out);
  }
  return tiles;
}
