// Blend modes of W3C's Compositing and Blending Level 1, by the numbers that programs (FORMAT.md, D.6) and styles (D.10)
// use.
import { LUMINANCE_BLUE, LUMINANCE_GREEN, LUMINANCE_RED } from '../generated/layout.js';

/** @typedef {import('./planar-map.js').Color} Color */

const NORMAL = 0;
const PLUS_LIGHTER = 16;

/** As in Python: a component this close to 0 or 1 counts as 0 or 1, because dodge and burn are discontinuous there. */
const ROUNDING = 1e-9;

const hardLight = (/** @type {number} */ b, /** @type {number} */ s) =>
  s <= 0.5 ? 2 * b * s : 1 - 2 * (1 - b) * (1 - s);

/**
 * B(cb, cs) of one component, by the number of the mode; b is the backdrop and s the source.
 *
 * @type {Readonly<Record<number, (b: number, s: number) => number>>}
 */
const MODES = Object.freeze({
  1: (b, s) => b * s,
  2: (b, s) => b + s - b * s,
  3: (b, s) => hardLight(s, b),
  4: Math.min,
  5: Math.max,
  6: (b, s) => (b <= ROUNDING ? 0 : s >= 1 - ROUNDING ? 1 : Math.min(1, b / (1 - s))),
  7: (b, s) => (b >= 1 - ROUNDING ? 1 : s <= ROUNDING ? 0 : 1 - Math.min(1, (1 - b) / s)),
  8: hardLight,
  9: (b, s) => {
    const root = b <= 0.25 ? ((16 * b - 12) * b + 4) * b : Math.sqrt(b);
    return b + (2 * s - 1) * (s <= 0.5 ? b * (1 - b) : root - b);
  },
  10: (b, s) => Math.abs(b - s),
  11: (b, s) => b + s - 2 * b * s,
});

/** @typedef {[number, number, number]} Straight a colour without its opacity */

const luminosity = (/** @type {Straight} */ [red, green, blue]) => 0.3 * red + 0.59 * green + 0.11 * blue;
const saturation = (/** @type {Straight} */ color) => Math.max(...color) - Math.min(...color);

/** The W3C's SetLum and ClipColor. @param {Straight} color @param {number} wanted */
function withLuminosity(color, wanted) {
  const moved = color.map((part) => part + wanted - luminosity(color));
  const [least, most] = [Math.min(...moved), Math.max(...moved)];
  let share = least < 0 ? wanted / (wanted - least) : 1;
  if (most > 1) share = Math.min(share, (1 - wanted) / (most - wanted));
  return /** @type {Straight} */ (moved.map((part) => wanted + (part - wanted) * share));
}

/** The W3C's SetSat. @param {Straight} color @param {number} wanted */
function withSaturation(color, wanted) {
  const range = saturation(color);
  const least = Math.min(...color);
  return /** @type {Straight} */ (color.map((part) => (range ? ((part - least) * wanted) / range : 0)));
}

/**
 * B(cb, cs) of whole colours.
 *
 * @type {Readonly<Record<number, (b: Straight, s: Straight) => Straight>>}
 */
const WHOLE = Object.freeze({
  12: (b, s) => withLuminosity(withSaturation(s, saturation(b)), luminosity(b)),
  13: (b, s) => withLuminosity(withSaturation(b, saturation(s)), luminosity(b)),
  14: (b, s) => withLuminosity(s, luminosity(b)),
  15: (b, s) => withLuminosity(b, luminosity(s)),
});

/** Names in CSS, by number. */
const NAMES = ['normal', 'multiply', 'screen', 'overlay', 'darken', 'lighten', 'color-dodge', 'color-burn', 'hard-light',
  'soft-light', 'difference', 'exclusion', 'hue', 'saturation', 'color', 'luminosity', 'plus-lighter'];

/**
 * Return the number of a mode by its name in CSS, or null if there is no such mode.
 *
 * @param {unknown} name
 */
export function modeNamed(name) {
  const number = NAMES.indexOf(/** @type {string} */ (name));
  return number >= 0 ? number : null;
}

/**
 * Return the name of a mode in CSS.
 *
 * @param {number} mode
 */
export function modeName(mode) {
  return NAMES[mode];
}

/**
 * Return whether there is a mode of this number.
 *
 * @param {number} mode
 */
export function isBlend(mode) {
  return mode < NAMES.length;
}

/**
 * Return what a mask keeps, by its premultiplied colour: the opacity or the luminance.
 *
 * @param {Color} color
 * @param {boolean} byOpacity
 */
export function masking([red, green, blue, opacity], byOpacity) {
  return byOpacity ? opacity : LUMINANCE_RED * red + LUMINANCE_GREEN * green + LUMINANCE_BLUE * blue;
}

/**
 * Composite one premultiplied colour over another, 0..1.
 *
 * @param {Color} below
 * @param {Color} above
 * @param {number} mode
 * @returns {Color}
 */
export function blended(below, above, mode) {
  const [under, over] = [below[3], above[3]];
  if (mode === PLUS_LIGHTER) return /** @type {Color} */ (below.map((part, k) => Math.min(part + above[k], 1)));
  if (mode === NORMAL) return /** @type {Color} */ (below.map((part, k) => above[k] + (1 - over) * part));
  const straight = (/** @type {Color} */ [red, green, blue, opacity]) => /** @type {Straight} */ (
    [red, green, blue].map((part) => (opacity ? Math.min(part / opacity, 1) : 0)));
  const [b, s] = [straight(below), straight(above)];
  const both = mode in WHOLE ? WHOLE[mode](b, s) : b.map((part, k) => MODES[mode](part, s[k]));
  const mixed = both.map((part, k) => above[k] * (1 - under) + below[k] * (1 - over) + over * under * part);
  return /** @type {Color} */ ([...mixed, over + under * (1 - over)]);
}
