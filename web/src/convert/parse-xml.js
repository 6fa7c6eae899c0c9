// Parsing of markup where there is no document, as in Node.js: elements as plain objects, within the limits of a page.
import { SaxesParser } from 'saxes';
import { VextureError, line } from '../errors.js';
import { KNOWN, SVG, checkElement, checkName, checkSize } from './parse.js';

/** Letters that are parsed between two turns of the page. */
const PART = 2 ** 16;

/**
 * An element.
 *
 * @typedef {object} XmlElement
 * @property {string} local name without its prefix
 * @property {string | null} namespace
 * @property {Map<string, string>} attributes by their names; those of another namespace keep their prefix
 * @property {XmlElement | null} parent
 * @property {XmlElement[]} children
 * @property {string} text of it and all inside
 */

/**
 * Parse an SVG document.
 *
 * @param {string} text
 * @param {import('./pace.js').Pace} pace
 * @returns {import('./pace.js').Steps<XmlElement>} its root
 * @throws {VextureError} if it is not well-formed, exceeds a limit, or is not SVG
 */
export function* parseXml(text, pace) {
  checkSize(text);
  const source = withEntities(text.replace(/^\ufeff/, '').trimStart());
  const parser = new SaxesParser({ xmlns: true, additionalNamespaces: prefixesIn(source) });
  let depth = 0;
  /** @type {XmlElement | null} */
  let root = null;
  /** @type {XmlElement | null} */
  let open = null;
  parser.on('opentag', ({ local, uri, attributes }) => {
    const own = new Map(Object.values(attributes).map(({ name, value }) => [name, value]));
    checkElement(local, own.size, ++depth);
    if (!root) checkName(local, uri || SVG);
    /** @type {XmlElement} */
    const element = { local, namespace: uri || null, attributes: own, parent: open, children: [], text: '' };
    open?.children.push(element);
    root ??= element;
    open = element;
  });
  parser.on('closetag', () => {
    depth--;
    if (open?.parent) open.parent.text += open.text;
    open = open?.parent ?? null;
  });
  for (const event of /** @type {const} */ (['text', 'cdata'])) {
    parser.on(event, (content) => {
      if (open) open.text += content;
    });
  }
  parser.on('error', (error) => {
    throw new VextureError(`not well-formed XML: ${source.startsWith('<') ? line(error) : 'it does not begin with <'}`, 'markup');
  });
  for (let at = 0; at < source.length; at += PART) {
    if (pace.isDue()) yield;
    parser.write(source.slice(at, at + PART));
  }
  parser.close();
  return /** @type {XmlElement} */ (/** @type {unknown} */ (root));
}

/**
 * Prefixes in a document, which need not be declared there.
 *
 * @param {string} source
 * @returns {Record<string, string>}
 */
function prefixesIn(source) {
  const found = [...source.matchAll(/[<\s/]([a-z_][\w.-]*):[a-z_][\w.-]*[\s=/>]/gi)].map(([, prefix]) => prefix);
  return Object.fromEntries([...new Set(found)].filter((one) => one !== 'xml' && one !== 'xmlns').map((one) => [one, KNOWN[one] ?? 'about:blank']));
}

/** @param {string} source @returns {string} with the entities that it defines replaced; `checkSize` has bounded their length */
function withEntities(source) {
  if (!source.includes('<!ENTITY')) return source;
  /** @type {Map<string, string>} */
  const entities = new Map();
  let end = 0;
  const replaced = (/** @type {string} */ text) => text.replace(/&([^#;&\s][^;&\s]*);/g, (whole, name) => entities.get(name) ?? whole);
  for (const match of source.matchAll(/<!ENTITY\s+([^\s"'%]+)\s+(["'])(.*?)\2\s*>/gs)) {
    if (!entities.has(match[1])) entities.set(match[1], replaced(match[3]));
    end = match.index + match[0].length;
  }
  return source.slice(0, end) + replaced(source.slice(end));
}
