/** Texels as pixels: two by two for the four words of each. */
import { CELL_BITS, COORDINATE_BITS } from '../generated/layout.js';
import { BASES, CURVE, HEAD, MEANS, OPERATIONS, OTHER, PAINTS, QUAD, SIDES, STOPS } from './texel-map.js';

/** @typedef {[number, number, number]} Bytes */

/** Colours of the darkest and the lightest word of each kind, 0..255; the kinds differ in lightness too. */
/** @type {Record<number, [Bytes, Bytes]>} */
export const TINTS = {
  [QUAD]: [[8, 29, 88], [120, 180, 245]],
  [CURVE]: [[140, 65, 0], [255, 224, 160]],
  [HEAD]: [[110, 10, 70], [250, 170, 215]],
  [MEANS]: [[0, 75, 45], [150, 235, 190]],
  [BASES]: [[0, 75, 45], [150, 235, 190]],
  [SIDES]: [[75, 30, 120], [215, 185, 250]],
  [PAINTS]: [[110, 10, 70], [250, 170, 215]],
  [OPERATIONS]: [[70, 70, 0], [225, 220, 130]],
  [STOPS]: [[70, 70, 0], [225, 220, 130]],
  [OTHER]: [[96, 98, 102], [190, 192, 196]],
};
const UNUSED_COLOR = /** @type {Bytes} */ ([226, 227, 230]);

const COORDINATE_ONE = (1 << COORDINATE_BITS) - 1;
const BYTE = (1 << CELL_BITS) - 1;

/**
 * How light a word is, 0..1.
 *
 * @param {number} kind of its texel
 * @param {number} k which word
 * @param {number} word
 * @param {number} length number of texels
 */
export function brightness(kind, k, word, length) {
  if (kind === QUAD && k < 2) return Math.min(word / length, 1);
  if (kind === QUAD || kind === MEANS) {
    const bytes = [0, 1, 2, 3].map((i) => (word >>> (CELL_BITS * i)) & BYTE);
    return bytes.reduce((sum, byte) => sum + byte, 0) / (4 * BYTE);
  }
  return ((word & COORDINATE_ONE) + (word >>> COORDINATE_BITS)) / (2 * COORDINATE_ONE);
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {import('./texel-map.js').TexelMap} map
 * @param {number} first texel
 * @param {number} count of texels
 * @param {number} columns
 */
export function paintTexels(canvas, { data, kinds }, first, count, columns) {
  const rows = Math.ceil(count / columns);
  canvas.width = 2 * columns;
  canvas.height = 2 * rows;
  const image = new ImageData(canvas.width, canvas.height);
  for (let at = 0; at < count; at++) {
    const kind = kinds[first + at];
    for (let k = 0; k < 4; k++) {
      const word = data.texels[4 * (first + at) + k];
      const share = brightness(kind, k, word, kinds.length);
      const tint = TINTS[kind];
      const x = 2 * (at % columns) + (k & 1);
      const y = 2 * Math.floor(at / columns) + (k >> 1);
      const place = 4 * (y * canvas.width + x);
      for (let part = 0; part < 3; part++) {
        image.data[place + part] = tint ? tint[0][part] + share * (tint[1][part] - tint[0][part]) : UNUSED_COLOR[part];
      }
      image.data[place + 3] = 255;
    }
  }
  canvas.getContext('2d')?.putImageData(image, 0, 0);
}
