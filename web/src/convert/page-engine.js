// The document and its styles, by the browser's own engine: in a frame without scripts and network.
import { VextureError } from '../errors.js';
import { hasUnits } from './affine.js';
import { INHERITED, copyElement, copyStyles } from './element.js';
import { closeFrame, openFrame } from './frame.js';
import { SVG, parseSvg } from './parse.js';
import { strip } from './strip.js';

/** @import { Pace, Steps } from './pace.js' */

/**
 * @typedef {object} Style computed values of an element's properties, as text
 * @property {(name: string) => string} get lengths and transforms as written, where that is known
 * @property {(name: string) => string} declared value of a property by CSS, not by an attribute; empty without one
 * @property {(name: string) => number} opacity
 * @property {number} fontSize in user units
 *
 * @typedef {object} Engine what a reader needs of a document; elements are opaque to it
 * @property {any} root the outermost `<svg>`
 * @property {ReadonlyMap<string, number>} stripped messages on parts that were left out, with their numbers
 * @property {readonly { name: string, value: string, element: any }[]} invalid attributes with values that are not valid
 * @property {(element: any) => string | null} name of an SVG element; null for other namespaces
 * @property {(element: any) => string} tag local name in any namespace
 * @property {(element: any) => boolean} isHtml
 * @property {(element: any) => any[]} children a new list of elements
 * @property {(element: any) => number} count number of elements inside
 * @property {(name: string) => boolean} has whether the document has elements of a name
 * @property {(element: any, name: string) => string | null} attribute
 * @property {(element: any) => string | null} link value of `href`
 * @property {(link: string) => any} target the element that "#name" refers to, or null
 * @property {(element: any) => Style} style
 * @property {(use: any, target: any) => any} instance a copy of an element, whose style is that inside a `use`
 * @property {(element: any) => any} original the element of which another one is a copy, or itself
 * @property {(text: string) => [number, number, number, number] | null} color sRGB and opacity, 0..1
 * @property {(text: string, pace: Pace) => Steps<Engine>} open another document, which closes with this one
 * @property {() => void} close
 */

/** Properties of which the text counts as it is written, because computed values are rounded to six digits. */
const WRITTEN = new Set([
  'x', 'y', 'width', 'height', 'cx', 'cy', 'r', 'rx', 'ry', 'd', 'transform', 'transform-origin', 'transform-box',
  'translate', 'rotate', 'scale', 'offset-path',
]);

/** Those of them that are no presentation attributes. */
const CSS_ONLY = new Set(['translate', 'rotate', 'scale', 'offset-path']);

/** Inherited properties with numbers. */
const NUMERIC = new Set(['stroke-width', 'stroke-dasharray', 'stroke-dashoffset', 'stroke-miterlimit']);

/** Values that only the browser computes. */
const KEYWORD = /^(?:inherit|initial|unset|revert(?:-layer)?)$/i;
const PLANE = /^(?:\s*(?:matrix|translate[xy]?|scale[xy]?|rotate|skew[xy]?)\([^()]*\))+\s*$/i;

const COLOR = /^(?:rgba?\(|color\(srgb )([^)]*)\)$/;

/**
 * Open a document in a frame of the page; an `<svg>` of the page keeps the colours and variables that it has there.
 *
 * @param {string | Element} source markup, or an element
 * @param {Pace} pace
 * @returns {Steps<Engine>}
 * @throws {VextureError} if it is no SVG, or exceeds a limit
 */
export function* openSvg(source, pace) {
  if (typeof document === 'undefined') {
    throw new VextureError(
      'SVG is read in a page, and there is no document here; read it there, or give contours',
      'document',
    );
  }
  if (typeof source === 'string') return yield* engineOf(parseSvg(source), pace);
  const { root, pairs } = copyElement(source);
  const engine = yield* engineOf(root, pace);
  try {
    yield* copyStyles(pairs, engine.window, pace);
  } catch (error) {
    engine.close();
    throw error;
  }
  return engine;
}

/** @param {Element} parsed root of a document that is not shown @param {Pace} pace @returns {Steps<PageEngine>} */
function* engineOf(parsed, pace) {
  return new PageEngine(parsed, yield* strip(parsed, pace));
}

/** @implements {Engine} */
class PageEngine {
  /**
   * @param {Element} parsed root of a document that is not shown
   * @param {import('./strip.js').Stripped} parts of it
   */
  constructor(parsed, { links, sheets, stripped, invalid }) {
    this.links = links;
    this.sheets = sheets;
    this.stripped = stripped;
    this.invalid = invalid.map(({ localName, value, ownerElement }) => ({ name: localName, value, element: ownerElement }));
    this.frame = openFrame(parsed);
    this.root = parsed;
    this.window = /** @type {Window} */ (this.frame.contentWindow);
    /** @type {Map<string, Element> | null} */
    this.ids = null;
    /** @type {Map<Element, Style>} */
    this.styles = new Map();
    /** @type {Map<Element, Element>} */
    this.originals = new Map();
    /** Copies of an element, by what they inherit. @type {Map<Element, Map<Element | string, Element>>} */
    this.instances = new Map();
    /** Custom properties may differ at uses that are alike otherwise. */
    this.hasVariables = /var\(/i.test(parsed.outerHTML);
    /** @type {Set<Element>} */
    this.wrappers = new Set();
    /** @type {Map<string, [number, number, number, number] | null>} */
    this.colors = new Map();
    /** @type {Map<string, boolean>} */
    this.mentioned = new Map();
    /** @type {Engine[]} */
    this.opened = [];
    /** @type {CSSStyleDeclaration | null} */
    this.probe = null;
    this.original = (/** @type {Element} */ element) => this.originals.get(element) ?? element;
  }

  /** @param {Element} element */
  name(element) {
    return element.namespaceURI === SVG ? element.localName : null;
  }

  /** @param {Element} element */
  tag(element) {
    return element.localName;
  }

  /** @param {Element} element */
  isHtml(element) {
    return element.namespaceURI === 'http://www.w3.org/1999/xhtml';
  }

  /** @param {Element} element @returns {Element[]} */
  children(element) {
    return [...element.children].filter((child) => !this.wrappers.has(child));
  }

  /** @param {Element} element */
  count(element) {
    return element.getElementsByTagName('*').length;
  }

  /** @param {string} name */
  has(name) {
    return this.root.getElementsByTagName(name).length > 0;
  }

  /** @param {Element} element @param {string} name */
  attribute(element, name) {
    return element.getAttribute(name);
  }

  /** @param {Element} element */
  link(element) {
    return this.links.get(this.original(element)) ?? null;
  }

  /** @param {string} link */
  target(link) {
    const name = /^\s*#(.*?)\s*$/s.exec(link)?.[1];
    if (!name) return null;
    if (!this.ids) {
      this.ids = new Map();
      for (const one of this.root.getElementsByTagName('*')) {
        if (one.id && !this.originals.has(one) && !this.wrappers.has(one) && !this.ids.has(one.id)) this.ids.set(one.id, one);
      }
      if (this.root.id) this.ids.set(this.root.id, this.root);
    }
    return this.ids.get(name) ?? this.ids.get(decoded(name)) ?? this.ids.get(unescaped(name)) ?? null;
  }

  /** @param {Element} element @returns {Style} */
  style(element) {
    let style = this.styles.get(element);
    if (!style) this.styles.set(element, (style = new PageStyle(this, element, this.window.getComputedStyle(element))));
    return style;
  }

  /** @param {string} name @returns {boolean} whether a style sheet may set a property */
  mentions(name) {
    let found = this.mentioned.get(name);
    if (found === undefined) {
      found = new RegExp(`(?:^|[^\\w-])${name}\\s*:`, 'i').test(this.sheets);
      this.mentioned.set(name, found);
    }
    return found;
  }

  /**
   * The copy stands inside a copy of the `use`, so that it inherits what it inherits there. Uses that pass on the same
   * share a copy.
   *
   * @param {Element} use
   * @param {Element} target
   * @returns {Element}
   */
  instance(use, target) {
    const style = this.style(use);
    const values = INHERITED.map((name) => style.get(name));
    const key = this.hasVariables ? use : JSON.stringify(values);
    const copies = this.instances.get(target) ?? new Map();
    this.instances.set(target, copies);
    let copy = copies.get(key);
    if (!copy) copies.set(key, (copy = this.copyInto(use, target)));
    return copy;
  }

  /** @param {Element} use @param {Element} target @returns {Element} */
  copyInto(use, target) {
    const wrapper = use.ownerDocument.createElementNS(SVG, 'g');
    for (const { name, value } of use.attributes) if (/^[a-z-]+$/i.test(name)) wrapper.setAttribute(name, value);
    const copy = /** @type {Element} */ (target.cloneNode(true));
    this.pair(target, copy);
    wrapper.append(copy);
    this.wrappers.add(wrapper);
    use.parentNode?.append(wrapper); // at the end, where it changes the numbers of no siblings before it
    return copy;
  }

  /** Remember the original of each element of a copy. @param {Element} original @param {Element} copy */
  pair(original, copy) {
    this.originals.set(copy, this.original(original));
    const copies = [...copy.children];
    [...original.children].forEach((child, k) => {
      if (this.wrappers.has(child)) copies[k].remove();
      else this.pair(child, copies[k]);
    });
  }

  /** @param {string} text @returns {[number, number, number, number] | null} */
  color(text) {
    let found = this.colors.get(text);
    if (found === undefined) this.colors.set(text, (found = rgbOf(text) ?? rgbOf(this.inSrgb(text))));
    return found;
  }

  /** @param {string} text @returns {string} the color, converted by the browser */
  inSrgb(text) {
    if (!this.probe) {
      const wrapper = this.root.ownerDocument.createElementNS(SVG, 'g');
      this.wrappers.add(wrapper);
      this.root.append(wrapper);
      this.probe = /** @type {SVGElement} */ (wrapper).style;
      this.probeStyle = this.window.getComputedStyle(wrapper);
    }
    this.probe.color = `color(from ${text} srgb r g b / alpha)`;
    return this.probe.color ? this.probeStyle?.color ?? '' : '';
  }

  /** @param {string} text @param {Pace} pace @returns {Steps<Engine>} */
  *open(text, pace) {
    const engine = yield* engineOf(parseSvg(text), pace);
    this.opened.push(engine);
    return engine;
  }

  close() {
    closeFrame(this.frame);
    for (const engine of this.opened) engine.close();
  }
}

/** @param {string} text @returns {[number, number, number, number] | null} a color in sRGB; null for other notations */
function rgbOf(text) {
  const parts = COLOR.exec(text)?.[1].split(/[\s,/]+/).filter(Boolean);
  if (!parts || parts.length < 3) return null;
  const whole = text.startsWith('rgb') ? 255 : 1;
  const [red, green, blue, alpha] = parts.map((part, k) => (part === 'none' ? 0 : parseFloat(part) / (k < 3 ? whole : 1)));
  const clamp = (/** @type {number} */ value) => Math.min(Math.max(value, 0), 1);
  return [clamp(red), clamp(green), clamp(blue), clamp(alpha ?? 1)];
}

/** @param {string} name @returns {string} it without the escapes of URLs */
function decoded(name) {
  try {
    return decodeURIComponent(name);
  } catch {
    return name;
  }
}

/** @param {string} name @returns {string} it without the escapes of CSS */
function unescaped(name) {
  return name.replace(/\\(?:([\da-f]{1,6})\s?|(.))/gis, (_, code, letter) => {
    return letter ?? String.fromCodePoint(Math.min(parseInt(code, 16) || 0xfffd, 0x10ffff));
  });
}

/** @implements {Style} */
class PageStyle {
  /** @param {PageEngine} engine @param {Element} element @param {CSSStyleDeclaration} computed */
  constructor(engine, element, computed) {
    this.engine = engine;
    this.element = element;
    this.computed = computed;
    this.fontSize = parseFloat(computed.getPropertyValue('font-size')) || 16;
    /** @type {Map<string, string>} */
    this.values = new Map();
  }

  /** @param {string} name */
  get(name) {
    let value = this.values.get(name);
    if (value === undefined) this.values.set(name, (value = this.read(name)));
    return value;
  }

  /** @param {string} name @returns {string} */
  read(name) {
    if (WRITTEN.has(name)) return this.declared(name) || (CSS_ONLY.has(name) ? '' : this.attribute(name));
    const found = this.computed.getPropertyValue(name === 'mask' ? 'mask-image' : name) || 'none';
    const value = found.includes('url(') ? found.replaceAll(new URL('.', document.baseURI).href, '') : found; // as written
    return NUMERIC.has(name) && value.replace(/\D/g, '').length > 5 ? this.exact(name, value) : value;
  }

  /**
   * @param {string} name
   * @returns {string} the text of a presentation attribute, where the browser accepts units in it
   */
  attribute(name) {
    const text = this.element.getAttribute(name)?.trim() ?? '';
    const isComputed = name === 'transform' ? hasUnits(text) : name !== 'd' && text.includes('(');
    return isComputed ? this.computed.getPropertyValue(name) : text;
  }

  /** @param {string} name @returns {number} */
  opacity(name) {
    const value = parseFloat(this.computed.getPropertyValue(name));
    return Number.isNaN(value) ? 1 : Math.min(Math.max(value, 0), 1);
  }

  /** @param {string} name @returns {string} */
  declared(name) {
    const inline = inlineText(this.element, name);
    if (inline && !this.engine.mentions(name) && isPlain(name, inline)) return inline;
    if (!inline && !this.engine.mentions(name)) return '';
    const value = this.computed.getPropertyValue(name);
    const attribute = this.element.getAttribute(name);
    if (attribute === null || CSS_ONLY.has(name)) return value;
    return value === 'auto' || value === '' || isRounded(value, attribute) ? attribute : value;
  }

  /**
   * @param {string} name
   * @param {string} value rounded
   * @returns {string} the text from which it comes, if that is known
   */
  exact(name, value) {
    for (let one = /** @type {Element | null} */ (this.element); one; one = one.parentElement) {
      const text = inlineText(one, name) ?? one.getAttribute(name);
      if (text !== null) return isRounded(value, text) ? text : value;
    }
    return value;
  }
}

/**
 * @param {string} name
 * @param {string} text
 * @returns {boolean} whether a value of a declaration needs no computation by the browser
 */
function isPlain(name, text) {
  if (name === 'transform') return PLANE.test(text) || text === 'none';
  return !KEYWORD.test(text) && (name === 'd' || !text.includes('('));
}

/**
 * @param {string} value
 * @param {string} text
 * @returns {boolean} whether a value consists of the numbers in a text, rounded
 */
function isRounded(value, text) {
  if (/[a-oq-wyz%(]/i.test(text.replace(/e[+-]?\d/gi, ''))) return false; // other units than pixels
  const [rounded, exact] = [value, text].map((one) => (one.match(/[+-]?(?:\d*\.\d+|\d+)(?:e[+-]?\d+)?/gi) ?? []).map(Number));
  return rounded.length === exact.length && exact.every((number, k) => Math.abs(number - rounded[k]) <= 1e-5 * Math.abs(number));
}

/**
 * @param {Element} element
 * @param {string} name
 * @returns {string | null} the text of a valid declaration in its `style`
 */
function inlineText(element, name) {
  const text = element.getAttribute('style');
  if (!text?.includes(name)) return null;
  if (!(/** @type {SVGElement} */ (element).style?.getPropertyValue(name))) return null;
  const all = [...text.matchAll(new RegExp(`(?:^|;)\\s*${name}\\s*:([^;]*)`, 'gi'))];
  return all.length ? all[all.length - 1][1].replace(/!\s*important\s*$/i, '').trim() : null;
}
