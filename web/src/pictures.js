// Pictures in the programs of a planar map (FORMAT.md, D.6): they are checked, and give the colour at a point. Plain data.
import { COORDINATE_BITS, COVERAGE_ONE, KIND_FOLLOWS, KIND_SHIFT, MOST_PICTURE_SIDE, PAINT_ONE } from '../generated/layout.js';

/**
 * @typedef {import('./planar-map.js').Color} Color
 *
 * @typedef {object} Picture As the texels of an operation say.
 * @property {number} opacity times 65535
 * @property {number} columns
 * @property {number} rows
 * @property {number} pixels index of the first texel of its pixels
 * @property {number} sampling 0 for squares, 1 for linear interpolation
 * @property {number[]} across a, b, c: the column is ax + by + c
 * @property {number[]} down d, e, f: the row is dx + ey + f
 */

/** Texels of an operation. */
export const PICTURE_TEXELS = 3;

const LINEAR = 1;
const BYTE = 255;

/**
 * @param {Uint32Array} texels
 * @param {number} texel the first of the operation
 * @returns {Picture}
 */
function pictureAt(texels, texel) {
  const [opacity, sides, distance, word] = texels.subarray(4 * texel, 4 * texel + 4);
  const values = new Float32Array(texels.buffer, texels.byteOffset, texels.length);
  const rowOf = (/** @type {number} */ row) => [...values.subarray(4 * (texel + row), 4 * (texel + row) + 3)];
  return {
    opacity,
    columns: sides & PAINT_ONE,
    rows: sides >>> COORDINATE_BITS,
    pixels: texel + distance,
    sampling: word & (2 ** KIND_SHIFT - 1),
    across: rowOf(1),
    down: rowOf(2),
  };
}

/**
 * Texels of a picture's pixels with all its levels, each half as large as the one before.
 *
 * @param {number} columns
 * @param {number} rows
 */
export function texelCount(columns, rows) {
  let texels = 0;
  for (let [wide, high] = [columns, rows]; ; [wide, high] = [(wide + 1) >> 1, (high + 1) >> 1]) {
    texels += ((wide + 1) >> 1) * ((high + 1) >> 1);
    if (wide === 1 && high === 1) return texels;
  }
}

/**
 * Check the texels of a picture's operation; return what is wrong, or an empty text.
 *
 * @param {Uint32Array} texels
 * @param {number} texel its first one
 * @param {number} first index of the first texel of the map's pixels
 * @param {number} count number of those
 */
export function faultOfPicture(texels, texel, first, count) {
  const { opacity, columns, rows, pixels, sampling, across, down } = pictureAt(texels, texel);
  const follows = [1, 2].every((k) => texels[4 * (texel + k) + 3] === KIND_FOLLOWS * 2 ** KIND_SHIFT);
  if (!follows) return 'an operation of the wrong length';
  if (opacity > PAINT_ONE || sampling > LINEAR) return 'no such picture';
  if (Math.min(columns, rows) < 1 || Math.max(columns, rows) > MOST_PICTURE_SIDE) return 'a picture of no such size';
  if (![...across, ...down].every(Number.isFinite)) return 'a number is not finite';
  if (pixels < first || pixels + texelCount(columns, rows) > first + count) return 'pixels elsewhere';
  return '';
}

/**
 * Whether pictures share all their texels or none.
 *
 * @param {Uint32Array} texels
 * @param {readonly number[]} operations the first texel of each checked one
 */
export function areApart(texels, operations) {
  const runs = operations.map((texel) => pictureAt(texels, texel)).sort((one, other) => one.pixels - other.pixels);
  return runs.every((run, k) => {
    if (k === 0) return true;
    const { pixels, columns, rows } = runs[k - 1];
    const isSame = run.pixels === pixels && run.columns === columns && run.rows === rows;
    return isSame || run.pixels >= pixels + texelCount(columns, rows);
  });
}

/**
 * Whether no pixel of some texels has a colour above its opacity.
 *
 * @param {Uint32Array} texels
 * @param {number} first
 * @param {number} count
 */
export function arePremultiplied(texels, first, count) {
  for (const word of texels.subarray(4 * first, 4 * (first + count))) {
    const opacity = word >>> 24;
    if ((word & BYTE) > opacity || ((word >>> 8) & BYTE) > opacity || ((word >>> 16) & BYTE) > opacity) return false;
  }
  return true;
}

/**
 * The colour of a picture at a point of the unit square: premultiplied sRGB and opacity, 0..1.
 *
 * @param {Uint32Array} texels
 * @param {number} texel the first of the operation
 * @param {number} u
 * @param {number} v upwards
 * @returns {Color}
 */
export function pictureColor(texels, texel, u, v) {
  const { opacity, columns, rows, pixels, sampling, across, down } = pictureAt(texels, texel);
  const shift = sampling === LINEAR ? 0.5 : 0;
  const [x, y] = [across, down].map(([a, b, c]) => a * u + b * v + c - shift);
  const [column, row] = [Math.floor(x), Math.floor(y)];
  const [right, low] = sampling === LINEAR ? [x - column, y - row] : [0, 0];
  const held = (/** @type {number} */ at, /** @type {number} */ count) => Math.min(Math.max(at, 0), count - 1);
  const color = /** @type {Color} */ ([0, 0, 0, 0]);
  for (const [i, j, share] of [[0, 0, (1 - right) * (1 - low)], [1, 0, right * (1 - low)], [0, 1, (1 - right) * low], [1, 1, right * low]]) {
    const [across, down] = [held(column + i, columns), held(row + j, rows)];
    const block = pixels + (down >> 1) * ((columns + 1) >> 1) + (across >> 1);
    const word = texels[4 * block + 2 * (down & 1) + (across & 1)];
    for (let k = 0; k < 4; k++) color[k] += (share * ((word >>> (8 * k)) & BYTE) * opacity) / (COVERAGE_ONE * PAINT_ONE);
  }
  return color;
}
