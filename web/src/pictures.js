// Pictures in the programs of a planar map (FORMAT.md, D.6): they are checked, and give the colour at a point. Plain data.
import {
  BLOCK_SIDE,
  CELL_BITS,
  COORDINATE_BITS,
  COVERAGE_ONE,
  ENTRY_BITS,
  FIRST_BLOCK,
  KIND_FOLLOWS,
  KIND_SHIFT,
  MOST_PICTURE_SIDE,
  PAINT_ONE,
} from '../generated/layout.js';

/**
 * @typedef {import('./planar-map.js').Color} Color
 *
 * @typedef {object} Picture As the texels of an operation say.
 * @property {number} opacity times 65535
 * @property {number} columns
 * @property {number} rows
 * @property {number} pixels index of the first texel of its pixels
 * @property {number} sampling 0 for squares, 1 for linear interpolation, 2 for splines, 3 and 4 for splines of opacities
 * @property {number[]} across a, b, c: the column is ax + by + c
 * @property {number[]} down d, e, f: the row is dx + ey + f
 * @property {number} color of a picture of opacities: red, green, blue, from the low byte up
 */

/** Texels of an operation. */
export const PICTURE_TEXELS = 3;

const [PIXELS, LINEAR, , OPACITY, INVERSE] = [0, 1, 2, 3, 4];
const BYTE = 255;
const COLOR = 0xffffff;

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
    color: texels[4 * (texel + 1) + 3] & COLOR,
  };
}

/** @param {Picture} picture */
const hasBlocks = ({ sampling }) => sampling >= OPACITY;

/**
 * Texels of a picture's pixels with all its levels, each half as large as the one before; or other squares of pixels.
 *
 * @param {number} columns
 * @param {number} rows
 * @param {number} [side] of a square
 */
export function texelCount(columns, rows, side = 2) {
  let squares = 0;
  for (let [wide, high] = [columns, rows]; ; [wide, high] = [(wide + 1) >> 1, (high + 1) >> 1]) {
    squares += Math.ceil(wide / side) * Math.ceil(high / side);
    if (wide === 1 && high === 1) return squares;
  }
}

/** @param {Picture} picture */
const countBlocks = ({ columns, rows }) => texelCount(columns, rows, BLOCK_SIDE);

/**
 * Texel after the pixels of a picture without opacities, or after its index of blocks.
 *
 * @param {Picture} picture
 */
function firstEnd(picture) {
  if (!hasBlocks(picture)) return picture.pixels + texelCount(picture.columns, picture.rows);
  return picture.pixels + Math.ceil(countBlocks(picture) / (1 << ENTRY_BITS));
}

/**
 * Entry of an index of blocks.
 *
 * @param {Uint32Array} texels
 * @param {Picture} picture
 * @param {number} k
 */
const entryAt = (texels, { pixels }, k) => (texels[4 * pixels + (k >> 1)] >>> (COORDINATE_BITS * (k & 1))) & PAINT_ONE;

/**
 * Texel after all of a picture, whose index, if it has one, is among the texels.
 *
 * @param {Uint32Array} texels
 * @param {Picture} picture
 */
function endOf(texels, picture) {
  const end = firstEnd(picture);
  let most = FIRST_BLOCK - 1;
  for (let k = hasBlocks(picture) ? countBlocks(picture) : 0; k-- > 0; ) {
    most = Math.max(most, entryAt(texels, picture, k));
  }
  return end + most + 1 - FIRST_BLOCK;
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
  const picture = pictureAt(texels, texel);
  const { opacity, columns, rows, pixels, sampling, across, down, color } = picture;
  const words = [1, 2].map((k) => texels[4 * (texel + k) + 3]);
  if (words.some((word) => word >>> KIND_SHIFT !== KIND_FOLLOWS)) return 'an operation of the wrong length';
  if (opacity > PAINT_ONE || sampling > INVERSE) return 'no such picture';
  const rests = words.map((word) => word & (2 ** KIND_SHIFT - 1));
  if (rests[0] !== (hasBlocks(picture) ? color : 0) || rests[1] !== 0) return 'a word that is not 0';
  if (Math.min(columns, rows) < 1 || Math.max(columns, rows) > MOST_PICTURE_SIDE) return 'a picture of no such size';
  if (![...across, ...down].every(Number.isFinite)) return 'a number is not finite';
  if (pixels < first || firstEnd(picture) > first + count) return 'pixels elsewhere';
  for (let k = countBlocks(picture); hasBlocks(picture) && k % (1 << ENTRY_BITS) !== 0; k++) {
    if (entryAt(texels, picture, k) !== 0) return 'an index of blocks';
  }
  return endOf(texels, picture) > first + count ? 'pixels elsewhere' : '';
}

/**
 * Check that pictures share all their texels or none, and that no pixel has a colour above its opacity; return what is wrong,
 * or an empty text.
 *
 * @param {Uint32Array} texels
 * @param {readonly number[]} operations the first texel of each checked one
 */
export function faultOfPixels(texels, operations) {
  const pictures = operations.map((texel) => pictureAt(texels, texel)).sort((one, other) => one.pixels - other.pixels);
  let end = 0;
  for (const [k, picture] of pictures.entries()) {
    const { pixels, columns, rows } = picture;
    const before = pictures[k - 1];
    if (before && before.pixels === pixels && before.columns === columns && before.rows === rows) {
      if (hasBlocks(before) === hasBlocks(picture)) continue;
    }
    if (pixels < end) return 'pictures that overlap';
    end = endOf(texels, picture);
    if (!hasBlocks(picture) && !arePremultiplied(texels.subarray(4 * pixels, 4 * end))) return 'a pixel above its opacity';
  }
  return '';
}

/** @param {Uint32Array} words of pixels */
function arePremultiplied(words) {
  for (const word of words) {
    const opacity = word >>> 24;
    if ((word & BYTE) > opacity || ((word >>> 8) & BYTE) > opacity || ((word >>> 16) & BYTE) > opacity) return false;
  }
  return true;
}

/**
 * The word of a pixel, or its opacity.
 *
 * @param {Uint32Array} texels
 * @param {Picture} picture
 * @param {number} column
 * @param {number} row
 */
function pixelAt(texels, picture, column, row) {
  if (!hasBlocks(picture)) {
    const texel = picture.pixels + (row >> 1) * ((picture.columns + 1) >> 1) + (column >> 1);
    return texels[4 * texel + 2 * (row & 1) + (column & 1)];
  }
  const across = Math.ceil(picture.columns / BLOCK_SIDE);
  const [i, j] = [column, row].map((place) => Math.floor(place / BLOCK_SIDE));
  const entry = entryAt(texels, picture, across * j + i);
  if (entry < FIRST_BLOCK) return entry;
  const word = texels[4 * (firstEnd(picture) + entry - FIRST_BLOCK) + row - BLOCK_SIDE * j];
  return (word >>> (CELL_BITS * (column - BLOCK_SIDE * i))) & BYTE;
}

/**
 * The first column or row with a part in the colour at a place, and the weights of that one and those that follow.
 *
 * @param {number} sampling
 * @param {number} place
 * @returns {[number, number[]]}
 */
function weightsAt(sampling, place) {
  if (sampling === PIXELS) return [Math.floor(place), [1]];
  const first = Math.floor(place - 0.5);
  const t = place - 0.5 - first;
  const u = 1 - t;
  if (sampling === LINEAR) return [first, [u, t]];
  const near = (/** @type {number} */ s) => 2 / 3 - s * s * (1 - s / 2);
  return [first - 1, [u ** 3 / 6, near(t), near(u), t ** 3 / 6]];
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
  const picture = pictureAt(texels, texel);
  const { columns, rows, sampling } = picture;
  const [[left, across], [top, down]] = [picture.across, picture.down].map(([a, b, c]) => weightsAt(sampling, a * u + b * v + c));
  const nearest = (/** @type {number} */ at, /** @type {number} */ count) => Math.min(Math.max(at, 0), count - 1);
  const opacity = picture.opacity / PAINT_ONE;
  const sums = [0, 0, 0, 0];
  for (const [j, high] of down.entries()) {
    for (const [i, wide] of across.entries()) {
      const word = pixelAt(texels, picture, nearest(left + i, columns), nearest(top + j, rows));
      for (let k = 0; k < 4; k++) sums[k] += wide * high * ((word >>> (CELL_BITS * k)) & BYTE);
    }
  }
  if (!hasBlocks(picture)) return /** @type {Color} */ (sums.map((sum) => (sum * opacity) / COVERAGE_ONE));
  const value = sums[0] / COVERAGE_ONE;
  const alpha = opacity * (sampling === INVERSE ? 1 - value : value);
  const [red, green, blue] = [0, 1, 2].map((k) => (alpha * ((picture.color >>> (CELL_BITS * k)) & BYTE)) / COVERAGE_ONE);
  return [red, green, blue, alpha];
}
