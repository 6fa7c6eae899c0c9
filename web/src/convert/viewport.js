// Mapping of content into a viewport: `viewBox` and `preserveAspectRatio` (SVG 2, 8.2).
import { isRelative, lengthOf, numbers, viewport } from './lengths.js';

/** @typedef {import('./contours.js').Rectangle} Rectangle */

/**
 * @typedef {{ across: number, down: number, rule: string }} Fit shares of the free space on the left and above; meet,
 *   slice or none
 */

/** Least width and height of a drawing in user units. */
export const THINNEST = 1e-9;

/** Size in pixels of an image without a size (CSS 2.1, 10.3.2). @type {readonly [number, number]} */
export const ANONYMOUS = [300, 150];

/** @type {Fit} */
export const CENTRED = { across: 0.5, down: 0.5, rule: 'meet' };

/** @type {Readonly<Record<string, number>>} */
const PART = { min: 0, mid: 0.5, max: 1 };
const ASPECT = /^\s*(?:defer\s+)?(?:(none)|x(min|mid|max)y(min|mid|max))(?:\s+(meet|slice))?\s*$/i;

/** @param {string} text @returns {Rectangle | null} null if it is not four numbers, or a side is negative */
export function viewBox(text) {
  const values = numbers(text);
  if (values?.length !== 4 || Math.min(values[2], values[3]) < 0) return null;
  return [values[0], values[1], values[2], values[3]];
}

/** @param {string} text `preserveAspectRatio` @returns {Fit | null} */
export function parseFit(text) {
  const match = ASPECT.exec(text);
  if (!match) return null;
  if (match[1]) return { across: 0.5, down: 0.5, rule: 'none' };
  return { across: PART[match[2].toLowerCase()], down: PART[match[3].toLowerCase()], rule: (match[4] ?? 'meet').toLowerCase() };
}

/**
 * @param {Rectangle} box
 * @param {Fit} fit
 * @param {number} width
 * @param {number} height
 * @returns {import('./affine.js').Affine}
 */
export function viewTransform([x, y, boxWidth, boxHeight], fit, width, height) {
  let [across, down] = [width / boxWidth, height / boxHeight];
  if (fit.rule !== 'none') across = down = Math[fit.rule === 'meet' ? 'min' : 'max'](across, down);
  const left = (width - boxWidth * across) * fit.across;
  const top = (height - boxHeight * down) * fit.down;
  return [across, 0, 0, down, left - x * across, top - y * down];
}

/**
 * Width and height of a drawing as an image, by the attributes of its outermost element.
 *
 * @param {(name: string) => string | null} attribute
 * @returns {[number, number]}
 */
export function ownSize(attribute) {
  const box = viewBox(attribute('viewBox') ?? '');
  const absolute = viewport(0, 0);
  const [width, height] = ['width', 'height'].map((name) => {
    const text = (attribute(name) ?? '100%').trim();
    return isRelative(text) ? null : lengthOf(absolute, text, 0, 16);
  });
  if (width !== null && height !== null) return [width, height];
  if (!box || Math.min(box[2], box[3]) < THINNEST) return [width || ANONYMOUS[0], height || ANONYMOUS[1]];
  const ratio = box[2] / box[3];
  return [width || (height || box[3]) * ratio, height || (width || box[2]) / ratio];
}
