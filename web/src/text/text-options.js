// The options of a text: their names, defaults and checks.
import { Color } from 'three';
import { VextureError, line } from '../errors.js';
import { weightOf } from './faces.js';

/** @import { ColorRepresentation } from 'three' */
/** @import { FontSource } from './faces.js' */
/** @import { Rectangle, Request } from './layout.js' */

/**
 * @typedef {object} LayoutOptions What decides where glyphs are; lengths are in the units of the text.
 * @property {string} text `\n` begins a new line
 * @property {FontSource | import('./atlas-font.js').AtlasFont | null} font fonts in order of preference: addresses, contents or
 *   faces of a family; or a baked font; null: the default
 * @property {number} fontSize length of an em, 1 by default
 * @property {number | string} fontWeight 1..1000, `normal` or `bold`: chooses among the faces, and sets a variable font
 * @property {'normal' | 'italic'} fontStyle `normal` by default
 * @property {Record<string, number>} fontVariations values of the axes of a variable font, such as `{ wdth: 75 }`
 * @property {string} fontFeatures OpenType features, such as `smcp, ss01, -liga`
 * @property {string} lang language, such as `sr`, for fonts with forms of their own for it
 * @property {number} letterSpacing added after each character
 * @property {number} tabSize distance of tab stops in widths of a space; 8 by default
 * @property {number | 'normal'} lineHeight distance of lines in ems; `normal`: that of the font
 * @property {number} maxWidth lines are broken to be no longer
 * @property {number} textIndent of the first line of each paragraph
 * @property {'left' | 'right' | 'center' | 'justify' | 'start' | 'end'} textAlign `start` by default: on the side where a line begins
 * @property {'normal' | 'nowrap'} whiteSpace `nowrap` breaks lines at `\n` only
 * @property {'normal' | 'break-word'} overflowWrap `break-word` breaks words that are longer than a line
 * @property {'auto' | 'ltr' | 'rtl'} direction `auto`: that of the first letter of a paragraph
 * @property {'horizontal-tb' | 'vertical-rl'} writingMode `vertical-rl`: lines from top to bottom, the first on the right
 * @property {number | string} anchorX the text's origin: a distance from its left, a percentage of its width, or `left`,
 *   `center` or `right`
 * @property {number | string} anchorY a distance from its top, a percentage of its height, or `top`, `top-baseline`, `top-cap`,
 *   `top-ex`, `middle`, `bottom-baseline` or `bottom`
 * @property {number | string} outlineWidth width of an outline around the letters, also as a percentage of `fontSize`
 * @property {number | string} strokeWidth width of a line along the edges of the letters, half of it inside
 *
 * @typedef {object} LookOptions What changes nothing of where glyphs are.
 * @property {ColorRepresentation | null} color null: that of the material
 * @property {number} fillOpacity opacity of the letters, 1 by default
 * @property {ColorRepresentation} outlineColor black by default
 * @property {number} outlineOpacity 1 by default
 * @property {number | string} outlineOffsetX shifts the outline to the right, for a shadow; also as a percentage of `fontSize`
 * @property {number | string} outlineOffsetY shifts the outline down
 * @property {ColorRepresentation} strokeColor grey by default
 * @property {number} strokeOpacity 1 by default
 * @property {'off' | 'polite' | 'assertive'} ariaLive whether a hidden element of the page has the text, for screen readers;
 *   `off` by default
 * @property {number} depthOffset moves the text nearer (below 0) or farther in the order of depths, in pixels
 *
 * @typedef {object} ArrangementOptions What the page does with glyphs.
 * @property {Rectangle | null} clipRect left, bottom, right and top of what is shown
 * @property {Record<number, ColorRepresentation> | null} colorRanges colours from the characters at these indices on
 * @property {number} curveRadius radius of a vertical cylinder on which the text is; above 0 its axis is in front of the
 *   text, below 0 behind it
 * @property {import('three').Curve<import('three').Vector2 | import('three').Vector3> | null} curve path along which the
 *   baseline runs, by its length
 *
 * @typedef {LayoutOptions & LookOptions & ArrangementOptions} TextOptions all options of a `Text`, each of which is a property of it
 */

/** @type {Readonly<LayoutOptions>} */
export const LAYOUT = Object.freeze({
  text: '', font: null, fontSize: 1, fontWeight: 'normal', fontStyle: 'normal', fontVariations: Object.freeze({}), fontFeatures: '', lang: '',
  letterSpacing: 0, tabSize: 8, lineHeight: 'normal', maxWidth: Infinity, textIndent: 0, textAlign: 'start', whiteSpace: 'normal',
  overflowWrap: 'normal', direction: 'auto', writingMode: 'horizontal-tb', anchorX: 0, anchorY: 0, outlineWidth: 0, strokeWidth: 0,
});

/** @type {Readonly<LookOptions>} */
export const LOOK = Object.freeze({
  color: null, fillOpacity: 1, outlineColor: 0x000000, outlineOpacity: 1, outlineOffsetX: 0, outlineOffsetY: 0,
  strokeColor: 0x808080, strokeOpacity: 1, depthOffset: 0, ariaLive: 'off',
});

/** @type {Readonly<ArrangementOptions>} */
export const ARRANGEMENT = Object.freeze({ clipRect: null, colorRanges: null, curveRadius: 0, curve: null });

/** @type {Readonly<TextOptions>} */
export const DEFAULTS = Object.freeze({ ...LAYOUT, ...LOOK, ...ARRANGEMENT });

/** Values of options that are one of some words. */
const WORDS = Object.freeze({
  fontStyle: ['normal', 'italic'],
  textAlign: ['left', 'right', 'center', 'justify', 'start', 'end'],
  whiteSpace: ['normal', 'nowrap'],
  overflowWrap: ['normal', 'break-word'],
  direction: ['auto', 'ltr', 'rtl'],
  writingMode: ['horizontal-tb', 'vertical-rl'],
  ariaLive: ['off', 'polite', 'assertive'],
});

const ANCHORS = Object.freeze({
  anchorX: ['left', 'center', 'right'],
  anchorY: ['top', 'top-baseline', 'top-cap', 'top-ex', 'middle', 'bottom-baseline', 'bottom'],
});

/** Options that are numbers, and their least value. */
const NUMBERS = Object.freeze({
  fontSize: 0, letterSpacing: -Infinity, tabSize: 0, maxWidth: 0, textIndent: -Infinity, fillOpacity: 0, outlineOpacity: 0, strokeOpacity: 0,
  depthOffset: -Infinity, curveRadius: -Infinity,
});

/** Options that are lengths or percentages of `fontSize`, and their least value. */
const LENGTHS = Object.freeze({ outlineWidth: 0, strokeWidth: 0, outlineOffsetX: -Infinity, outlineOffsetY: -Infinity });

const PERCENTAGE = /^-?\d+(\.\d+)?%$/;

/**
 * @param {string} name
 * @param {any} value
 * @throws {VextureError} if it is no value of this option
 */
export function checkOption(name, value) {
  const wrong = (/** @type {string} */ wanted) => new VextureError(`${name} is ${line(value)}; it must be ${wanted}`, name);
  if (name === 'text' && typeof value !== 'string') throw wrong('a string');
  if (name === 'fontWeight') weightOf(value);
  const words = WORDS[/** @type {keyof typeof WORDS} */ (name)];
  if (words && !words.includes(value)) throw wrong(`one of ${words.join(', ')}`);
  const least = NUMBERS[/** @type {keyof typeof NUMBERS} */ (name)];
  if (least !== undefined && !(typeof value === 'number' && value >= least)) throw wrong(least ? 'a number' : 'a number from 0 on');
  const short = LENGTHS[/** @type {keyof typeof LENGTHS} */ (name)];
  if (short !== undefined && !PERCENTAGE.test(value) && !(Number.isFinite(value) && value >= short)) throw wrong("a length, or a percentage as '5%'");
  const anchors = ANCHORS[/** @type {keyof typeof ANCHORS} */ (name)];
  if (anchors && !Number.isFinite(value) && !anchors.includes(value) && !PERCENTAGE.test(value)) {
    throw wrong(`a number, a percentage, ${anchors.join(', ')}`);
  }
  if (name === 'lineHeight' && value !== 'normal' && !(value >= 0 && Number.isFinite(value))) throw wrong("'normal' or a number from 0 on");
  if (name === 'clipRect' && value !== null && !(value?.length === 4 && [...value].every((part) => typeof part === 'number'))) {
    throw wrong('null or four numbers: left, bottom, right and top');
  }
}

/** @param {number | string} value length or percentage @param {number} fontSize @returns {number} */
export const lengthOf = (value, fontSize) => (typeof value === 'string' ? (Number.parseFloat(value) / 100) * fontSize : value);

const TONE = new Color();

/**
 * Colours of a text as the worker takes them.
 *
 * @param {ColorRepresentation} color
 * @param {Record<number, ColorRepresentation> | null} [ranges]
 * @returns {[number, string][]}
 */
export function inksOf(color, ranges) {
  const starts = Object.keys(ranges ?? {}).map(Number).filter(Number.isInteger).sort((a, b) => a - b);
  return [[0, TONE.set(color).getHexString()], ...starts.map((start) => /** @type {[number, string]} */ ([start, TONE.set(/** @type {any} */ (ranges)[start]).getHexString()]))];
}

/** @param {LayoutOptions} options @returns {Omit<Request, 'fonts'>} */
export function requestOf({ font, fontWeight, fontStyle, fontVariations, fontFeatures, lang, outlineWidth, strokeWidth, ...same }) {
  const { fontSize } = same;
  return {
    ...same, weight: weightOf(fontWeight), italic: fontStyle === 'italic', variations: fontVariations, features: fontFeatures, language: lang,
    outlineWidth: lengthOf(outlineWidth, fontSize), strokeWidth: lengthOf(strokeWidth, fontSize),
  };
}
