// Contours, arrays of 8 numbers for each cubic: bounding boxes, affine maps, and lines.
import { isIdentity } from './affine.js';
import { sides, writeLine } from './arcs.js';

/**
 * @typedef {{ cubics: Float64Array, closed: boolean }} Outline consecutive cubics; `closed` if a stroke joins the last
 *   to the first
 */

/** @typedef {readonly [number, number, number, number]} Rectangle least x, least y, width and height */

/** @typedef {[number, number, number, number]} Bounds least x, least y, largest x and largest y */

/** Distance of an end from the start that is mere rounding, relative to the coordinates. */
const SAME = 1e-12;

/** A cubic is a rounded line if its inner points are this close to the thirds of its chord, relatively. */
const STRAIGHT = 1e-12;

/** @param {number} x @param {number} y @param {number} width @param {number} height @returns {Outline} */
export function rectangle(x, y, width, height) {
  const right = x + width;
  const bottom = y + height;
  return { cubics: sides([x, y, right, y, right, bottom, x, bottom], true), closed: true };
}

/** @param {Float64Array} cubics @returns {number} largest coordinate, without its sign; NaN if any is */
export function reachOf(cubics) {
  let reach = 0;
  for (const value of cubics) {
    if (!(Math.abs(value) <= reach)) reach = Math.abs(value);
    if (Number.isNaN(reach)) return reach;
  }
  return reach;
}

/** @param {Outline} outline @returns {Float64Array} contour to fill, closed by a straight line if necessary */
export function loopOf({ cubics }) {
  const n = cubics.length;
  const gap = Math.max(Math.abs(cubics[n - 2] - cubics[0]), Math.abs(cubics[n - 1] - cubics[1]));
  if (gap === 0) return cubics;
  if (gap <= SAME * reachOf(cubics)) {
    const copy = cubics.slice();
    [copy[n - 2], copy[n - 1]] = [copy[0], copy[1]];
    return copy;
  }
  const longer = new Float64Array(n + 8);
  longer.set(cubics);
  writeLine(longer, n, cubics[n - 2], cubics[n - 1], cubics[0], cubics[1]);
  return longer;
}

/** @param {Float64Array} cubics @param {import('./affine.js').Affine} matrix @returns {Float64Array} */
export function mapPoints(cubics, matrix) {
  if (isIdentity(matrix)) return cubics;
  const [a, b, c, d, e, f] = matrix;
  const moved = new Float64Array(cubics.length);
  for (let k = 0; k < cubics.length; k += 2) {
    moved[k] = a * cubics[k] + c * cubics[k + 1] + e;
    moved[k + 1] = b * cubics[k] + d * cubics[k + 1] + f;
  }
  return moved;
}

/**
 * Bounding box of curves, not of their control points.
 *
 * @param {readonly Float64Array[]} contours at least one, none empty
 * @returns {Bounds}
 */
export function boundsOf(contours) {
  /** @type {Bounds} */
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const cubics of contours) {
    for (let k = 0; k < cubics.length; k++) if (k % 8 < 2) widen(box, cubics, k, k % 8);
  }
  return box;
}

/** @param {Bounds} box @param {Float64Array} cubics @param {number} at @param {number} axis */
function widen(box, cubics, at, axis) {
  const [p0, p1, p2, p3] = [cubics[at], cubics[at + 2], cubics[at + 4], cubics[at + 6]];
  const take = (/** @type {number} */ value) => {
    if (value < box[axis]) box[axis] = value;
    if (value > box[axis + 2]) box[axis + 2] = value;
  };
  take(p0);
  take(p3);
  if (Math.min(p1, p2) >= Math.min(p0, p3) && Math.max(p1, p2) <= Math.max(p0, p3)) return;
  const [a, b, c] = [p3 - p0 + 3 * (p1 - p2), 2 * (p0 - 2 * p1 + p2), p1 - p0];
  const root = Math.sqrt(Math.max(b * b - 4 * a * c, 0));
  const q = -0.5 * (b + (b >= 0 ? root : -root));
  for (const [over, under] of [[q, a], [c, q]]) {
    const t = under === 0 ? 0 : Math.min(Math.max(over / under, 0), 1);
    const s = 1 - t;
    take(s * s * (s * p0 + 3 * t * p1) + t * t * (3 * s * p2 + t * p3));
  }
}

/** @param {Bounds} box @returns {Rectangle} */
export const rectangleOf = ([left, top, right, bottom]) => [left, top, right - left, bottom - top];

/**
 * @param {Float64Array} cubics
 * @param {number} at
 * @returns {boolean} whether the cubic there is a line as `writeLine` makes it
 */
export function isStraight(cubics, at) {
  let reach = 0;
  for (let k = at; k < at + 8; k++) reach = Math.max(reach, Math.abs(cubics[k]));
  for (let axis = at; axis < at + 2; axis++) {
    const chord = cubics[axis + 6] - cubics[axis];
    const first = Math.abs(cubics[axis + 2] - (cubics[axis] + chord / 3));
    const second = Math.abs(cubics[axis + 4] - (cubics[axis] + chord * (2 / 3)));
    if (!(Math.max(first, second) <= STRAIGHT * reach)) return false;
  }
  return true;
}

/** @param {Float64Array} cubics @returns {Float64Array} without those whose four points are one */
export function withoutPoints(cubics) {
  const kept = new Float64Array(cubics.length);
  let count = 0;
  for (let k = 0; k < cubics.length; k += 8) {
    let isPoint = true;
    for (let n = k + 2; n < k + 8; n++) isPoint &&= cubics[n] === cubics[k + (n % 2)];
    if (!isPoint) {
      kept.set(cubics.subarray(k, k + 8), count);
      count += 8;
    }
  }
  return kept.slice(0, count);
}

/** @param {readonly Float64Array[]} contours @returns {number} number of cubics */
export const countOf = (contours) => contours.reduce((sum, contour) => sum + contour.length / 8, 0);
