// What a request asks of its text, checked.
import * as hb from 'harfbuzzjs';
import { VextureError, line } from '../errors.js';
import { featuresOf } from './shaper.js';

/** @import { Instance, TypeFont, Variations } from './font.js' */

/** Options of a text by what requests name them. @type {Record<string, string>} */
const OPTIONS = { features: 'fontFeatures', language: 'lang', variations: 'fontVariations', weight: 'fontWeight' };

/**
 * @typedef {object} Request Lengths are in the text's own units.
 * @property {string} text
 * @property {number[]} fonts ids in order of preference
 * @property {number} [fontSize] units to the em; 1 by default
 * @property {number} [weight]
 * @property {boolean} [italic]
 * @property {Variations} [variations]
 * @property {string} [features] as CSS or HarfBuzz writes them
 * @property {string} [language]
 * @property {number} [letterSpacing]
 * @property {number} [tabSize]
 * @property {number | 'normal'} [lineHeight] a factor of `fontSize`
 * @property {number} [maxWidth]
 * @property {number} [textIndent]
 * @property {'left' | 'right' | 'center' | 'justify' | 'start' | 'end'} [textAlign]
 * @property {'normal' | 'nowrap' | 'pre' | 'pre-wrap'} [whiteSpace]
 * @property {'normal' | 'break-word'} [overflowWrap]
 * @property {'auto' | 'ltr' | 'rtl'} [direction]
 * @property {'horizontal-tb' | 'vertical-rl'} [writingMode]
 * @property {number | string} [anchorX]
 * @property {number | string} [anchorY]
 * @property {[number, string][]} [inks] colours as six hexadecimal digits, each from an index of the text on
 * @property {number} [outlineWidth]
 * @property {number} [strokeWidth]
 */

/** Most UTF-16 units of a text. */
const MOST_UNITS = 1_000_000;

/** Largest and least length, in ems or units: beyond, 32-bit floats say too little. */
const LARGEST = 1e9;

/** Texts of features that are remembered. */
const MOST_FEATURES = 1000;

const CHOICES = {
  textAlign: ['left', 'right', 'center', 'justify', 'start', 'end'],
  whiteSpace: ['normal', 'nowrap', 'pre', 'pre-wrap'],
  overflowWrap: ['normal', 'break-word'],
  direction: ['auto', 'ltr', 'rtl'],
  writingMode: ['horizontal-tb', 'vertical-rl'],
};

/** Features that spread letters do without (CSS Text 3, 8.2). */
const SPREAD = ['liga', 'clig'].map((tag) => new hb.Feature(tag, 0));

/** Shares of the block to the left of an anchor. @type {Record<string, number>} */
const SIDES = { left: 0, center: 0.5, right: 1 };

/** Names of an anchor's height. */
const HEIGHTS = ['top', 'top-baseline', 'top-cap', 'top-ex', 'middle', 'bottom-baseline', 'bottom'];

/** @type {Map<string, hb.Feature[]>} */
const features = new Map();

/** The checked values of a request. */
export class Style {
  /** @type {Map<TypeFont, Instance>} */
  #instances = new Map();
  #variations;

  /**
   * @param {Request} request
   * @param {Map<number, TypeFont>} fonts
   * @throws {VextureError} if a value is out of range
   */
  constructor(request, fonts) {
    const { text, variations, weight, italic, letterSpacing, lineHeight, maxWidth } = request;
    if (typeof text !== 'string') throw new VextureError(`\`text\` is ${line(text)}; give a string`, 'text');
    if (text.length > MOST_UNITS) {
      throw new VextureError(`\`text\` has ${text.length} UTF-16 units; the limit is ${MOST_UNITS}; divide it into several texts`, 'text');
    }
    this.fonts = fontsOf(request.fonts, fonts);
    this.fontSize = number(request, 'fontSize', 1, 0);
    this.letterSpacing = letterSpacing ? number(request, 'letterSpacing', 0) : 0;
    this.tabSize = number(request, 'tabSize', 8, 0);
    this.lineHeight = lineHeight === undefined || lineHeight === 'normal' ? null : number(request, 'lineHeight', 1, 0);
    this.maxWidth = maxWidth === undefined || maxWidth === null || maxWidth === Infinity ? Infinity : number(request, 'maxWidth', 0, 0);
    this.textIndent = number(request, 'textIndent', 0);
    this.textAlign = choice(request, 'textAlign', 'start');
    const whiteSpace = choice(request, 'whiteSpace', 'normal');
    this.wraps = this.maxWidth < Infinity && (whiteSpace === 'normal' || whiteSpace === 'pre-wrap');
    this.breaksWords = choice(request, 'overflowWrap', 'normal') === 'break-word';
    this.direction = /** @type {'auto' | 'ltr' | 'rtl'} */ (choice(request, 'direction', 'auto'));
    this.isVertical = choice(request, 'writingMode', 'horizontal-tb') === 'vertical-rl';
    this.anchorX = anchor(request, 'anchorX', Object.keys(SIDES), 0);
    this.anchorY = anchor(request, 'anchorY', HEIGHTS, 0);
    this.outlineWidth = number(request, 'outlineWidth', 0, 0);
    this.strokeWidth = number(request, 'strokeWidth', 0, 0);
    this.language = request.language ? languageOf(request.language) : '';
    this.inks = inksOf(request.inks ?? []);
    this.features = featureList(request.features ?? '');
    if (this.letterSpacing) this.features = [...SPREAD, ...this.features];
    this.#variations = weight === undefined && !italic && !variations ? null : checkedVariations(request);
  }

  /** @param {TypeFont} font */
  instance(font) {
    let instance = this.#instances.get(font);
    if (!instance) {
      instance = font.instance(this.#variations ? font.variationKey(this.#variations) : '');
      this.#instances.set(font, instance);
    }
    return instance;
  }
}

/**
 * @param {unknown} ids
 * @param {Map<number, TypeFont>} fonts
 */
function fontsOf(ids, fonts) {
  if (!Array.isArray(ids) || !ids.length) throw new VextureError(`\`fonts\` is ${line(ids)}; give the ids of one font or more`, 'fonts');
  return ids.map((id) => {
    const font = fonts.get(id);
    if (!font) throw new VextureError(`the font ${line(id)} is unknown; name it to the worker first`, 'fonts');
    return font;
  });
}

/**
 * @param {Request} request
 * @param {'fontSize' | 'letterSpacing' | 'tabSize' | 'lineHeight' | 'maxWidth' | 'textIndent' | 'outlineWidth' | 'strokeWidth'} name
 * @param {number} usual
 * @param {number} [least]
 */
function number(request, name, usual, least = -LARGEST) {
  const value = request[name] ?? usual;
  if (typeof value === 'number' && value >= least && value <= LARGEST) return value;
  throw new VextureError(`\`${name}\` is ${line(value)}; give a number from ${least} to ${LARGEST}`, name);
}

/**
 * @param {Request} request
 * @param {keyof typeof CHOICES} name
 * @param {string} usual
 */
function choice(request, name, usual) {
  const value = request[name] ?? usual;
  if (CHOICES[name].includes(value)) return value;
  throw new VextureError(`\`${name}\` is ${line(value)}; it must be one of ${CHOICES[name].join(', ')}`, name);
}

/**
 * @param {Request} request
 * @param {'anchorX' | 'anchorY'} name
 * @param {string[]} names
 * @param {number} usual
 * @returns {number | string | { share: number }}
 */
function anchor(request, name, names, usual) {
  const value = request[name] ?? usual;
  if (typeof value === 'number' && Math.abs(value) <= LARGEST) return value;
  if (typeof value === 'string') {
    if (names.includes(value)) return name === 'anchorX' ? { share: SIDES[value] } : value;
    const percent = /^\s*([+-]?(?:\d+\.?\d*|\.\d+))%\s*$/.exec(value);
    if (percent) return { share: Number(percent[1]) / 100 };
  }
  throw new VextureError(`\`${name}\` is ${line(value)}; give a number, a share such as '50%', or one of ${names.join(', ')}`, name);
}

/** @param {unknown} language */
function languageOf(language) {
  if (typeof language === 'string' && /^[a-z\d]{1,8}([-_][a-z\d]{1,8})*$/i.test(language)) return language;
  throw new VextureError(`\`${OPTIONS.language}\` is ${line(language)}; give a tag such as 'sr' or 'zh-Hant'`, OPTIONS.language);
}

/** @param {any} inks @returns {[number, string][]} */
function inksOf(inks) {
  const areInks = Array.isArray(inks) && inks.every((one) => Number.isInteger(one?.[0]) && /^[\da-f]{6}$/.test(one[1]));
  if (areInks) return inks;
  throw new VextureError(`\`inks\` are ${line(inks)}; give pairs such as [0, 'ff0000']`, 'inks');
}

/** @param {string} text */
function featureList(text) {
  let list = features.get(text);
  if (!list) {
    const found = featuresOf(String(text));
    if (typeof found === 'string') {
      throw new VextureError(`\`${OPTIONS.features}\` has ${line(found)}; write tags of four letters, such as 'smcp, ss01=2'`, OPTIONS.features);
    }
    if (features.size >= MOST_FEATURES) features.clear();
    features.set(text, (list = found));
  }
  return list;
}

/** @param {Request} request @returns {Variations} */
function checkedVariations({ variations, weight, italic }) {
  /** @type {Variations} */
  const all = { ...(weight === undefined ? null : { wght: weight }), ...(italic ? { ital: 1, slnt: -LARGEST } : null), ...variations };
  for (const [tag, value] of Object.entries(all)) {
    if (typeof value !== 'number' || Number.isNaN(value)) {
      const name = tag === 'wght' && variations?.wght === undefined ? OPTIONS.weight : OPTIONS.variations;
      throw new VextureError(`\`${name}\` has ${line(value)} for ${line(tag)}; give a number`, name);
    }
  }
  return all;
}
