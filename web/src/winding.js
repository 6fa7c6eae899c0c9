// Winding numbers of a leaf at a point, counted from the curves at or left of it. A cubic is x0 y0 x1 y1 x2 y2 x3 y3.
import { LATTICE } from '../generated/layout.js';

/** Bisections of the interval of t, one for each bit of a float64's significand. */
const HALVINGS = 53;

/** The unit square as a box: x0 y0 x1 y1. */
export const WHOLE = Object.freeze([0, 0, 1, 1]);

/**
 * @param {number[]} cubic
 * @param {number} axis 0 for x, 1 for y
 * @param {number} t
 */
function cubicAt(cubic, axis, t) {
  const s = 1 - t;
  return (
    s * s * (s * cubic[axis] + 3 * t * cubic[axis + 2]) + t * t * (3 * s * cubic[axis + 4] + t * cubic[axis + 6])
  );
}

/**
 * x of a cubic at a height between its ends. The cubic is monotone in y up to rounding.
 *
 * @param {number[]} cubic
 * @param {number} y
 */
export function xAt(cubic, y) {
  if (y === cubic[1]) return cubic[0];
  if (y === cubic[7]) return cubic[6];
  const rising = cubic[7] > cubic[1];
  let [low, high] = [0, 1];
  for (let i = 0; i < HALVINGS; i++) {
    const t = (low + high) / 2;
    if (cubicAt(cubic, 1, t) > y === rising) high = t;
    else low = t;
  }
  return cubicAt(cubic, 0, (low + high) / 2);
}

/**
 * Whether a curve is at or left of a point at the point's height, which lies between its ends.
 *
 * @param {number[]} curve
 * @param {number} x
 * @param {number} y
 */
export function isAtOrLeft(curve, x, y) {
  const [x0, , , , , , x3] = curve;
  return Math.max(x0, x3) <= x || (Math.min(x0, x3) <= x && xAt(curve, y) <= x);
}

/**
 * Winding number at a point of a packed leaf (FORMAT.md, B.6).
 *
 * @param {number[][]} curves of the leaf, in its lattice units
 * @param {number} corner winding number at its lower left corner
 * @param {number} x
 * @param {number} y
 */
export function winding(curves, corner, x, y) {
  let sum = corner;
  for (const curve of curves) {
    const [x0, y0, , , , , x3, y3] = curve;
    if (x0 === 0 && y0 <= y) sum++;
    if (x3 === 0 && y3 <= y) sum--;
    if (Math.min(y0, y3) > y || y >= Math.max(y0, y3)) continue;
    if (isAtOrLeft(curve, x, y)) sum += y3 > y0 ? -1 : 1;
  }
  return sum;
}

/**
 * Bounding box of the filled part of a packed leaf, in its own unit square; it may be larger by a lattice unit.
 *
 * Outside the bounding box of the curves' ends, what is to the left and below is as in the corner; what is above is all
 * alike; to the right it changes only at the heights of ends.
 *
 * @param {number[][]} curves of the leaf, in its lattice units
 * @param {boolean} isCornerFilled what is at its lower left corner, without the curves that start or end there
 * @param {(x: number, y: number) => boolean} isFilled
 * @returns {[number, number, number, number]} x0 y0 x1 y1
 */
export function filledBox(curves, isCornerFilled, isFilled) {
  const xs = curves.flatMap((curve) => [curve[0], curve[6]]).sort((one, other) => one - other);
  const ys = curves.flatMap((curve) => [curve[1], curve[7]]).sort((one, other) => one - other);
  const last = ys.length - 1;
  const left = isCornerFilled && xs[0] > 0;
  const below = isCornerFilled && ys[0] > 0;
  const above = ys[last] < LATTICE && isFilled(LATTICE, LATTICE);
  const right = ys.some((y, i) => y < ys[i + 1] && isFilled(LATTICE, (y + ys[i + 1]) / 2));
  const low = (/** @type {number} */ at) => Math.max(0, at - 1) / LATTICE; // curves are monotone up to rounding
  const high = (/** @type {number} */ at) => Math.min(LATTICE, at + 1) / LATTICE;
  return [
    left || below || above ? 0 : low(xs[0]),
    left || below ? 0 : low(ys[0]),
    below || above || right ? 1 : high(xs[last]),
    left || above ? 1 : high(ys[last]),
  ];
}
