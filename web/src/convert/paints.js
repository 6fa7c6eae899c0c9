// Paints: flat colours, and gradients as in SVG; the form of Python's `vexture.drawing.paint`.
import { determinant, inverse } from './affine.js';

/** @typedef {[number, number, number]} Color red, green and blue, sRGB, 0..1 */

/** @typedef {[[number, number, number], [number, number, number]]} Rows rows of an affine map of (x, y, 1) */

/** @typedef {{ offset: number, color: Color, opacity: number }} Stop a colour at an offset of a ramp, 0..1 */

/**
 * @typedef {object} Gradient Colours along a ramp (SVG 2, 14.2).
 * @property {Rows} toRamp from the drawing's coordinates to those of the ramp
 * @property {Stop[]} stops one or more, with offsets that do not decrease
 * @property {number} spread 0 pads, 1 reflects, 2 repeats
 * @property {[number, number] | null} focus x of the focal point and focal radius of a radial gradient
 *
 * @typedef {{ color: Color, opacity: number, gradient: Gradient | null }} Paint a flat colour, or a gradient with its mean
 */

/** @type {Paint} */
export const BLACK = { color: [0, 0, 0], opacity: 1, gradient: null };

/** @param {Gradient} gradient @returns {Paint} its flat colour is the mean of the stops */
export function paintOfGradient(gradient) {
  const { stops } = gradient;
  const mean = (/** @type {(stop: Stop) => number} */ part) => stops.reduce((sum, stop) => sum + part(stop), 0) / stops.length;
  const color = /** @type {Color} */ ([0, 1, 2].map((k) => mean((stop) => stop.color[k])));
  return { color, opacity: mean((stop) => stop.opacity), gradient };
}

/**
 * @param {Paint} paint
 * @param {number} opacity
 * @returns {Paint} with its opacity, and those of all stops, multiplied
 */
export function fadePaint(paint, opacity) {
  if (opacity === 1) return paint;
  const { color, gradient } = paint;
  const stops = gradient?.stops.map((stop) => ({ ...stop, opacity: opacity * stop.opacity }));
  return { color, opacity: opacity * paint.opacity, gradient: gradient && stops ? { ...gradient, stops } : null };
}

/** @param {Paint} paint @param {Rows} rows from new coordinates to the old ones @returns {Paint} in the new ones */
export function movePaint(paint, rows) {
  return paint.gradient ? { ...paint, gradient: moveGradient(paint.gradient, rows) } : paint;
}

/** @param {Gradient} gradient @param {Rows} rows @returns {Gradient} */
export function moveGradient(gradient, [[a, b, c], [d, e, f]]) {
  const moved = gradient.toRamp.map(([p, q, r]) => [p * a + q * d, p * b + q * e, p * c + q * f + r]);
  return { ...gradient, toRamp: /** @type {Rows} */ (moved) };
}

/** @param {import('./affine.js').Affine} matrix @returns {Rows} */
export const rowsOf = ([a, b, c, d, e, f]) => [[a, c, e], [b, d, f]];

/** @param {import('./affine.js').Affine} matrix @param {number} smallest determinant */
export function isSingular(matrix, smallest) {
  const size = Math.abs(determinant(matrix));
  return !(smallest <= size && size <= 1 / smallest);
}

/**
 * @param {Gradient} gradient
 * @param {import('./affine.js').Affine} matrix from its coordinates to those of the drawing
 */
export const paintInDrawing = (gradient, matrix) => paintOfGradient(moveGradient(gradient, rowsOf(inverse(matrix))));
