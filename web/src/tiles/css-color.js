// Colours of CSS as numbers, without three.js.
import { VextureError, line } from '../errors.js';

/** @typedef {[number, number, number, number]} Parts sRGB components and opacity, 0..1 */

/** Colours that have been read before: tables name the same ones again and again. @type {Map<string, Parts>} */
const KNOWN = new Map();

/** Colours after which they are forgotten. */
const MOST_KNOWN = 65536;

/** @type {OffscreenCanvasRenderingContext2D | null} */
let canvas = null;

/**
 * @param {string | number | readonly number[] | null} paint a colour as CSS writes it, 0xrrggbb, or four numbers; null hides
 * @param {() => string} [what] names it in messages
 * @returns {Parts}
 * @throws {VextureError} if it is no colour
 */
export function parts(paint, what = () => 'a paint') {
  if (paint === null || paint === 'none') return [0, 0, 0, 0];
  if (typeof paint === 'number' && Number.isInteger(paint) && paint >= 0 && paint <= 0xffffff) {
    return [(paint >> 16) / 255, ((paint >> 8) & 255) / 255, (paint & 255) / 255, 1];
  }
  if (Array.isArray(paint) && paint.length === 4 && paint.every((part) => part >= 0 && part <= 1)) return /** @type {Parts} */ (paint);
  if (typeof paint !== 'string') throw refused(paint, what());
  const known = KNOWN.get(paint) ?? (paint[0] === '#' ? hex(paint) : written(paint));
  if (!known) throw refused(paint, what());
  if (KNOWN.size >= MOST_KNOWN) KNOWN.clear();
  KNOWN.set(paint, known);
  return known;
}

/** @param {any} paint @param {string} what */
const refused = (paint, what) => new VextureError(paint?.isColor ? `${what} is a Color of three.js; give its getStyle()`
  : `${what} is ${line(paint)}; give a colour of CSS, four numbers in 0..1, or null`, 'paint');

/** @param {string} text @returns {Parts | null} */
function hex(text) {
  if (!/^#(?:[\da-f]{3,4}|[\da-f]{6}|[\da-f]{8})$/i.test(text)) return null;
  const digits = text.length < 6 ? [...text.slice(1)].map((digit) => digit + digit) : text.slice(1).match(/../g) ?? [];
  const [red, green, blue, opacity = 1] = digits.map((digit) => parseInt(digit, 16) / 255);
  return [red, green, blue, opacity];
}

/** What tables of colours are full of. */
const RGB = /^rgb\((\d{1,3}), ?(\d{1,3}), ?(\d{1,3})\)$/;

/** A colour in words, as the browser reads it. @param {string} text @returns {Parts | null} */
function written(text) {
  const [red, green, blue] = RGB.exec(text)?.slice(1).map((part) => Math.min(Number(part) / 255, 1)) ?? [];
  if (blue !== undefined) return [red, green, blue, 1];
  canvas ??= new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  const context = canvas;
  if (!context) return null;
  const [one, other] = ['#000000', '#ffffff'].map((start) => {
    context.fillStyle = start;
    context.fillStyle = text;
    return String(context.fillStyle);
  });
  if (one !== other) return null; // the browser has left what it did not understand as it was
  if (one[0] === '#') return hex(one);
  const numbers = one.startsWith('rgb') ? one.match(/[\d.]+/g)?.map(Number) ?? [] : [];
  if (numbers.length === 4) return [numbers[0] / 255, numbers[1] / 255, numbers[2] / 255, numbers[3]];
  context.clearRect(0, 0, 1, 1); // a colour of another space, such as oklch: as a pixel has it
  context.fillRect(0, 0, 1, 1);
  return /** @type {any} */ ([...context.getImageData(0, 0, 1, 1).data].map((part) => part / 255));
}
