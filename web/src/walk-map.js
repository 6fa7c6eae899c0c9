// The colours of a validated planar map on the CPU (FORMAT.md, D.6, D.7). Plain data, without three.js.
import { COUNT_SHIFT, COVERAGE_ONE, IS_MEAN, LATTICE, MOST_DEPTH, PAINT_ONE, QUAD_FLAG } from '../generated/layout.js';
import { VextureError } from './errors.js';
import { curvesOf, leafOf } from './leaf.js';
import { basePaint, headOf, meanBytes, paintSteps, sidesOf } from './planar-map.js';
import { programColor, programOf } from './programs.js';
import { WHOLE, filledBox, isAtOrLeft } from './winding.js';

/**
 * @typedef {import('./data.js').PackedData} PackedData
 * @typedef {import('./planar-map.js').Color} Color
 *
 * @typedef {object} Painted What is at a point of a planar map.
 * @property {number | null} paint its number in the map's table; null where only a mean colour is known, in slivers as
 *   narrow as the rounding, and outside of the unit square
 * @property {[number, number, number, number]} color premultiplied sRGB and opacity, 0..1
 *
 * @typedef {object} MapLeaf A leaf of a map, with its paints.
 * @property {number[][]} curves in its lattice units
 * @property {[number, number][]} sides paints on the left and right of each curve
 * @property {number} base its base paint
 */

/** @type {Readonly<Painted>} */
const NOTHING = Object.freeze({ paint: null, color: /** @type {Color} */ ([0, 0, 0, 0]) });

/** @param {Color} color @param {number} one */
const scaled = (color, one) => /** @type {Color} */ (color.map((part) => part / one));

/**
 * Colour of a paint at a point: premultiplied sRGB and opacity, 0..1.
 *
 * @param {PackedData} data
 * @param {number} quad index of the map's root quad
 * @param {number} paint
 * @param {number} u of the unit square
 * @param {number} v upwards
 */
export function paintColor({ texels }, quad, paint, u, v) {
  const head = headOf(texels, quad);
  const program = programOf(texels, head, paint);
  return program ? programColor(texels, program, u, v) : scaled(paintSteps(texels, head, paint), PAINT_ONE);
}

/**
 * Whether anything is seen of a paint, or may be, as it holds gradients.
 *
 * @param {PackedData} data
 * @param {number} quad index of the map's root quad
 * @param {number} paint
 */
function isSeen({ texels }, quad, paint) {
  const head = headOf(texels, quad);
  return programOf(texels, head, paint) !== null || paintSteps(texels, head, paint)[3] > 0;
}

/**
 * Mean colour of a cell: premultiplied sRGB and opacity, 0..1.
 *
 * @param {PackedData} data
 * @param {number} root index of the map's root quad
 * @param {number} quad that holds the cell
 * @param {number} cell
 */
function meanColor({ texels }, root, quad, cell) {
  return scaled(meanBytes(texels, headOf(texels, root), quad, cell), COVERAGE_ONE);
}

/**
 * Mean colour of a map: premultiplied sRGB and opacity, 0..1.
 *
 * @param {PackedData} data
 * @param {number} quad index of its root quad
 */
export function meanOfRoot(data, quad) {
  const mean = /** @type {Color} */ ([0, 0, 0, 0]);
  for (let k = 0; k < 4; k++) meanColor(data, quad, quad, k).forEach((part, i) => (mean[i] += part / 4));
  return mean;
}

/**
 * The paints and curves of a leaf, in lattice units.
 *
 * @param {PackedData} data
 * @param {number} root index of the map's root quad
 * @param {number} quad that holds the leaf
 * @param {number} cell
 * @returns {MapLeaf}
 */
function mapLeaf({ texels }, root, quad, cell) {
  const head = headOf(texels, root);
  const leaf = leafOf(texels, quad, cell, true);
  const sides = Array.from({ length: leaf.byte >> COUNT_SHIFT }, (_, i) => sidesOf(texels, head, leaf.number + i));
  return { curves: curvesOf(texels, leaf), sides, base: basePaint(texels, head, quad, cell) };
}

/**
 * How often each paint counts at a point of a leaf; those that count 0 are left out.
 *
 * @param {MapLeaf} leaf
 * @param {number} x
 * @param {number} y in its lattice units
 * @returns {Map<number, number>}
 */
function paintCounts({ curves, sides, base }, x, y) {
  const counts = new Map([[base, 1]]);
  const add = (/** @type {number} */ paint, /** @type {number} */ more) => {
    const count = (counts.get(paint) ?? 0) + more;
    if (count) counts.set(paint, count);
    else counts.delete(paint);
  };
  curves.forEach((curve, i) => {
    const [x0, y0, , , , , x3, y3] = curve;
    let more = 0;
    if (x0 === 0 && y0 <= y) more++;
    if (x3 === 0 && y3 <= y) more--;
    if (y0 <= y && y < y3 && isAtOrLeft(curve, x, y)) more--;
    if (!more) return;
    add(sides[i][0], more);
    add(sides[i][1], -more);
  });
  return counts;
}

/**
 * Paints of a cell.
 *
 * @param {PackedData} data
 * @param {number} root index of the map's root quad
 * @param {number} quad that holds the cell
 * @param {number} cell
 * @param {number} byte of the cell
 * @returns {import('./walk.js').CellPaints}
 */
export function cellPaints(data, root, quad, cell, byte) {
  const mean = meanColor(data, root, quad, cell);
  if (byte === QUAD_FLAG || byte === IS_MEAN) return { mean, base: null, sides: [] };
  const { base, sides } = mapLeaf(data, root, quad, cell);
  return { mean, base, sides };
}

/**
 * Bounding box of the painted part of a leaf, in its own unit square; null if nothing is seen.
 *
 * @param {PackedData} data
 * @param {number} root index of the map's root quad
 * @param {number} quad that holds the leaf
 * @param {number} cell
 */
export function paintedBox(data, root, quad, cell) {
  const { byte } = leafOf(data.texels, quad, cell, true);
  if (byte === IS_MEAN) return meanColor(data, root, quad, cell)[3] > 0 ? WHOLE : null;
  const leaf = mapLeaf(data, root, quad, cell);
  const seen = (/** @type {number} */ paint) => isSeen(data, root, paint);
  if (!(byte >> COUNT_SHIFT)) return seen(leaf.base) ? WHOLE : null;
  return filledBox(leaf.curves, seen(leaf.base), (x, y) => [...paintCounts(leaf, x, y).keys()].some(seen));
}

/**
 * The paint and colour at a point of the unit square (FORMAT.md, D.7).
 *
 * @param {PackedData} data
 * @param {number} quad index of the map's root quad
 * @param {number} u
 * @param {number} v upwards
 * @returns {Painted}
 */
export function paintAt(data, quad, u, v) {
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return { ...NOTHING };
  const { texels } = data;
  const point = /** @type {[number, number]} */ ([u, v]);
  let parent = quad;
  for (let depth = 0; depth < MOST_DEPTH; depth++) {
    const right = u >= 0.5 ? 1 : 0;
    const upper = v >= 0.5 ? 1 : 0;
    u = 2 * u - right; // exact
    v = 2 * v - upper;
    const cell = right + 2 * upper;
    const { byte, below } = leafOf(texels, parent, cell, true);
    if (byte === QUAD_FLAG) parent = below;
    else if (byte === IS_MEAN) return { paint: null, color: meanColor(data, quad, parent, cell) };
    else return summed(data, quad, paintCounts(mapLeaf(data, quad, parent, cell), LATTICE * u, LATTICE * v), point);
  }
  throw new VextureError(`quad ${parent} lies deeper than ${MOST_DEPTH} levels; read the file with readPacked`, 'quad');
}

/**
 * What paints add up to, held in its range.
 *
 * @param {PackedData} data
 * @param {number} quad index of the map's root quad
 * @param {Map<number, number>} counts
 * @param {[number, number]} point
 * @returns {Painted}
 */
function summed(data, quad, counts, [u, v]) {
  const sum = /** @type {Color} */ ([0, 0, 0, 0]);
  for (const [paint, count] of counts) {
    paintColor(data, quad, paint, u, v).forEach((part, k) => (sum[k] += count * part));
  }
  const [[paint, count] = [null, 0]] = counts;
  const opacity = Math.min(Math.max(sum[3], 0), 1);
  const held = sum.slice(0, 3).map((part) => Math.min(Math.max(part, 0), opacity));
  return { paint: counts.size === 1 && count === 1 ? paint : null, color: /** @type {Color} */ ([...held, opacity]) };
}
