// The cascade of CSS where no browser computes it: declarations of style sheets, attributes and inheritance.
import { compile } from 'css-select';
import { generate, lexer, parse as parseCss } from 'css-tree';

/** @typedef {import('./parse-xml.js').XmlElement} XmlElement */

/** @typedef {{ value: string, weight: readonly [number, number, number, number] }} Declaration weight: importance, specificity (two), order */

/**
 * @typedef {object} Rule
 * @property {(element: XmlElement) => boolean} matches
 * @property {number} specificity
 * @property {{ name: string, value: string, important: boolean }[]} declarations
 */

/** Presentation attributes of SVG 2 that a drawing depends on, besides those of geometry. */
const ATTRIBUTES = new Set([
  'clip-path', 'clip-rule', 'color', 'color-interpolation', 'display', 'fill', 'fill-opacity', 'fill-rule', 'filter', 'font-size',
  'image-rendering', 'isolation', 'marker-end', 'marker-mid', 'marker-start', 'mask', 'mask-type', 'mix-blend-mode', 'opacity', 'overflow', 'paint-order',
  'stop-color', 'stop-opacity', 'stroke', 'stroke-dasharray', 'stroke-dashoffset', 'stroke-linecap', 'stroke-linejoin',
  'stroke-miterlimit', 'stroke-opacity', 'stroke-width', 'transform', 'transform-origin', 'vector-effect', 'visibility',
]);

/** Properties that CSS spells out as several. */
const SHORTHANDS = /** @type {Readonly<Record<string, readonly string[]>>} */ ({
  marker: ['marker-start', 'marker-mid', 'marker-end'],
  'mask-image': ['mask'],
  background: ['background-color'],
});

/** Properties of which css-tree does not know the syntax, or not all of it. */
const UNCHECKED = new Set(['color-interpolation', 'stroke-linejoin', 'transform', 'mask', 'd']);

/** Style that browsers give to elements (SVG 2, "User agent style sheet"). */
const CLIPPING = new Set(['svg', 'symbol', 'marker', 'pattern', 'image']);

const LIGHT_SCREEN = /** @type {Readonly<Record<string, string>>} */ ({
  'prefers-color-scheme': 'light', 'prefers-reduced-motion': 'no-preference', 'prefers-contrast': 'no-preference', hover: 'hover', pointer: 'fine',
});

/** How css-select reads elements. */
const adapter = {
  isTag: (/** @type {XmlElement} */ node) => Boolean(node.local),
  getAttributeValue: (/** @type {XmlElement} */ { attributes }, /** @type {string} */ name) => attributes.get(name),
  getChildren: (/** @type {XmlElement} */ { children }) => children,
  getName: (/** @type {XmlElement} */ { local }) => local,
  getParent: (/** @type {XmlElement} */ { parent }) => parent,
  getSiblings: (/** @type {XmlElement} */ element) => element.parent?.children ?? [element],
  getText: (/** @type {XmlElement} */ { text }) => text,
  hasAttrib: (/** @type {XmlElement} */ { attributes }, /** @type {string} */ name) => attributes.has(name),
  removeSubsets: (/** @type {XmlElement[]} */ nodes) => nodes,
};

/** The declarations of one document. */
export class Cascade {
  /** @type {Rule[]} */
  #rules = [];
  /** @type {Map<XmlElement, Map<string, Declaration>>} */
  #declared = new Map();
  #note;

  /**
   * @param {XmlElement} root
   * @param {(message: string) => void} note counts what is left out
   */
  constructor(root, note) {
    this.#note = note;
    for (const sheet of sheetsIn(root)) this.#addSheet(sheet);
  }

  /**
   * Values that an element declares, by property: of attributes, then of style sheets, then of its attribute `style`.
   *
   * @param {XmlElement} element
   * @returns {Map<string, Declaration>}
   */
  declarations(element) {
    let found = this.#declared.get(element);
    if (!found) this.#declared.set(element, (found = this.#collect(element)));
    return found;
  }

  /** @param {XmlElement} element */
  #collect(element) {
    /** @type {Map<string, Declaration>} */
    const found = new Map();
    const add = (/** @type {string} */ name, /** @type {string} */ value, /** @type {Declaration['weight']} */ weight) => {
      for (const one of SHORTHANDS[name] ?? [name]) {
        const before = found.get(one);
        if (!before || !isLess(weight, before.weight)) found.set(one, { value, weight });
      }
    };
    if (CLIPPING.has(element.local) && element.parent) add('overflow', 'hidden', [-2, 0, 0, 0]);
    for (const [name, value] of element.attributes) {
      const text = name === 'font-size' && value.trim() && !Number.isNaN(Number(value)) ? `${value}px` : value;
      if (ATTRIBUTES.has(name) && isValid(name, text)) add(name, text.trim(), [-1, 0, 0, 0]);
    }
    this.#rules.forEach(({ matches, specificity, declarations }, order) => {
      if (!matches(element)) return;
      for (const { name, value, important } of declarations) add(name, value, [Number(important), 0, specificity, order]);
    });
    for (const { name, value, important } of declarationsOf(element.attributes.get('style') ?? '')) {
      add(name, value, [Number(important), 1, 0, 0]);
    }
    return found;
  }

  /** @param {string} text */
  #addSheet(text) {
    this.#addRules(parseCss(text, { parseValue: false, onParseError: () => {} }));
  }

  /** @param {any} block with rules in their order */
  #addRules({ children }) {
    children.forEach((/** @type {any} */ node) => {
      if (node.type === 'Rule') this.#addRule(node);
      else if (node.type === 'Atrule' && node.name === 'import') this.#note('@import');
      else if (node.type === 'Atrule' && node.block && this.#applies(node)) this.#addRules(node.block);
    });
  }

  /** @param {any} node a rule with rules inside */
  #applies({ name, prelude }) {
    const text = prelude ? generate(prelude) : '';
    if (name === 'layer' || name === 'supports') return !/^\s*not\b/i.test(text);
    if (name !== 'media') return false;
    const isTrue = mediaOf(text);
    if (isTrue === null) this.#note(`@media ${text.slice(0, 40)}`);
    return isTrue === true;
  }

  /** @param {any} node */
  #addRule({ prelude, block }) {
    if (prelude.type !== 'SelectorList') return;
    const parts = block.children.toArray();
    if (parts.some((/** @type {any} */ { type }) => type === 'Rule')) this.#note('nested CSS rule');
    const declarations = parts.flatMap(declarationOf);
    prelude.children.forEach((/** @type {any} */ selector) => {
      try {
        const matches = /** @type {any} */ (compile(generate(selector), { xmlMode: true, adapter: /** @type {any} */ (adapter) }));
        this.#rules.push({ matches, specificity: specificityOf(selector), declarations });
      } catch {
        this.#note(`CSS selector ${generate(selector).slice(0, 40)}`);
      }
    });
  }
}

/**
 * Texts of the style sheets in a document.
 *
 * @param {XmlElement} element
 * @returns {string[]}
 */
function sheetsIn({ local, attributes, text, children }) {
  if (local !== 'style') return children.flatMap(sheetsIn);
  const isCss = /^(?:text\/css)?$/i.test((attributes.get('type') ?? '').trim());
  return isCss && mediaOf(attributes.get('media') ?? '') ? [text] : [];
}

/**
 * Whether a list of media queries holds for a light screen; null if that depends on more.
 *
 * @param {string} text
 * @returns {boolean | null}
 */
export function mediaOf(text) {
  if (!text.trim()) return true;
  const values = text.toLowerCase().split(',').map((query) => {
    const [, negated, rest] = /^\s*(?:(not)\s|only\s)?\s*(.*?)\s*$/s.exec(query) ?? [];
    const parts = rest.split(/\)?\s*\band\b\s*\(?|[()]/).map((part) => part.trim()).filter(Boolean).map(featureOf);
    const isTrue = parts.includes(false) ? false : parts.includes(null) ? null : true;
    return isTrue === null || !negated ? isTrue : !isTrue;
  });
  return values.includes(true) ? true : values.includes(null) ? null : false;
}

/** @param {string} text a type of media, or a feature without its parentheses @returns {boolean | null} */
function featureOf(text) {
  if (['all', 'screen'].includes(text)) return true;
  if (/^[a-z]+$/.test(text)) return text in LIGHT_SCREEN ? true : false;
  const [name, value] = text.split(/\s*:\s*/);
  return name in LIGHT_SCREEN ? LIGHT_SCREEN[name] === value : null;
}

/**
 * Valid declarations of an attribute `style`.
 *
 * @param {string} text
 */
export function declarationsOf(text) {
  if (!text.trim()) return [];
  const list = /** @type {any} */ (parseCss(text, { context: 'declarationList', parseValue: false, onParseError: () => {} }));
  return list.children.toArray().flatMap(declarationOf);
}

/**
 * @param {any} node
 * @returns {Rule['declarations']} none if it is no declaration, or not valid
 */
function declarationOf(node) {
  if (node.type !== 'Declaration') return [];
  const name = node.property.startsWith('--') ? node.property : node.property.toLowerCase();
  const value = (node.value.value ?? generate(node.value)).trim();
  return isValid(name, value) ? [{ name, value, important: Boolean(node.important) }] : [];
}

/** @param {string} name @param {string} value @returns {boolean} whether a property may have a value */
function isValid(name, value) {
  if (name.startsWith('--') || UNCHECKED.has(name) || value.includes('var(')) return value.trim() !== '';
  const { error } = lexer.matchProperty(name, value);
  return !error || /Unknown property/.test(error.message);
}

/** @param {Declaration['weight']} one @param {Declaration['weight']} other */
function isLess(one, other) {
  const k = one.findIndex((part, place) => part !== other[place]);
  return k >= 0 && one[k] < other[k];
}

/**
 * Specificity (Selectors 4, 17) as one number.
 *
 * @param {any} node
 * @returns {number}
 */
function specificityOf(node) {
  const inner = () => Math.max(0, ...(node.children?.toArray() ?? []).flatMap((/** @type {any} */ one) =>
    one.type === 'SelectorList' ? one.children.toArray().map(specificityOf) : one.type === 'Selector' ? [specificityOf(one)] : []));
  switch (node.type) {
    case 'Selector': return node.children.toArray().reduce((/** @type {number} */ sum, /** @type {any} */ one) => sum + specificityOf(one), 0);
    case 'IdSelector': return 1e6;
    case 'ClassSelector': case 'AttributeSelector': return 1e3;
    case 'PseudoClassSelector':
      return node.name === 'where' ? 0 : ['is', 'not', 'has'].includes(node.name) ? inner() : 1e3;
    case 'TypeSelector': return node.name === '*' ? 0 : 1;
    case 'PseudoElementSelector': return 1;
    default: return 0;
  }
}
