// Descends the trees of a validated packed texture on the CPU: the cell at a point, containment, bounds, counts.
// Plain data, without three.js.
import {
  CELL_BITS,
  CONTROL_OFFSET,
  COORDINATE_BITS,
  COUNT_SHIFT,
  COVERAGE_ONE,
  LATTICE,
  MOST_DEPTH,
  QUAD_FLAG,
  WINDING_OFFSET,
} from '../generated/layout.js';
import { VextureError } from './errors.js';
import { filledBox, winding } from './winding.js';

/** @typedef {import('./data.js').PackedData} PackedData */

const CELL_MASK = (1 << CELL_BITS) - 1;
const WINDING_MASK = (1 << COUNT_SHIFT) - 1;
const COORDINATE_MASK = (1 << COORDINATE_BITS) - 1;

/** Largest depth of `bounds`: quads with a side of 1/256 count as full. */
const BOUNDS_DEPTH = 8;

/**
 * @typedef {object} Cell Part of a quad-tree at a point.
 * @property {number} depth 0 is the unit square; a cell of depth d has the side 2^-d
 * @property {number} x of its lower left corner, in the unit square
 * @property {number} y of its lower left corner, upwards
 * @property {number} size of its side
 * @property {boolean} isQuad whether it is divided further
 * @property {number} coverage stored, 0..1
 * @property {number} winding corner winding of a leaf with curves; 0 elsewhere
 * @property {number[][]} curves of a leaf: x0 y0 x1 y1 x2 y2 x3 y3 each, in units of the unit square
 * @property {number} quad index of the quad that holds it
 * @property {number} cell 0 to 3, its place there: (right half) + 2 (upper half); -1 for the unit square itself
 */

/**
 * @typedef {object} Leaf A cell as stored in its quad's texel.
 * @property {number} byte of word 2
 * @property {number} below index of its quad, if it is a quad
 * @property {number} first index of its first curve, if it has any
 * @property {number} coverage 0..255
 */

/**
 * Cell k of a quad.
 *
 * @param {Uint32Array} texels
 * @param {number} quad
 * @param {number} k
 * @returns {Leaf}
 */
function read(texels, quad, k) {
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
 * @param {number} byte of the leaf
 * @param {number} first index of its first curve
 */
function curvesOf(texels, byte, first) {
  return Array.from({ length: byte >> COUNT_SHIFT }, (_, i) => points(texels, first + i));
}

/**
 * The corner winding of a leaf with curves.
 *
 * @param {number} byte of the leaf
 */
function cornerOf(byte) {
  return (byte & WINDING_MASK) - WINDING_OFFSET;
}

/**
 * The cell at a point of the unit square.
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @param {number} u
 * @param {number} v upwards
 * @param {number} [mostDepth] a quad at this depth is returned undivided
 * @returns {Cell | null} null beyond 0 <= u < 1, 0 <= v < 1
 */
export function cellAt(data, quad, u, v, mostDepth = MOST_DEPTH) {
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return null;
  const { texels } = data;
  if (mostDepth < 1) return top(texels, quad);
  let [x, y, size, depth] = [0, 0, 1, 0];
  for (;;) {
    size /= 2;
    depth++;
    const right = u >= x + size ? 1 : 0;
    const upper = v >= y + size ? 1 : 0;
    x += size * right; // exact: a multiple of 2^-20
    y += size * upper;
    const cell = right + 2 * upper;
    const leaf = read(texels, quad, cell);
    const isQuad = leaf.byte === QUAD_FLAG;
    if (isQuad && depth < mostDepth) {
      quad = leaf.below;
      continue;
    }
    const scale = size / LATTICE;
    const curves = isQuad
      ? []
      : curvesOf(texels, leaf.byte, leaf.first).map((curve) => curve.map((at, axis) => at * scale + (axis % 2 ? y : x)));
    const corner = curves.length ? cornerOf(leaf.byte) : 0;
    return { depth, x, y, size, isQuad, coverage: leaf.coverage / COVERAGE_ONE, winding: corner, curves, quad, cell };
  }
}

/**
 * The unit square as a cell.
 *
 * @param {Uint32Array} texels
 * @param {number} quad
 * @returns {Cell}
 */
function top(texels, quad) {
  let sum = 0;
  for (let k = 0; k < 4; k++) sum += read(texels, quad, k).coverage;
  const coverage = sum / 4 / COVERAGE_ONE;
  return { depth: 0, x: 0, y: 0, size: 1, isQuad: true, coverage, winding: 0, curves: [], quad, cell: -1 };
}

/**
 * Whether a point is inside a shape, computed from the stored outlines (FORMAT.md, B.6).
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @param {number} u
 * @param {number} v upwards
 * @returns {boolean}
 */
export function contains(data, quad, u, v) {
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return false;
  const { texels } = data;
  for (let depth = 0; depth < MOST_DEPTH; depth++) {
    const right = u >= 0.5 ? 1 : 0;
    const upper = v >= 0.5 ? 1 : 0;
    u = 2 * u - right; // exact
    v = 2 * v - upper;
    const { byte, below, first, coverage } = read(texels, quad, right + 2 * upper);
    if (byte === QUAD_FLAG) {
      quad = below;
      continue;
    }
    if (!byte) return 2 * coverage > COVERAGE_ONE;
    return winding(curvesOf(texels, byte, first), cornerOf(byte), LATTICE * u, LATTICE * v) > 0;
  }
  throw new VextureError(`quad ${quad} lies deeper than ${MOST_DEPTH} levels; read the file with readPacked`, `quad ${quad}`);
}

/**
 * Bounding box of a shape, rounded outwards to quads with a side of 1/256; x0 = x1 for an empty shape.
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @returns {[number, number, number, number]} x0 y0 x1 y1
 */
export function bounds(data, quad) {
  const { texels } = data;
  /** @type {[number, number, number, number]} */
  const box = [1, 1, 0, 0];
  /** @type {(quad: number, x: number, y: number, size: number, depth: number) => void} */
  const visit = (parent, x, y, side, depth) => {
    const size = side / 2;
    for (let k = 0; k < 4; k++) {
      const [left, low] = [x + size * (k & 1), y + size * (k >> 1)];
      if (left >= box[0] && low >= box[1] && left + size <= box[2] && low + size <= box[3]) continue;
      const { byte, below, first, coverage } = read(texels, parent, k);
      if (byte === QUAD_FLAG && depth < BOUNDS_DEPTH) visit(below, left, low, size, depth + 1);
      else if (byte || coverage) {
        const isLeaf = byte > 0 && byte !== QUAD_FLAG;
        const [x0, y0, x1, y1] = isLeaf ? filledBox(curvesOf(texels, byte, first), cornerOf(byte)) : [0, 0, 1, 1];
        box[0] = Math.min(box[0], left + size * x0);
        box[1] = Math.min(box[1], low + size * y0);
        box[2] = Math.max(box[2], left + size * x1);
        box[3] = Math.max(box[3], low + size * y1);
      }
    }
  };
  visit(quad, 0, 0, 1, 1);
  return box[0] < box[2] ? box : [0, 0, 0, 0];
}

/**
 * Number of quads and curves of a shape, and the depth of its deepest quad; the root has depth 0.
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @returns {{ quads: number, curves: number, depth: number }}
 */
export function counts(data, quad) {
  const { texels } = data;
  const found = { quads: 0, curves: 0, depth: -1 };
  for (let level = [quad]; level.length; ) {
    found.depth++;
    found.quads += level.length;
    /** @type {number[]} */
    const below = [];
    for (const parent of level) {
      for (let k = 0; k < 4; k++) {
        const leaf = read(texels, parent, k);
        if (leaf.byte === QUAD_FLAG) below.push(leaf.below);
        else found.curves += leaf.byte >> COUNT_SHIFT;
      }
    }
    level = below;
  }
  return found;
}
