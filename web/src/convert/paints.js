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
 * @typedef {object} Picture Pixels as a paint; beyond its border the colours at the border continue.
 * @property {Rows} toPixels from the drawing's coordinates to columns and rows
 * @property {import('./decode-picture.js').Pixels} pixels shown ones
 * @property {number} sampling 0 for squares, 1 for linear interpolation between the centres of pixels
 * @property {number} opacity factor of all pixels
 *
 * @typedef {{ color: Color, opacity: number, gradient: Gradient | null, picture?: Picture | null }} Paint a flat colour, or a
 *   gradient or picture with its mean
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
  const { color, gradient, picture } = paint;
  if (picture) return { ...paint, opacity: opacity * paint.opacity, picture: { ...picture, opacity: opacity * picture.opacity } };
  const stops = gradient?.stops.map((stop) => ({ ...stop, opacity: opacity * stop.opacity }));
  return { color, opacity: opacity * paint.opacity, gradient: gradient && stops ? { ...gradient, stops } : null };
}

/** @param {Paint} paint @param {Rows} rows from new coordinates to the old ones @returns {Paint} in the new ones */
export function movePaint(paint, rows) {
  const { picture } = paint;
  if (picture) return { ...paint, picture: { ...picture, toPixels: composed(picture.toPixels, rows) } };
  return paint.gradient ? { ...paint, gradient: moveGradient(paint.gradient, rows) } : paint;
}

/** @param {Gradient} gradient @param {Rows} rows @returns {Gradient} */
export function moveGradient(gradient, rows) {
  return { ...gradient, toRamp: composed(gradient.toRamp, rows) };
}

/** @param {Rows} outer @param {Rows} inner @returns {Rows} the map that applies `inner` first */
const composed = (outer, [[a, b, c], [d, e, f]]) =>
  /** @type {Rows} */ (outer.map(([p, q, r]) => [p * a + q * d, p * b + q * e, p * c + q * f + r]));

/** @param {Paint} paint @returns {boolean} whether its colour differs from point to point */
export const isVaried = ({ gradient, picture }) => gradient !== null || Boolean(picture);

/** @param {Picture} picture @returns {Paint} its flat colour is the mean of its pixels */
export function paintOfPicture(picture) {
  const { rgba, columns, rows } = picture.pixels;
  const sums = [0, 0, 0, 0];
  for (let k = 0; k < rgba.length; k++) sums[k & 3] += rgba[k];
  const [red, green, blue, alpha] = sums.map((sum) => sum / (columns * rows * 255));
  const color = /** @type {Color} */ ([red, green, blue].map((part) => Math.min(part / (alpha || 1), 1)));
  return { color, opacity: alpha * picture.opacity, gradient: null, picture };
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
