// Removal of everything that runs, moves or is fetched, with notes of what a drawing loses.
import { ANIMATIONS } from '../../generated/svg-reader.js';
import { SVG } from './parse.js';
import { shortenText } from './report.js';

/** Attributes with links. */
const LINKS = ['href', 'xlink:href'];

/** Presentation attributes of which the browser says whether a value is valid. */
const CHECKED = new Set([
  'clip-rule', 'color', 'fill', 'fill-opacity', 'fill-rule', 'opacity', 'paint-order', 'stop-color', 'stop-opacity', 'stroke',
  'stroke-linecap', 'stroke-linejoin', 'stroke-opacity', 'visibility',
]);

const HTML = 'http://www.w3.org/1999/xhtml';

/**
 * @typedef {{ links: Map<Element, string>, sheets: string, stripped: Map<string, number>, invalid: Attr[] }} Stripped links by
 *   element, the text of style sheets, messages on what is left out, and attributes with values that are not valid
 */

/**
 * Remove scripts, animations, HTML, links and imports of a document.
 *
 * @param {Element} root
 * @param {import('./pace.js').Pace} pace
 * @returns {import('./pace.js').Steps<Stripped>}
 */
export function* strip(root, pace) {
  /** @type {Map<Element, string>} */
  const links = new Map();
  /** @type {Map<string, number>} */
  const stripped = new Map();
  /** @type {string[]} */
  const sheets = [];
  /** @type {Attr[]} */
  const invalid = [];
  const note = (/** @type {string} */ message) => stripped.set(message, (stripped.get(message) ?? 0) + 1);
  for (const element of [root, ...root.getElementsByTagName('*')]) {
    if (pace.isDue()) yield;
    const name = element.localName;
    const link = LINKS.map((one) => element.getAttribute(one)).find(Boolean);
    if (link) links.set(element, link);
    for (const attribute of [...element.attributes]) {
      const own = attribute.localName;
      if (own.startsWith('on')) note('script');
      if (own.startsWith('on') || own === 'href' || own === 'src') element.removeAttributeNode(attribute);
      else if (isInvalid(attribute, name)) invalid.push(attribute);
    }
    if (element.namespaceURI === HTML) {
      if (!element.closest('foreignObject')) note(`<${name.slice(0, 40)}>, of another namespace`);
      element.remove();
    } else if (name === 'script') {
      note('script');
      element.remove();
    } else if (ANIMATIONS.includes(name) && element.namespaceURI === SVG) {
      note('animation');
      element.remove();
    } else if (name === 'style') sheets.push(withoutImports(element, note));
  }
  for (let one = root.previousSibling; one; one = one.previousSibling) {
    const sheet = one.nodeName === 'xml-stylesheet' ? /\bhref\s*=\s*(['"])(.*?)\1/s.exec(one.nodeValue ?? '') : null;
    if (sheet) note(`style sheet '${shortenText(sheet[2], 40)}'`);
  }
  const text = sheets.join('\n');
  if (/@(?:-webkit-)?keyframes\b/i.test(text) && /[\s;{]animation(?:-name)?\s*:/i.test(text)) note('animation');
  return { links, sheets: text, stripped, invalid };
}

/**
 * @param {Attr} attribute
 * @param {string} element name of its element; attributes of animations have other meanings
 * @returns {boolean} whether the browser ignores its value
 */
function isInvalid({ localName, value }, element) {
  return CHECKED.has(localName) && !ANIMATIONS.includes(element) && value.trim() !== '' && !CSS.supports(localName, value);
}

/** @param {Element} sheet @param {(message: string) => void} note @returns {string} its text */
function withoutImports(sheet, note) {
  const text = sheet.textContent ?? '';
  const kept = text.replace(/@import\b(?:"[^"]*"|'[^']*'|[^;"'])*;?/gi, () => {
    note('@import');
    return '';
  });
  if (kept !== text) sheet.textContent = kept;
  return kept.replace(/\/\*.*?\*\//gs, ' ');
}
