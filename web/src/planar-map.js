// Where the parts of a planar map lie, and what they say (FORMAT.md, part D). Plain data, without three.js.
import {
  CELL_BITS,
  COORDINATE_BITS,
  COVERAGE_ONE,
  MAP_HEAD,
  MOST_BYTE_PAINTS,
  MOST_HALF_PAINTS,
  PAINT_ONE,
} from '../generated/layout.js';

const COMPONENTS = [0, 1, 2, 3];

/**
 * @typedef {[number, number, number, number]} Color red, green, blue, opacity: sRGB, premultiplied
 *
 * @typedef {object} Head The texels before a map's root quad.
 * @property {number} quad index of the root quad
 * @property {number} used number of paints
 * @property {number} cells index of the first texel of the cells' means and base paints
 * @property {number} sides index of the first texel of the paints beside curves
 * @property {number} paints index of the first texel of the table of paints
 * @property {number} programs index of the first texel of operations
 * @property {number} operations number of their texels
 * @property {number} stops number of the texels of stops, which follow
 * @property {number} pixels number of the texels of pixels, which follow the stops
 */

/**
 * @param {Uint32Array} texels
 * @param {number} quad index of the root quad
 * @returns {Head}
 */
export function headOf(texels, quad) {
  const words = texels.subarray(4 * (quad - MAP_HEAD), 4 * quad);
  const [programs, operations, stops, pixels, used, cells, sides, paints] = words;
  return { quad, used, cells, sides, paints, programs, operations, stops, pixels };
}

/**
 * Logarithm of how many numbers of paints are in a word.
 *
 * @param {number} used number of paints
 */
function packingOf(used) {
  return used > MOST_HALF_PAINTS ? 0 : used > MOST_BYTE_PAINTS ? 1 : 2;
}

/**
 * One of the numbers of paints that fill words.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} word the first of them
 * @param {number} place
 */
function numberIn(texels, head, word, place) {
  const packing = packingOf(head.used);
  const bits = 32 >> packing;
  const shifted = texels[word + (place >> packing)] >>> (bits * (place & ((1 << packing) - 1)));
  return (shifted & (0xffffffff >>> (32 - bits))) >>> 0;
}

/**
 * Quads whose base paints share a texel, before the texels of their means.
 *
 * @param {number} used number of paints
 */
export function quadsInBlock(used) {
  return sidesInTexel(used) / 2;
}

/**
 * The texel of the means of a quad's cells.
 *
 * @param {Head} head
 * @param {number} quad
 */
export function meansAt(head, quad) {
  const place = quad - head.quad;
  return head.cells + 1 + place + Math.floor(place / quadsInBlock(head.used));
}

/**
 * Mean colour of a cell, in steps of a byte.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} quad that holds it
 * @param {number} cell
 * @returns {Color}
 */
export function meanBytes(texels, head, quad, cell) {
  const word = texels[4 * meansAt(head, quad) + cell];
  return /** @type {Color} */ (COMPONENTS.map((k) => (word >>> (CELL_BITS * k)) & COVERAGE_ONE));
}

/**
 * Number of the base paint of a cell.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} quad that holds it
 * @param {number} cell
 */
export function basePaint(texels, head, quad, cell) {
  const place = quad - head.quad;
  const inBlock = quadsInBlock(head.used);
  const block = Math.floor(place / inBlock);
  return numberIn(texels, head, 4 * (head.cells + (1 + inBlock) * block), 4 * (place - inBlock * block) + cell);
}

/**
 * How many curves have the paints beside them in one texel.
 *
 * @param {number} used number of paints
 */
export function sidesInTexel(used) {
  return 2 << packingOf(used);
}

/**
 * Numbers of the paints on the left and on the right of a curve.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} curve its number
 * @returns {[number, number]}
 */
export function sidesOf(texels, head, curve) {
  const first = 4 * head.sides;
  return [numberIn(texels, head, first, 2 * curve), numberIn(texels, head, first, 2 * curve + 1)];
}

/**
 * Colour of a paint, in steps of 1/65535.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} paint its number
 * @returns {Color}
 */
export function paintSteps(texels, head, paint) {
  const at = 4 * head.paints + 2 * paint;
  return /** @type {Color} */ (COMPONENTS.map((k) => (texels[at + (k >> 1)] >>> (COORDINATE_BITS * (k & 1))) & PAINT_ONE));
}
