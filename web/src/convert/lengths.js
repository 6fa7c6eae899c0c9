// Numbers and lengths of SVG: syntax, units, and limits.
import { LARGEST, PIXELS } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { calculate } from './calc.js';

/** A number of an element exceeds `LARGEST`; only that element is dropped. */
export class TooLargeError extends VextureError {}

/**
 * @typedef {{ width: number, height: number, rem: number, outermost: readonly [number, number] | null }} Viewport sizes
 *   to which lengths refer
 */

/** Font sizes per unit that depends on the font. @type {Readonly<Record<string, number>>} */
const FONT_UNITS = { em: 1, ex: 0.5, ch: 0.5 };

const WRITTEN = /^\s*([+-]?(?:\d*\.\d+|\d+)(?:[eE][+-]?\d+)?)\s*([a-zA-Z]*|%)\s*$/;
const RELATIVE = /%|\d\.?[sld]?v[whibm]/i;

/** @param {string} text @returns {number} @throws {VextureError} if it exceeds `LARGEST` */
function bounded(text) {
  const value = Number(text);
  if (Math.abs(value) <= LARGEST) return value;
  throw new TooLargeError(
    `the number ${text.slice(0, 40)} is too large; the limit is ${exponential(LARGEST)}`,
    'number',
  );
}

/** @param {number} value @returns {string} as "%g" formats it in messages */
export function exponential(value) {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return String(value).replace('Infinity', 'inf').replace('NaN', 'nan');
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) {
    return value.toExponential(5).replace(/\.?0+e/, 'e').replace(/e([+-])(\d)$/, 'e$10$2');
  }
  return String(Number(value.toPrecision(6)));
}

/** @param {string} text @returns {number | null} a finite number; null if the text is not one */
export function number(text) {
  const match = WRITTEN.exec(text);
  return match && !match[2] ? bounded(match[1]) : null;
}

/** @param {string} text @returns {number[] | null} numbers between commas or spaces; null if there is anything else */
export function numbers(text) {
  const found = text.trim().split(/\s*,\s*|\s+/).map(number);
  return found.includes(null) ? null : /** @type {number[]} */ (found);
}

/**
 * @param {string} text
 * @param {RegExp} [between]
 * @returns {string[]} parts between commas or spaces, outside of brackets
 */
export function words(text, between = /\s*,\s*|\s+/) {
  const trimmed = text.trim();
  if (!trimmed.includes('(')) return trimmed ? trimmed.split(between) : [];
  const found = [''];
  let depth = 0;
  for (const part of trimmed.match(/[()]|[^()]+/g) ?? []) {
    depth += Number(part === '(') - Number(part === ')');
    const [first, ...others] = depth || part === ')' ? [part] : part.split(between);
    found[found.length - 1] += first;
    found.push(...others);
  }
  return found;
}

/** @param {string} text a side of the outermost viewport @returns {boolean} whether it depends on the surroundings */
export const isRelative = (text) => RELATIVE.test(text);

/**
 * @param {string} text
 * @returns {number | null} a number or percentage, clamped to 0..1; null if the text is neither
 */
export function fraction(text) {
  const match = WRITTEN.exec(text);
  if (!match || (match[2] && match[2] !== '%')) return null;
  return Math.min(Math.max(bounded(match[1]) / (match[2] ? 100 : 1), 0), 1);
}

/** @param {Viewport} view @returns {number} the reference of percentages of neither width nor height (SVG 2, 8.9) */
export const diagonal = (view) => Math.hypot(view.width, view.height) / 2 ** 0.5;

/** @param {number} width @param {number} height @param {number} [rem] @returns {Viewport} */
export const viewport = (width, height, rem = 16) => ({ width, height, rem, outermost: null });

/**
 * Convert a length to user units.
 *
 * @param {Viewport} view
 * @param {string} text
 * @param {number} whole 100 %
 * @param {number} fontSize 1 em
 * @returns {number | null} null if the text is not a length
 */
export function lengthOf(view, text, whole, fontSize) {
  const match = WRITTEN.exec(text);
  if (!match && text.includes('(')) return calculate(text, (unit) => factorOf(view, unit, whole, fontSize));
  const factor = match && factorOf(view, match[2].toLowerCase(), whole, fontSize);
  return match && factor !== null ? bounded(match[1]) * factor : null;
}

/**
 * @param {Viewport} view
 * @param {string} unit
 * @param {number} whole
 * @param {number} fontSize
 * @returns {number | null}
 */
function factorOf(view, unit, whole, fontSize) {
  if (unit in PIXELS) return PIXELS[unit];
  if (unit === '%') return whole / 100;
  if (unit in FONT_UNITS) return FONT_UNITS[unit] * fontSize;
  if (unit === 'rem') return view.rem;
  const match = /^[sld]?v([whib]|min|max)$/.exec(unit);
  if (!match) return null;
  const [width, height] = view.outermost ?? [view.width, view.height];
  if (match[1].length > 1) return Math[/** @type {'min' | 'max'} */ (match[1])](width, height) / 100;
  return (match[1] === 'w' || match[1] === 'i' ? width : height) / 100;
}

/** @param {Viewport} view @param {number} fontSize @returns {import('./affine.js').AxisLength} */
export const along = (view, fontSize) => (text, axis) => lengthOf(view, text, axis ? view.height : view.width, fontSize);
