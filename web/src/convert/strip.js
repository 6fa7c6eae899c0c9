// Removal of everything that runs, moves or is fetched, with notes of what a drawing loses.
import { ANIMATIONS } from '../../generated/svg-reader.js';
import { SVG } from './parse.js';

/** Attributes with links. */
const LINKS = ['href', 'xlink:href'];

const HTML = 'http://www.w3.org/1999/xhtml';

/**
 * Remove scripts, animations, HTML, links and imports of a document.
 *
 * @param {Element} root
 * @returns {{ links: Map<Element, string>, sheets: string, stripped: Map<string, number> }} links by element, the text of
 *   its style sheets, and messages on what is left out
 */
export function strip(root) {
  /** @type {Map<Element, string>} */
  const links = new Map();
  /** @type {Map<string, number>} */
  const stripped = new Map();
  const sheets = [];
  const note = (/** @type {string} */ message) => stripped.set(message, (stripped.get(message) ?? 0) + 1);
  for (const element of [root, ...root.getElementsByTagName('*')]) {
    const name = element.localName;
    const link = LINKS.map((one) => element.getAttribute(one)).find(Boolean);
    if (link) links.set(element, link);
    for (const attribute of [...element.attributes]) {
      if (attribute.localName.startsWith('on')) note('script');
      if (attribute.localName.startsWith('on') || attribute.localName === 'href' || attribute.localName === 'src') element.removeAttributeNode(attribute);
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
  const text = sheets.join('\n');
  if (/@(?:-webkit-)?keyframes\b/i.test(text) && /[\s;{]animation(?:-name)?\s*:/i.test(text)) note('animation');
  return { links, sheets: text, stripped };
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
