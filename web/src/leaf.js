// The cells of a quad as its texel stores them, and their curves (FORMAT.md, B.3, B.4). Plain data, without three.js.
import { CELL_BITS, CONTROL_OFFSET, COORDINATE_BITS, COUNT_SHIFT, QUAD_FLAG } from '../generated/layout.js';

const CELL_MASK = (1 << CELL_BITS) - 1;
const COORDINATE_MASK = (1 << COORDINATE_BITS) - 1;

/**
 * @typedef {object} Leaf A cell as stored in its quad's texel.
 * @property {number} byte of word 2
 * @property {number} below index of its quad, if it is a quad
 * @property {number} first index of its first curve, if it has any
 * @property {number} coverage 0..255; of a planar map 0
 */

/**
 * Cell k of a quad.
 *
 * @param {Uint32Array} texels
 * @param {number} quad
 * @param {number} k
 * @returns {Leaf}
 */
export function leafOf(texels, quad, k) {
  const word = texels[4 * quad + 2];
  let below = texels[4 * quad];
  let first = texels[4 * quad + 1];
  for (let i = 0; i < k; i++) {
    const before = (word >>> (CELL_BITS * i)) & CELL_MASK;
    if (before === QUAD_FLAG) below++;
    else first += before >> COUNT_SHIFT;
  }
  const shift = CELL_BITS * k;
  return { byte: (word >>> shift) & CELL_MASK, below, first, coverage: (texels[4 * quad + 3] >>> shift) & CELL_MASK };
}

/**
 * Points of a curve in lattice units of its leaf: x0 y0 x1 y1 x2 y2 x3 y3.
 *
 * @param {Uint32Array} texels
 * @param {number} curve index of its texel
 * @returns {number[]}
 */
function points(texels, curve) {
  const found = [];
  for (let k = 0; k < 4; k++) {
    const word = texels[4 * curve + k];
    const offset = k === 1 || k === 2 ? CONTROL_OFFSET : 0;
    found.push((word & COORDINATE_MASK) - offset, (word >>> COORDINATE_BITS) - offset);
  }
  return found;
}

/**
 * The curves of a leaf, in its lattice units.
 *
 * @param {Uint32Array} texels
 * @param {Leaf} leaf
 */
export function curvesOf(texels, { byte, first }) {
  return Array.from({ length: byte >> COUNT_SHIFT }, (_, i) => points(texels, first + i));
}
