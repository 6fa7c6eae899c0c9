// The normal form: contours in the unit square, y up, clipped to the drawing's box.
import { CLOSED, FARTHEST } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { inverse, multiply } from './affine.js';
import { writeLine } from './arcs.js';
import { clipContour } from './clip.js';
import { isStraight, reachOf } from './contours.js';
import { exponential } from './lengths.js';
import { movePaint, rowsOf } from './paints.js';

/** @typedef {import('./painter.js').Path} Path */

/**
 * Bring paths in pixels, y down, into the normal form.
 *
 * @param {Path[]} paths
 * @param {readonly [number, number]} sides of the drawing, in pixels
 * @param {import('./pace.js').Pace} [pace]
 * @returns {import('./pace.js').Steps<{ paths: Path[], toSource: import('./affine.js').Affine, sides: [number, number] }>}
 */
export function* inUnitSquare(paths, [width, height], pace) {
  const size = Math.max(width, height);
  if (!(Math.min(width, height) > 0 && Number.isFinite(size) && Number.isFinite(1 / size))) {
    const text = `the drawing's box is ${exponential(width)} x ${exponential(height)}; both must be above 0`;
    throw new VextureError(text, 'viewBox');
  }
  /** @type {import('./affine.js').Affine} */
  const toSource = [size, 0, 0, -size, -(size - width) / 2, height + (size - height) / 2];
  /** @type {[number, number]} */
  const sides = [width / size, height / size];
  const low = sides.map((side) => (1 - side) / 2);
  const high = low.map((value) => 1 - value);
  const rows = rowsOf(toSource);
  const placed = [];
  for (const path of paths) {
    if (pace?.isDue()) yield;
    placed.push(path.contours.map((contour) => placeContour(contour, size, low)));
  }
  checkReach(placed.flat());
  const normal = [];
  for (const [k, path] of paths.entries()) {
    if (pace?.isDue()) yield;
    const contours = placed[k].map((contour) => tidyContour(cutContour(contour, low, high))).filter((one) => one.length);
    if (contours.length) normal.push({ ...path, contours, paint: movePaint(path.paint, rows) });
  }
  return { paths: normal, toSource, sides };
}

/** @param {Float64Array} contour @param {number} size @param {number[]} low @returns {Float64Array} */
function placeContour(contour, size, low) {
  return contour.map((value, k) => (k % 2 ? 1 - (value / size + low[1]) : value / size + low[0]));
}

/** @param {Float64Array[]} contours @throws {VextureError} if one is too far away */
function checkReach(contours) {
  const reach = contours.reduce((most, contour) => Math.max(most, reachOf(contour)), 0);
  if (reach <= FARTHEST) return;
  const text = `a coordinate is ${exponential(reach)} times the size of the drawing away; the limit is ${exponential(FARTHEST)}`;
  throw new VextureError(`${text}; correct the coordinate or the view box`, 'coordinate');
}

/** @param {Float64Array} contour @param {number[]} low @param {number[]} high @returns {Float64Array} */
function cutContour(contour, low, high) {
  const isOutside = contour.some((value, k) => Math.max(low[k % 2] - value, value - high[k % 2]) > CLOSED);
  const cut = isOutside ? clipContour(contour, low, high).slice() : contour;
  for (let k = 0; k < cut.length; k++) {
    if (k % 8 < 2 || k % 8 > 5) cut[k] = Math.min(Math.max(cut[k], low[k % 2]), high[k % 2]);
  }
  return cut;
}

/**
 * @param {Float64Array} contour
 * @returns {Float64Array} without cubics of zero length, closed bit for bit, with exact lines; empty if it encloses
 *   nothing
 */
function tidyContour(contour) {
  const kept = [];
  for (let k = 0; k < contour.length; k += 8) {
    let reach = 0;
    for (let n = k; n < k + 8; n++) reach = Math.max(reach, Math.abs(contour[n] - contour[k + (n % 2)]));
    if (reach > CLOSED) kept.push(...contour.subarray(k, k + 8));
  }
  const tidy = Float64Array.from(kept);
  let isBent = false;
  for (let k = 0; k < tidy.length; k += 8) {
    const end = (k || tidy.length) - 2;
    [tidy[k], tidy[k + 1]] = [tidy[end], tidy[end + 1]];
    if (isStraight(tidy, k)) writeLine(tidy, k, tidy[k], tidy[k + 1], tidy[k + 6], tidy[k + 7]);
    else isBent = true;
  }
  return tidy.length > 16 || isBent ? tidy : tidy.slice(0, 0); // two straight sides enclose nothing
}

/**
 * @param {import('./affine.js').Affine} toPixels
 * @param {import('./affine.js').Affine} content
 * @returns {import('./affine.js').Affine} to user units
 */
export const toUserUnits = (toPixels, content) => multiply(inverse(content), toPixels);
