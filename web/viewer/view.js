/**
 * The mathematics of the flat view, in float64; plain data, without three.js.
 *
 * A view shows the point `center` of the unit square (y up) in the middle of a canvas of CSS pixels (y down). At zoom 1
 * the unit square fills FIT of the canvas's shorter side.
 *
 * @typedef {readonly [number, number]} Point
 * @typedef {{center: Point, zoom: number}} View
 * @typedef {{width: number, height: number}} Size of the canvas, in CSS pixels
 */

export const FIT = 0.9;
export const LEAST_ZOOM = 0.25;
/** At 10,000 a pixel is about as large as what the format resolves; a little beyond shows that. */
export const MOST_ZOOM = 50000;

/** 1.0 in the shader's fixed-point positions. */
const FIXED_ONE = 2 ** 32;

/** @param {number} value @param {number} low @param {number} high */
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/**
 * Side of a CSS pixel, in the unit square.
 *
 * @param {number} zoom
 * @param {Size} size
 */
export function pixelSide(zoom, size) {
  return 1 / (zoom * FIT * Math.max(1, Math.min(size.width, size.height)));
}

/**
 * Point of the unit square at a place on the canvas.
 *
 * @param {View} view @param {Size} size @param {number} px @param {number} py
 * @returns {[number, number]}
 */
export function toUnit(view, size, px, py) {
  const side = pixelSide(view.zoom, size);
  return [view.center[0] + (px - size.width / 2) * side, view.center[1] - (py - size.height / 2) * side];
}

/**
 * Place on the canvas of a point of the unit square.
 *
 * @param {View} view @param {Size} size @param {number} u @param {number} v
 * @returns {[number, number]}
 */
export function toScreen(view, size, u, v) {
  const side = pixelSide(view.zoom, size);
  return [size.width / 2 + (u - view.center[0]) / side, size.height / 2 - (v - view.center[1]) / side];
}

/**
 * The view as it may be: zoom within its limits, the middle of the canvas on the unit square.
 *
 * @param {View} view
 * @returns {View}
 */
export function held(view) {
  const [u, v] = view.center;
  return { center: [clamp(u, 0, 1), clamp(v, 0, 1)], zoom: clamp(view.zoom, LEAST_ZOOM, MOST_ZOOM) };
}

/**
 * The view moved with its picture, by CSS pixels.
 *
 * @param {View} view @param {Size} size @param {number} dx @param {number} dy
 */
export function panned(view, size, dx, dy) {
  const side = pixelSide(view.zoom, size);
  return held({ center: [view.center[0] - dx * side, view.center[1] + dy * side], zoom: view.zoom });
}

/**
 * The view magnified about a place on the canvas, whose point stays there as far as the limits let it.
 *
 * @param {View} view @param {Size} size @param {number} px @param {number} py @param {number} factor
 */
export function zoomed(view, size, px, py, factor) {
  const zoom = clamp(view.zoom * factor, LEAST_ZOOM, MOST_ZOOM);
  const [u, v] = toUnit(view, size, px, py);
  const side = pixelSide(zoom, size);
  return held({ center: [u - (px - size.width / 2) * side, v + (py - size.height / 2) * side], zoom });
}

/**
 * What the shader is given: a base in 32-bit fixed point, which holds what float32 cannot, and the small rest. The
 * position of a pixel whose centre lies at (x, y) device pixels from the lower left corner, as gl_FragCoord has it, is
 * base + start + (x, y) * step.
 *
 * @param {View} view @param {Size} size @param {number} ratio device pixels of a CSS pixel
 * @returns {{base: [number, number], start: [number, number], step: number}}
 */
export function shaderView(view, size, ratio) {
  const base = /** @type {[number, number]} */ (
    view.center.map((value) => Math.min(Math.floor(clamp(value, 0, 1) * FIXED_ONE), FIXED_ONE - 1))
  );
  const [left, bottom] = toUnit(view, size, 0, size.height);
  const step = pixelSide(view.zoom, size) / ratio;
  return { base, start: [left - base[0] / FIXED_ONE, bottom - base[1] / FIXED_ONE], step };
}
