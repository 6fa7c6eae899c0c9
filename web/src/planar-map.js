// Where the parts of a planar map lie, and what they say (FORMAT.md, part D). Plain data, without three.js.
import { CELL_BITS, COORDINATE_BITS, COVERAGE_ONE, MAP_HEAD, MOST_BYTE_PAINTS, PAINT_ONE } from '../generated/layout.js';

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
 * @property {number} rest what must be 0
 */

/**
 * @param {Uint32Array} texels
 * @param {number} quad index of the root quad
 * @returns {Head}
 */
export function headOf(texels, quad) {
  const words = texels.subarray(4 * (quad - MAP_HEAD), 4 * quad);
  const [programs, operations, stops, rest, used, cells, sides, paints] = words;
  return { quad, used, cells, sides, paints, programs, operations, stops, rest };
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
  const word = texels[4 * (head.cells + 2 * (quad - head.quad)) + cell];
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
  return texels[4 * (head.cells + 2 * (quad - head.quad) + 1) + cell];
}

/**
 * How many curves have the paints beside them in one texel.
 *
 * @param {number} used number of paints
 */
export function sidesInTexel(used) {
  return used > MOST_BYTE_PAINTS ? 4 : 8;
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
  const narrow = head.used > MOST_BYTE_PAINTS ? 0 : 1;
  const word = texels[4 * head.sides + (curve >> narrow)] >>> ((curve & narrow) << 4);
  const bits = COORDINATE_BITS >> narrow;
  const mask = (1 << bits) - 1;
  return [word & mask, (word >>> bits) & mask];
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
