// Clip contours to a box without changing any winding number inside it, as Python's `vexture.bezier.clip` does.
import { withoutPoints } from './contours.js';

/** A cut nearer than this to an end of a cubic would make a piece too short to have a direction. */
const PARAMETER = 1e-9;
const BISECTIONS = 60;

/**
 * Clip a closed contour to a box. No end point leaves the box, and cut points lie exactly on it.
 *
 * @param {Float64Array} contour
 * @param {readonly number[]} low
 * @param {readonly number[]} high
 * @returns {Float64Array} empty if only lines along one side are left
 */
export function clipContour(contour, low, high) {
  let clipped = contour;
  for (let axis = 0; axis < 2; axis++) {
    for (const [bound, side] of [[low[axis], 1], [high[axis], -1]]) {
      if (isBeyond(clipped, axis, bound, side)) clipped = withoutPoints(cutToSide(clipped, axis, bound, side));
    }
  }
  let own = clipped === contour ? null : clipped;
  for (let k = 0; k < clipped.length; k++) {
    const axis = k % 2;
    if (k % 8 > 1 && k % 8 < 6) continue;
    const value = Math.min(Math.max(clipped[k], low[axis]), high[axis]);
    if (value !== clipped[k]) (own ??= clipped.slice())[k] = value;
  }
  return own ?? clipped;
}

/** @param {Float64Array} contour @param {number} axis @param {number} bound @param {number} side */
function isBeyond(contour, axis, bound, side) {
  for (let k = axis; k < contour.length; k += 2) if ((contour[k] - bound) * side < 0) return true;
  return false;
}

/**
 * @param {Float64Array} contour
 * @param {number} axis
 * @param {number} bound
 * @param {number} side
 * @returns {Float64Array}
 */
function cutToSide(contour, axis, bound, side) {
  const pieces = /** @type {number[]} */ ([]);
  let inShadow = false;
  for (let k = 0; k < contour.length; k += 8) {
    const curve = contour.subarray(k, k + 8);
    const cuts = crossings(curve, axis, bound);
    let point = [curve[0], curve[1]];
    for (let n = 0; n + 1 < cuts.length; n++) {
      const piece = subcubic(curve, cuts[n], cuts[n + 1]);
      [piece[0], piece[1]] = point;
      if (n === cuts.length - 2) [piece[6], piece[7]] = [curve[6], curve[7]];
      else piece[6 + axis] = bound;
      point = [piece[6], piece[7]];
      const middle = cubicAt(piece[axis], piece[2 + axis], piece[4 + axis], piece[6 + axis], 0.5);
      if ((piece[axis] + middle + piece[6 + axis] - 3 * bound) * side >= 0) {
        inShadow = false;
        pieces.push(...piece);
        continue;
      }
      if (inShadow) {
        const last = pieces.splice(-8);
        [last[6], last[7]] = point;
        piece.splice(0, 8, ...last);
      }
      shadow(piece, axis, bound);
      inShadow = true;
      pieces.push(...piece);
    }
  }
  return Float64Array.from(pieces);
}

/** @param {number} p0 @param {number} p1 @param {number} p2 @param {number} p3 @param {number} t */
function cubicAt(p0, p1, p2, p3, t) {
  const s = 1 - t;
  return s * s * (s * p0 + 3 * t * p1) + t * t * (3 * s * p2 + t * p3);
}

/**
 * @param {Float64Array} curve
 * @param {number} axis
 * @param {number} bound
 * @returns {number[]} 0, the parameters on the line, 1
 */
function crossings(curve, axis, bound) {
  const turns = turningPoints(curve[axis], curve[2 + axis], curve[4 + axis], curve[6 + axis]);
  const cuts = [0];
  let start = 0;
  for (const end of [...turns, 1]) {
    const part = subcubic(curve, start, end);
    const [p0, p1, p2, p3] = [part[axis], part[2 + axis], part[4 + axis], part[6 + axis]];
    if ((p0 - bound) * (p3 - bound) < 0) cuts.push(start + (end - start) * solveMonotone(p0, p1, p2, p3, bound));
    start = end;
  }
  return [...cuts, 1];
}

/** @param {number[]} piece @param {number} axis @param {number} bound */
function shadow(piece, axis, bound) {
  const free = 1 - axis;
  const chord = piece[6 + free] - piece[free];
  piece[2 + free] = piece[free] + chord / 3;
  piece[4 + free] = piece[free] + chord * (2 / 3);
  for (let k = axis; k < 8; k += 2) piece[k] = bound;
}

/**
 * @param {Float64Array} curve
 * @param {number} t0
 * @param {number} t1
 * @returns {number[]} the part between two parameters
 */
function subcubic(curve, t0, t1) {
  const out = new Array(8);
  const s0 = 1 - t0;
  const s1 = 1 - t1;
  for (let axis = 0; axis < 2; axis++) {
    const [p0, p1, p2, p3] = [curve[axis], curve[2 + axis], curve[4 + axis], curve[6 + axis]];
    const [a0, b0, c0] = [s0 * p0 + t0 * p1, s0 * p1 + t0 * p2, s0 * p2 + t0 * p3];
    const [a1, b1, c1] = [s1 * p0 + t1 * p1, s1 * p1 + t1 * p2, s1 * p2 + t1 * p3];
    const [d00, e00] = [s0 * a0 + t0 * b0, s0 * b0 + t0 * c0];
    const [d11, e11] = [s1 * a1 + t1 * b1, s1 * b1 + t1 * c1];
    out[axis] = s0 * d00 + t0 * e00;
    out[2 + axis] = s1 * d00 + t1 * e00;
    out[4 + axis] = s0 * d11 + t0 * e11;
    out[6 + axis] = s1 * d11 + t1 * e11;
  }
  return out;
}

/**
 * @param {number} p0
 * @param {number} p1
 * @param {number} p2
 * @param {number} p3
 * @returns {number[]} where a coordinate turns
 */
function turningPoints(p0, p1, p2, p3) {
  const a = 3 * (p3 - p0 + 3 * (p1 - p2));
  const b = 6 * (p0 - 2 * p1 + p2);
  const c = 3 * (p1 - p0);
  const discriminant = b * b - 4 * a * c;
  if (!(discriminant > 0)) return [];
  const root = Math.sqrt(discriminant);
  const q = -0.5 * (b + (b >= 0 ? root : -root));
  const found = [];
  if (a !== 0) found.push(q / a);
  if (q !== 0) found.push(c / q);
  return found.filter((t) => t > PARAMETER && t < 1 - PARAMETER).sort((t, u) => t - u);
}

/**
 * Parameter at which a coordinate that is monotone on [0, 1] takes a value between p0 and p3: Newton's method in a bracket.
 *
 * @param {number} p0
 * @param {number} p1
 * @param {number} p2
 * @param {number} p3
 * @param {number} value
 */
function solveMonotone(p0, p1, p2, p3, value) {
  if (value === p0) return 0;
  if (value === p3) return 1;
  const isRising = p3 > p0;
  const [k3, k2, k1, k0] = [p3 - p0 + 3 * (p1 - p2), 3 * (p0 - 2 * p1 + p2), 3 * (p1 - p0), p0 - value];
  let low = 0;
  let high = 1;
  let t = Math.min(Math.max((value - p0) / (p3 - p0), 0), 1);
  for (let n = 0; n < BISECTIONS; n++) {
    const f = ((k3 * t + k2) * t + k1) * t + k0;
    if (f > 0 === isRising) high = t;
    else low = t;
    const slope = (3 * k3 * t + 2 * k2) * t + k1;
    let step = slope !== 0 ? t - f / slope : -1;
    if (!(low < step && step < high)) step = 0.5 * (low + high);
    if (Math.abs(step - t) <= 1e-15) return step;
    t = step;
  }
  return t;
}
