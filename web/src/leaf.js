// The cells of a quad as its texel stores them, and their curves (FORMAT.md, B.3, B.4, D.2). Plain data, without three.js.
import { CELL_BITS, CONTROL_OFFSET, COORDINATE_BITS, COUNT_SHIFT, QUAD_FLAG, STRAIGHT } from '../generated/layout.js';

const CELL_MASK = (1 << CELL_BITS) - 1;
const COORDINATE_MASK = (1 << COORDINATE_BITS) - 1;

/**
 * @typedef {object} Leaf A cell as stored in its quad's texel.
 * @property {number} byte of word 2
 * @property {number} below index of its quad, if it is a quad
 * @property {number} first index of the first texel of its curves, if it has any
 * @property {boolean} isStraight whether two of its curves share a texel
 * @property {number} number of its first curve, in a planar map; else 0
 * @property {number} coverage 0..255; of a planar map 0
 */

/**
 * Number of texels of the curves in a leaf.
 *
 * @param {number} byte of the leaf
 * @param {boolean} ofMap whether it is a planar map's
 */
export function texelsIn(byte, ofMap) {
  const count = byte >> COUNT_SHIFT;
  return ofMap && byte & STRAIGHT ? (count + 1) >> 1 : count;
}

/**
 * Cell k of a quad.
 *
 * @param {Uint32Array} texels
 * @param {number} quad
 * @param {number} k
 * @param {boolean} ofMap whether it is a planar map's
 * @returns {Leaf}
 */
export function leafOf(texels, quad, k, ofMap) {
  const word = texels[4 * quad + 2];
  const last = texels[4 * quad + 3];
  let below = texels[4 * quad];
  let first = texels[4 * quad + 1];
  let number = ofMap ? last : 0;
  for (let i = 0; i < k; i++) {
    const before = (word >>> (CELL_BITS * i)) & CELL_MASK;
    if (before === QUAD_FLAG) below++;
    else {
      first += texelsIn(before, ofMap);
      if (ofMap) number += before >> COUNT_SHIFT;
    }
  }
  const shift = CELL_BITS * k;
  const byte = (word >>> shift) & CELL_MASK;
  const isStraight = ofMap && (byte & STRAIGHT) !== 0;
  return { byte, below, first, isStraight, number, coverage: ofMap ? 0 : (last >>> shift) & CELL_MASK };
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
 * Points of a straight curve, from the words of its ends.
 *
 * @param {number} start
 * @param {number} end
 */
function straight(start, end) {
  const [x0, y0, x3, y3] = [start & COORDINATE_MASK, start >>> COORDINATE_BITS, end & COORDINATE_MASK, end >>> COORDINATE_BITS];
  const third = (/** @type {number} */ near, /** @type {number} */ far) => Math.floor((2 * near + far + 1) / 3);
  return [x0, y0, third(x0, x3), third(y0, y3), third(x3, x0), third(y3, y0), x3, y3];
}

/**
 * The curves of a leaf, in its lattice units.
 *
 * @param {Uint32Array} texels
 * @param {Leaf} leaf
 */
export function curvesOf(texels, { byte, first, isStraight }) {
  const ends = 4 * first;
  return Array.from({ length: byte >> COUNT_SHIFT }, (_, i) =>
    isStraight ? straight(texels[ends + 2 * i], texels[ends + 2 * i + 1]) : points(texels, first + i));
}
