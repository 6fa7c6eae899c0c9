// The document and its styles where there is no browser, as in Node.js; the counterpart of page-engine.js.
import { converter, parse as parseColor } from 'culori';
import { ANIMATIONS } from '../../generated/svg-reader.js';
import { Cascade } from './cascade.js';
import { SVG } from './parse.js';
import { parseXml } from './parse-xml.js';

/** @import { Pace, Steps } from './pace.js' */
/** @import { Engine, Style } from './page-engine.js' */
/** @import { XmlElement } from './parse-xml.js' */

/**
 * @typedef {object} Instance An element, or its copy inside a `use`.
 * @property {XmlElement} base
 * @property {Instance | null} parent from which it inherits
 * @property {Instance[] | null} children
 * @property {Instance | null} original of which it is a copy
 */

/** Initial values of properties (SVG 2, CSS), with what is inherited marked by +. */
const PROPERTIES = /** @type {Readonly<Record<string, string>>} */ ({
  '+clip-rule': 'nonzero', '+color': 'black', '+color-interpolation': 'sRGB', '+fill': 'black', '+fill-opacity': '1',
  '+fill-rule': 'nonzero', '+font-size': '16px', '+image-rendering': 'auto', '+marker-end': 'none', '+marker-mid': 'none', '+marker-start': 'none',
  '+paint-order': 'normal', '+stroke': 'none', '+stroke-dasharray': 'none', '+stroke-dashoffset': '0', '+stroke-linecap': 'butt',
  '+stroke-linejoin': 'miter', '+stroke-miterlimit': '4', '+stroke-opacity': '1', '+stroke-width': '1', '+visibility': 'visible',
  'background-color': 'transparent', 'clip-path': 'none', display: 'inline', filter: 'none', isolation: 'auto', mask: 'none',
  'mask-mode': 'match-source', 'mask-type': 'luminance', 'mix-blend-mode': 'normal', opacity: '1', overflow: 'visible',
  'stop-color': 'black', 'stop-opacity': '1', 'vector-effect': 'none',
});

const INHERITED = new Set(Object.keys(PROPERTIES).filter((name) => name[0] === '+').map((name) => name.slice(1)));
const INITIAL = new Map(Object.entries(PROPERTIES).map(([name, value]) => [name.replace('+', ''), value]));

/** Properties that the reader takes as they are written; without a declaration an attribute counts. */
const WRITTEN = new Set([
  'x', 'y', 'width', 'height', 'cx', 'cy', 'r', 'rx', 'ry', 'd', 'transform', 'transform-origin', 'transform-box', 'translate',
  'rotate', 'scale', 'offset-path',
]);

const CSS_ONLY = new Set(['translate', 'rotate', 'scale', 'offset-path', 'transform-box']);
const COLORS = new Set(['fill', 'stroke', 'stop-color', 'background-color']);
const KEYWORD = /^(?:inherit|initial|unset|revert|revert-layer)$/i;
const FONT_LENGTH = /([+-]?(?:\d*\.\d+|\d+)(?:e[+-]?\d+)?)(em|rem|ex|ch)\b/gi;

/** Functions of CSS that only browsers compute: a value with one counts as invalid. */
const COMPUTED = /\b(?:color-mix|light-dark|device-cmyk|round|mod|rem|sin|cos|tan|asin|acos|atan|atan2|pow|sqrt|hypot|log|exp|abs|sign|env|attr)\(|\(\s*from\s|\binfinity\b/i;

/** Units that only browsers know. */
const UNKNOWN_UNIT = /\d(?:cq[whib]|cqmin|cqmax|lh|rlh|cap|ic)\b/i;

/** Levels of variables in one another. */
const MOST_NESTED = 32;

/** Sizes of fonts by keyword, in pixels (CSS Fonts 4, 2.5). @type {Readonly<Record<string, number>>} */
const FONT_SIZES = { 'xx-small': 9, 'x-small': 10, small: 13, medium: 16, large: 18, 'x-large': 24, 'xx-large': 32, 'xxx-large': 48 };

const toRgb = converter('rgb');

/**
 * Open a document.
 *
 * @param {string} text
 * @param {Pace} pace
 * @returns {Steps<Engine>}
 * @throws {VextureError} if it is no SVG, or exceeds a limit
 */
export function* openSvg(text, pace) {
  const engine = new CascadeEngine(yield* parseXml(text, pace));
  yield* engine.prepare(pace);
  return engine;
}

/** @implements {Engine} */
class CascadeEngine {
  /** @type {Map<string, number>} */
  stripped = new Map();
  /** @type {{ name: string, value: string, element: any }[]} */
  invalid = [];
  /** @type {Map<Instance, CascadeStyle>} */
  #styles = new Map();
  /** @type {Map<Instance, Instance>} */
  #instances = new Map();
  /** @type {Map<string, Instance>} */
  #ids = new Map();
  /** @type {Map<string, [number, number, number, number] | null>} */
  #colors = new Map();

  /** @param {XmlElement} root */
  constructor(root) {
    this.cascade = new Cascade(root, (message) => this.#note(message));
    /** @type {Instance} */
    this.root = { base: root, parent: null, children: null, original: null };
  }

  /** @param {string} message */
  #note(message) {
    this.stripped.set(message, (this.stripped.get(message) ?? 0) + 1);
  }

  /** Find the ids, and note what no drawing has, as the engine of a page does. @param {Pace} pace @returns {Steps<void>} */
  *prepare(pace) {
    const stack = [this.root];
    for (let one = stack.pop(); one; one = stack.pop()) {
      if (pace.isDue()) yield;
      const { attributes, children } = one.base;
      const id = attributes.get('id');
      if (id && !this.#ids.has(id)) this.#ids.set(id, one);
      for (const name of attributes.keys()) if (/^on/i.test(name)) this.#note('script');
      this.#dropInvalid(one);
      for (const child of children) {
        if (child.local === 'script') this.#note('script');
        else if (isAnimation(child)) this.#note('animation');
      }
      for (const child of this.children(one).reverse()) stack.push(child);
    }
  }

  /** Drop the declarations of an element that cannot be computed here, and list them. @param {Instance} element */
  #dropInvalid(element) {
    const declarations = this.cascade.declarations(element.base);
    for (const [name, { value }] of declarations) {
      if (!this.#isKnown(name, value)) {
        this.invalid.push({ name, value, element });
        declarations.delete(name);
      }
    }
  }

  /** @param {string} name @param {string} value @returns {boolean} whether the value of a property can be computed here */
  #isKnown(name, value) {
    if (COMPUTED.test(value) || UNKNOWN_UNIT.test(value)) return false;
    if (!COLORS.has(name) || value.includes('var(') || KEYWORD.test(value)) return true;
    return /currentcolor/i.test(value) || this.isPaint(value);
  }

  /** @param {string} value @returns {boolean} whether it is a colour, a link with or without one, or a word of SVG */
  isPaint(value) {
    const color = value.replace(/^url\([^)]*\)\s*/i, '').trim();
    return /^(?:|none|context-fill|context-stroke)$/i.test(color) || this.color(color) !== null;
  }

  /** @param {Instance} element */
  name = ({ base }) => (isSvg(base.namespace) ? base.local : null);

  /** @param {Instance} element */
  tag = ({ base }) => base.local;

  /** @param {Instance} element */
  isHtml = ({ base }) => base.namespace === 'http://www.w3.org/1999/xhtml';

  /** @param {Instance} element @returns {Instance[]} */
  children(element) {
    element.children ??= element.original
      ? this.children(element.original).map((original) => ({ base: original.base, parent: element, children: null, original: this.original(original) }))
      : element.base.children
          .filter((child) => child.local !== 'script' && !isAnimation(child))
          .map((base) => ({ base, parent: element, children: null, original: null }));
    return [...element.children];
  }

  /** @param {Instance} element */
  count = ({ base }) => countInside(base);

  /** @param {string} name @returns {boolean} */
  has = (name) => holds(this.root.base, name);

  /** @param {Instance} element @param {string} name */
  attribute = ({ base }, name) => base.attributes.get(name) ?? null;

  /** @param {Instance} element */
  link = ({ base }) => base.attributes.get('href') || base.attributes.get('xlink:href') || null;

  /** @param {string} link */
  target(link) {
    const name = /^\s*#(.*?)\s*$/s.exec(link)?.[1];
    return name ? this.#ids.get(name) ?? this.#ids.get(decoded(name)) ?? null : null;
  }

  /** @param {Instance} element */
  style(element) {
    let style = this.#styles.get(element);
    if (!style) this.#styles.set(element, (style = new CascadeStyle(this, element)));
    return style;
  }

  /** @param {Instance} use @param {Instance} target @returns {Instance} */
  instance(use, target) {
    let copy = this.#instances.get(use);
    if (!copy) this.#instances.set(use, (copy = { base: target.base, parent: use, children: null, original: this.original(target) }));
    return copy;
  }

  /** @param {Instance} element @returns {Instance} */
  original = (element) => element.original ?? element;

  /** @param {string} text @returns {[number, number, number, number] | null} */
  color(text) {
    let found = this.#colors.get(text);
    if (found === undefined) this.#colors.set(text, (found = colorOf(text)));
    return found;
  }

  /** @param {string} text @param {Pace} pace @returns {Steps<Engine>} */
  open = (text, pace) => openSvg(text, pace);

  close() {}
}

/** @implements {Style} */
class CascadeStyle {
  /** @type {Map<string, string>} */
  #values = new Map();
  #engine;
  #element;
  /** @type {CascadeStyle | null} */
  #outer;

  /** @param {CascadeEngine} engine @param {Instance} element */
  constructor(engine, element) {
    this.#engine = engine;
    this.#element = element;
    this.#outer = element.parent && engine.style(element.parent);
    this.fontSize = this.#fontSize();
  }

  /** @param {string} name */
  get(name) {
    let value = this.#values.get(name);
    if (value === undefined) {
      if (name.startsWith('--')) this.#values.set(name, ''); // in a cycle no variable has a value
      this.#values.set(name, (value = this.#compute(name)));
    }
    return value;
  }

  /** @param {string} name */
  declared(name) {
    const found = this.#engine.cascade.declarations(this.#element.base).get(name);
    return found && found.weight[0] >= 0 ? this.#substitute(found.value) : '';
  }

  /** @param {string} name */
  opacity(name) {
    const text = this.get(name);
    const value = parseFloat(text) / (text.endsWith('%') ? 100 : 1);
    return Number.isNaN(value) ? 1 : Math.min(Math.max(value, 0), 1);
  }

  /** @param {string} name @returns {string} */
  #compute(name) {
    const { base } = this.#element;
    if (WRITTEN.has(name)) return this.declared(name) || (CSS_ONLY.has(name) ? '' : base.attributes.get(name)?.trim() ?? '');
    let value = this.#specified(name);
    if (COLORS.has(name) && !/currentcolor/i.test(value) && !this.#engine.isPaint(value)) {
      value = INHERITED.has(name) && this.#outer ? this.#outer.get(name) : INITIAL.get(name) ?? ''; // invalid at computed time
    }
    if (COLORS.has(name) && /currentcolor/i.test(value)) return value.replace(/\bcurrentcolor\b/gi, this.get('color'));
    if (name.startsWith('stroke-') && /[a-z]$/i.test(value)) return this.#inPixels(value);
    return value;
  }

  /** @param {string} name @returns {string} */
  #specified(name) {
    const declaration = this.#engine.cascade.declarations(this.#element.base).get(name);
    const isInherited = INHERITED.has(name) || name.startsWith('--');
    let value = declaration ? this.#substitute(declaration.value) : 'unset';
    if (name === 'color' && /^currentcolor$/i.test(value)) value = 'inherit';
    if (!KEYWORD.test(value)) return /^[a-z-]+$/i.test(value) ? value.toLowerCase() : value;
    const inherits = /^inherit$/i.test(value) || (isInherited && !/^initial$/i.test(value));
    return inherits && this.#outer ? this.#outer.get(name) : INITIAL.get(name) ?? '';
  }

  /**
   * Replace variables by their values (CSS Variables 1, 3); `unset` if one has none.
   *
   * @param {string} text
   * @param {number} [depth]
   * @returns {string}
   */
  #substitute(text, depth = 0) {
    const at = text.indexOf('var(');
    if (at < 0) return text;
    if (depth > MOST_NESTED) return 'unset';
    const end = closing(text, at + 3);
    const [, name, , fallback] = /^\s*(--[^\s,]+)\s*(,(.*))?$/s.exec(text.slice(at + 4, end)) ?? [];
    const value = (name && this.get(name)) || fallback;
    if (value === undefined) return 'unset';
    return this.#substitute(text.slice(0, at) + value.trim() + text.slice(end + 1), depth + 1);
  }

  /** @param {string} text @returns {string} with lengths that depend on a font in pixels */
  #inPixels(text) {
    const rem = this.#engine.root === this.#element ? this.fontSize : this.#engine.style(this.#engine.root).fontSize;
    return text.replace(FONT_LENGTH, (_, number, unit) => {
      const size = { em: this.fontSize, rem, ex: this.fontSize / 2, ch: this.fontSize / 2 }[/** @type {'em'} */ (unit.toLowerCase())];
      return `${number * size}px`;
    });
  }

  /** @returns {number} in pixels */
  #fontSize() {
    const outer = this.#outer?.fontSize ?? 16;
    const declaration = this.#engine.cascade.declarations(this.#element.base).get('font-size');
    if (!declaration) return outer;
    const value = this.#substitute(declaration.value).toLowerCase();
    if (value in FONT_SIZES) return FONT_SIZES[value];
    const [, number, unit] = /^([+-]?(?:\d*\.\d+|\d+)(?:e[+-]?\d+)?)\s*([a-z%]*)$/.exec(value) ?? [];
    if (number === undefined) return value === 'initial' ? 16 : outer;
    const units = /** @type {Readonly<Record<string, number>>} */ ({
      '': 1, px: 1, pt: 4 / 3, pc: 16, in: 96, cm: 96 / 2.54, mm: 9.6 / 2.54, q: 2.4 / 2.54, em: outer, rem: 16, ex: outer / 2, '%': outer / 100,
    });
    return unit in units ? Number(number) * units[unit] : outer;
  }
}

/** @param {string | null} namespace */
const isSvg = (namespace) => namespace === SVG || namespace === null;

/** @param {XmlElement} element */
const isAnimation = ({ local, namespace }) => ANIMATIONS.includes(local) && isSvg(namespace);

/** @param {XmlElement} element @param {string} name @returns {boolean} whether an element of a name is inside */
function holds({ children }, name) {
  return children.some((child) => child.local === name || holds(child, name));
}

/** @param {XmlElement} element @returns {number} */
function countInside({ children }) {
  return children.reduce((sum, child) => sum + 1 + countInside(child), 0);
}

/** @param {string} text @param {number} open @returns {number} place of the parenthesis that closes the one at `open` */
function closing(text, open) {
  for (let depth = 0, at = open; at < text.length; at++) {
    depth += Number(text[at] === '(') - Number(text[at] === ')');
    if (depth === 0) return at;
  }
  return text.length;
}

/** @param {string} name @returns {string} it without the escapes of URLs */
function decoded(name) {
  try {
    return decodeURIComponent(name);
  } catch {
    return name;
  }
}

/** @param {string} text @returns {[number, number, number, number] | null} sRGB and opacity; null if it is no colour */
function colorOf(text) {
  const color = toRgb(parseColor(text.trim()));
  if (!color) return null;
  const clamp = (/** @type {number | undefined} */ part) => Math.min(Math.max(part ?? 0, 0), 1);
  return [clamp(color.r), clamp(color.g), clamp(color.b), clamp(color.alpha ?? 1)];
}
