// Descends the trees of a validated packed texture on the CPU: the cell at a point, containment, bounds, counts.
// Plain data, without three.js.
import { COUNT_SHIFT, COVERAGE_ONE, LATTICE, MOST_DEPTH, QUAD_FLAG, WINDING_OFFSET } from '../generated/layout.js';
import { VextureError, unfit } from './errors.js';
import { curvesOf, leafOf } from './leaf.js';
import { mapParts } from './maps.js';
import { WHOLE, filledBox, winding } from './winding.js';

/** @typedef {import('./data.js').PackedData} PackedData */

const WINDING_MASK = (1 << COUNT_SHIFT) - 1;

/** Largest depth of `bounds`: quads with a side of 1/256 count as full. */
const BOUNDS_DEPTH = 8;

/** Paint of a silhouette. */
export const BLACK = Object.freeze({ color: Object.freeze([0, 0, 0]), opacity: 1 });

/**
 * @typedef {object} Cell Part of a quad-tree at a point.
 * @property {number} depth 0 is the unit square; a cell of depth d has the side 2^-d
 * @property {number} x of its lower left corner, in the unit square
 * @property {number} y of its lower left corner, upwards
 * @property {number} size of its side
 * @property {boolean} isQuad whether it is divided further
 * @property {number} coverage stored, 0..1; of a planar map the mean opacity
 * @property {number} winding corner winding of a leaf with curves; 0 elsewhere
 * @property {number[][]} curves of a leaf: x0 y0 x1 y1 x2 y2 x3 y3 each, in units of the unit square
 * @property {number} quad index of the quad that holds it
 * @property {number} cell 0 to 3, its place there: (right half) + 2 (upper half); -1 for the unit square itself
 * @property {CellPaints | null} paints of a cell of a planar map; null elsewhere
 *
 * @typedef {object} CellPaints The paints of a cell of a planar map.
 * @property {[number, number, number, number]} mean mean colour: premultiplied sRGB and opacity, 0..1
 * @property {number | null} base number of its base paint; null of a quad, and where only the mean is known
 * @property {[number, number][]} sides numbers of the paints on the left and on the right of each curve
 */

/**
 * Root quads of the planar maps of a texture.
 *
 * @type {WeakMap<PackedData, Set<number>>}
 */
const MAPS = new WeakMap();

/**
 * @template {import('./data.js').TextureData} T
 * @param {T} data
 * @returns {T}
 * @throws {VextureError} if it is no data of a texture
 */
export function checkData(data) {
  if (Array.isArray(data?.roots)) return data;
  throw unfit('data', data, 'give what readPacked returns, or load a texture by VectorTextureLoader');
}

/**
 * Whether a shape is a planar map.
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 */
export function isMap(data, quad) {
  let maps = MAPS.get(data);
  if (!maps) {
    maps = new Set(checkData(data).roots.filter((root) => root.isMap).map((root) => root.quad));
    MAPS.set(data, maps);
  }
  return maps.has(quad);
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
  const ofMap = isMap(data, quad);
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return null;
  const { texels } = data;
  if (mostDepth < 1) return top(data, quad, ofMap);
  const root = quad;
  let [x, y, size, depth] = [0, 0, 1, 0];
  for (;;) {
    size /= 2;
    depth++;
    const right = u >= x + size ? 1 : 0;
    const upper = v >= y + size ? 1 : 0;
    x += size * right; // exact: a multiple of 2^-20
    y += size * upper;
    const cell = right + 2 * upper;
    const leaf = leafOf(texels, quad, cell, ofMap);
    const isQuad = leaf.byte === QUAD_FLAG;
    if (isQuad && depth < mostDepth) {
      quad = leaf.below;
      continue;
    }
    const scale = size / LATTICE;
    const curves = isQuad
      ? []
      : curvesOf(texels, leaf).map((curve) => curve.map((at, axis) => at * scale + (axis % 2 ? y : x)));
    const corner = curves.length && !ofMap ? cornerOf(leaf.byte) : 0;
    const paints = ofMap ? mapParts().cellPaints(data, root, quad, cell, leaf.byte) : null;
    const coverage = paints ? paints.mean[3] : leaf.coverage / COVERAGE_ONE;
    return { depth, x, y, size, isQuad, coverage, winding: corner, curves, quad, cell, paints };
  }
}

/**
 * The unit square as a cell.
 *
 * @param {PackedData} data
 * @param {number} quad
 * @param {boolean} ofMap
 * @returns {Cell}
 */
function top(data, quad, ofMap) {
  const paints = ofMap ? { mean: mapParts().meanOfRoot(data, quad), base: null, sides: [] } : null;
  let coverage = paints ? paints.mean[3] : 0;
  for (let k = 0; k < 4 && !ofMap; k++) coverage += leafOf(data.texels, quad, k, false).coverage / 4 / COVERAGE_ONE;
  return { depth: 0, x: 0, y: 0, size: 1, isQuad: true, coverage, winding: 0, curves: [], quad, cell: -1, paints };
}

/**
 * Whether a point is inside a shape, computed from the stored outlines (FORMAT.md, B.6); of a planar map, whether
 * anything is painted there (D.7).
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @param {number} u
 * @param {number} v upwards
 * @returns {boolean}
 */
export function contains(data, quad, u, v) {
  if (isMap(data, quad)) return paintAt(data, quad, u, v).color[3] > 0;
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return false;
  const { texels } = data;
  for (let depth = 0; depth < MOST_DEPTH; depth++) {
    const right = u >= 0.5 ? 1 : 0;
    const upper = v >= 0.5 ? 1 : 0;
    u = 2 * u - right; // exact
    v = 2 * v - upper;
    const leaf = leafOf(texels, quad, right + 2 * upper, false);
    if (leaf.byte === QUAD_FLAG) {
      quad = leaf.below;
      continue;
    }
    if (!leaf.byte) return 2 * leaf.coverage > COVERAGE_ONE;
    return winding(curvesOf(texels, leaf), cornerOf(leaf.byte), LATTICE * u, LATTICE * v) > 0;
  }
  throw new VextureError(`quad ${quad} lies deeper than ${MOST_DEPTH} levels; read the file with readPacked`, `quad ${quad}`);
}

/**
 * The paint and colour at a point of the unit square of a planar map (FORMAT.md, D.7).
 *
 * @param {PackedData} data
 * @param {number} quad index of the map's root quad
 * @param {number} u
 * @param {number} v upwards
 * @returns {import('./walk-map.js').Painted}
 */
export function paintAt(data, quad, u, v) {
  checkData(data);
  return mapParts().paintAt(data, quad, u, v);
}

/**
 * Colour of some layers at a point, composited in sRGB, as in browsers.
 *
 * @param {PackedData} data
 * @param {import('./data.js').Root[]} layers the lowest first
 * @param {number} u
 * @param {number} v upwards
 * @returns {import('./data.js').RootPaint}
 */
export function colorAt(data, layers, u, v) {
  const sum = [0, 0, 0, 0];
  for (const { quad, paint, isMap: ofMap } of layers) {
    const { color, opacity } = paint ?? BLACK;
    const isInside = !ofMap && contains(data, quad, u, v);
    const shown = ofMap ? paintAt(data, quad, u, v).color
      : isInside ? [...color.map((part) => part * opacity), opacity] : [0, 0, 0, 0];
    const below = 1 - shown[3];
    shown.forEach((part, k) => (sum[k] = part + below * sum[k]));
  }
  const opacity = sum[3];
  const [red, green, blue] = sum.map((part) => (opacity ? Math.min(part / opacity, 1) : 0));
  return { color: [red, green, blue], opacity };
}

/**
 * Bounding box of a shape, rounded outwards to quads with a side of 1/256; x0 = x1 for an empty shape.
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @returns {[number, number, number, number]} x0 y0 x1 y1
 */
export function bounds(data, quad) {
  const ofMap = isMap(data, quad);
  const { texels } = data;
  const boxOf = ofMap ? mapParts().paintedBox : coveredBox;
  /** @type {[number, number, number, number]} */
  const box = [1, 1, 0, 0];
  /** @type {(quad: number, x: number, y: number, size: number, depth: number) => void} */
  const visit = (parent, x, y, side, depth) => {
    const size = side / 2;
    for (let k = 0; k < 4; k++) {
      const [left, low] = [x + size * (k & 1), y + size * (k >> 1)];
      if (left >= box[0] && low >= box[1] && left + size <= box[2] && low + size <= box[3]) continue;
      const { byte, below } = leafOf(texels, parent, k, ofMap);
      if (byte === QUAD_FLAG && depth < BOUNDS_DEPTH) {
        visit(below, left, low, size, depth + 1);
        continue;
      }
      const found = byte === QUAD_FLAG ? WHOLE : boxOf(data, quad, parent, k);
      if (!found) continue;
      box[0] = Math.min(box[0], left + size * found[0]);
      box[1] = Math.min(box[1], low + size * found[1]);
      box[2] = Math.max(box[2], left + size * found[2]);
      box[3] = Math.max(box[3], low + size * found[3]);
    }
  };
  visit(quad, 0, 0, 1, 1);
  return box[0] < box[2] ? box : [0, 0, 0, 0];
}

/**
 * Bounding box of the filled part of a leaf, in its own unit square; null if it is empty.
 *
 * @param {PackedData} data
 * @param {number} _root
 * @param {number} quad that holds it
 * @param {number} cell
 */
function coveredBox({ texels }, _root, quad, cell) {
  const leaf = leafOf(texels, quad, cell, false);
  if (!leaf.byte) return leaf.coverage ? WHOLE : null;
  const [curves, corner] = [curvesOf(texels, leaf), cornerOf(leaf.byte)];
  return filledBox(curves, corner > 0, (x, y) => winding(curves, corner, x, y) > 0);
}

/**
 * Number of quads and curves of a shape, and the depth of its deepest quad; the root has depth 0.
 *
 * @param {PackedData} data
 * @param {number} quad index of the shape's root quad
 * @returns {{ quads: number, curves: number, depth: number }}
 */
export function counts(data, quad) {
  const ofMap = isMap(data, quad);
  const { texels } = data;
  const found = { quads: 0, curves: 0, depth: -1 };
  for (let level = [quad]; level.length; ) {
    found.depth++;
    found.quads += level.length;
    /** @type {number[]} */
    const below = [];
    for (const parent of level) {
      for (let k = 0; k < 4; k++) {
        const leaf = leafOf(texels, parent, k, ofMap);
        if (leaf.byte === QUAD_FLAG) below.push(leaf.below);
        else found.curves += leaf.byte >> COUNT_SHIFT;
      }
    }
    level = below;
  }
  return found;
}
