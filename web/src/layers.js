// The layers texture, from which a shader reads each root's quad, paint and bounds.
import { MOST_ROWS } from '../generated/layout.js';
import { VextureError } from './errors.js';
import { layerRange } from './select-root.js';
import { wordTexture } from './upload.js';
import { BLACK, bounds } from './walk.js';

/** 1 as a fixed-point coordinate of bounds: 16 fractional bits. */
const FIXED_ONE = 65536;

const UNORM_ONE = 65535;

/**
 * Texture with a row of two texels for each of the first 16,384 roots: (quad, red and green, blue and opacity, 1 for
 * a planar map), with 16 bits of sRGB for each component; and (x0, y0, x1, y1), the bounds of the shape in 1/65536.
 *
 * @param {import('./data.js').PackedData} data
 * @returns {import('three').DataTexture}
 */
export function layersTexture(data) {
  const height = Math.min(data.roots.length, MOST_ROWS);
  const words = new Uint32Array(8 * height);
  /** @type {Map<number, number[]>} */
  const boxes = new Map(); // roots may share a quad
  for (let row = 0; row < height; row++) {
    const { quad, paint, isMap } = data.roots[row];
    const { color, opacity } = paint ?? BLACK;
    const [red, green, blue, alpha] = [...color, opacity].map((part) => Math.round(UNORM_ONE * part));
    const box = boxes.get(quad) ?? outwards(bounds(data, quad));
    boxes.set(quad, box);
    words.set([quad, red | (green << 16), blue | (alpha << 16), Number(isMap), ...box], 8 * row);
  }
  return wordTexture(words, 2, height);
}

/**
 * A box in fixed point, rounded outwards.
 *
 * @param {number[]} box x0 y0 x1 y1
 */
function outwards([x0, y0, x1, y1]) {
  return [
    Math.floor(x0 * FIXED_ONE),
    Math.floor(y0 * FIXED_ONE),
    Math.ceil(x1 * FIXED_ONE),
    Math.ceil(y1 * FIXED_ONE),
  ];
}

/**
 * Range of a drawing's layers in the layers texture.
 *
 * @param {import('./data.js').PackedData} data
 * @param {import('./select-root.js').RootChoice} root
 * @returns {{ first: number, count: number }}
 * @throws {VextureError} if there is no such drawing, several and no choice, or it lies beyond the texture's rows
 */
export function layersOf(data, root) {
  const range = layerRange(data, root);
  if (range.first + range.count <= MOST_ROWS) return range;
  throw new VextureError(
    `${data.name}: layers ${range.first} to ${range.first + range.count - 1}; only the first ${MOST_ROWS} can be drawn ` +
      'as layers; use several textures',
    'root',
  );
}
