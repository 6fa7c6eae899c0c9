// A copy of an `<svg>` of the page, with the styles that the page gives it.
import { VextureError, line } from '../errors.js';
import { SVG, checkCount } from './parse.js';

/** Inherited properties that a reader asks for. */
export const INHERITED = [
  'color', 'fill', 'fill-opacity', 'fill-rule', 'clip-rule', 'stroke', 'stroke-width', 'stroke-opacity', 'stroke-linecap',
  'stroke-linejoin', 'stroke-miterlimit', 'stroke-dasharray', 'stroke-dashoffset', 'paint-order', 'visibility', 'marker-start',
  'marker-mid', 'marker-end', 'font-size',
];

/** Others that the page may set by its style sheets. */
const OWN = [
  'opacity', 'display', 'clip-path', 'mask-image', 'filter', 'mix-blend-mode', 'isolation', 'stop-color', 'stop-opacity',
  'transform', 'transform-origin', 'vector-effect', 'd', 'cx', 'cy', 'r', 'x', 'y', 'width', 'height',
];

const REFERENCE = /(?:url\(\s*['"]?|^\s*)#([^'")\s]+)/g;

/** @typedef {{ live: Element, copy: Element }} Pair */

/**
 * Copy an `<svg>` of the page, with the elements elsewhere in the page to which it refers.
 *
 * @param {Element} element
 * @returns {{ root: Element, pairs: Pair[] }} the copy, and each copied element with its original
 */
export function copyElement(element) {
  if (element.namespaceURI !== SVG || element.localName !== 'svg') {
    throw new VextureError(`the element is <${line(element.localName)}>; give an <svg> of the page`, 'element');
  }
  checkCount(element.getElementsByTagName('*').length);
  const root = /** @type {Element} */ (element.cloneNode(true));
  const pairs = pairUp(element, root);
  const ids = new Set(pairs.map(({ copy }) => copy.id));
  for (let k = 0; k < pairs.length; k++) { // grows below
    for (const id of referencesOf(pairs[k].copy)) {
      const live = ids.has(id) ? null : element.ownerDocument.getElementById(id);
      if (!live) continue;
      const copy = /** @type {Element} */ (live.cloneNode(true));
      const holder = element.ownerDocument.createElementNS(SVG, 'defs');
      holder.append(copy);
      root.append(holder);
      const more = pairUp(live, copy);
      for (const pair of more) ids.add(pair.copy.id);
      pairs.push(...more);
    }
  }
  sizeRoot(element, root);
  copyVariables(element, root);
  return { root, pairs };
}

/** @param {Element} live @param {Element} copy @returns {Pair[]} all elements in both */
function pairUp(live, copy) {
  const copies = [copy, ...copy.getElementsByTagName('*')];
  return [live, ...live.getElementsByTagName('*')].map((one, k) => ({ live: one, copy: copies[k] }));
}

/** @param {Element} element @returns {string[]} ids to which its attributes refer */
function referencesOf(element) {
  return [...element.attributes].flatMap(({ value }) => [...value.matchAll(REFERENCE)].map((match) => match[1]));
}

/** Give the copy the size in the page, if it has none of its own. @param {Element} live @param {Element} copy */
function sizeRoot(live, copy) {
  if (copy.hasAttribute('viewBox')) return;
  const style = getComputedStyle(live);
  for (const name of /** @type {const} */ (['width', 'height'])) {
    if (!copy.hasAttribute(name) && parseFloat(style[name]) > 0) copy.setAttribute(name, style[name]);
  }
}

/** Give the copy the values of the custom properties to which it refers. @param {Element} live @param {Element} copy */
function copyVariables(live, copy) {
  const style = getComputedStyle(live);
  for (const [, name] of copy.outerHTML.matchAll(/var\(\s*(--[^\s,()]+)/g)) {
    const value = style.getPropertyValue(name);
    if (value) /** @type {SVGElement} */ (copy).style.setProperty(name, value);
  }
}

/**
 * Write the styles that the page gives elements, where they differ from those of their copies.
 *
 * @param {Pair[]} pairs
 * @param {Window} window of the copies
 * @param {import('./pace.js').Pace} pace
 * @returns {import('./pace.js').Steps<void>}
 */
export function* copyStyles(pairs, window, pace) {
  const values = [];
  for (const [k, { live }] of pairs.entries()) {
    if (pace.isDue()) yield;
    const style = getComputedStyle(live);
    const names = k ? [...INHERITED, ...OWN] : INHERITED;
    values.push(new Map(names.map((name) => [name, style.getPropertyValue(name)])));
  }
  for (const [k, { copy }] of pairs.entries()) {
    if (pace.isDue()) yield;
    if (!copy.isConnected) continue;
    const computed = window.getComputedStyle(copy);
    const hasVariables = (/** @type {string} */ name) => {
      return `${copy.getAttribute(name)} ${copy.getAttribute('style')}`.includes('var(');
    };
    for (const [name, value] of values[k]) {
      const isSame = !value || computed.getPropertyValue(name) === value || hasVariables(name);
      if (!isSame) /** @type {SVGElement} */ (copy).style.setProperty(name, value, 'important');
    }
  }
}
