/**
 * A view of notebooks is a rectangle of the unit square (y up), centred at the largest size that fits, as that of
 * `vexture.window`. It is turned into the viewer's view of a canvas, moved there, and turned back.
 *
 * @typedef {[number, number, number, number]} Rect x y width height
 * @typedef {import('../viewer/view.js').View} View
 * @typedef {import('../viewer/view.js').Size} Size
 */
import { pixelSide } from '../viewer/view.js';

/** @param {Rect} rect @param {Size} size @returns {View} */
export function viewOf([x, y, width, height], size) {
  const side = Math.max(width / size.width, height / size.height);
  return { center: [x + width / 2, y + height / 2], zoom: pixelSide(1, size) / side };
}

/**
 * @param {View} view to which the rectangle has moved
 * @param {Rect} rect before
 * @param {Size} size
 * @returns {Rect}
 */
export function rectOf({ center: [u, v], zoom }, rect, size) {
  const before = viewOf(rect, size).zoom;
  const factor = zoom === before ? 1 : before / zoom; // a view that is only moved keeps its size to the last digit
  const [width, height] = [rect[2] * factor, rect[3] * factor];
  return [u - width / 2, v - height / 2, width, height];
}
