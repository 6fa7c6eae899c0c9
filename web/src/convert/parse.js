// Parsing of markup into an inert document, within limits.
import { MOST_ATTRIBUTES } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { shortenText } from './report.js';
import { withTrust } from './trusted.js';

export const SVG = 'http://www.w3.org/2000/svg';

/** Longest text that a page can read without standing still for long. */
export const LONGEST = 32 * 2 ** 20;

/** Most elements, likewise. */
const MOST_ELEMENTS = 200_000;

/** Deepest nesting, and most letters of all entities together, as of libxml2 in Python. */
export const DEEPEST = 256;
const LONGEST_ENTITY = 10_000_000;

const PREFIXES = 20;
const PROGRAM = 'or convert it with the program vexture';

/** @type {Readonly<Record<string, string>>} */
export const KNOWN = { xlink: 'http://www.w3.org/1999/xlink' };

/**
 * Parse an SVG document. Nothing is fetched, and no script runs.
 *
 * @param {string} text
 * @returns {Element} its root
 * @throws {VextureError} if it is not well-formed, exceeds a limit, or is not SVG
 */
export function parseSvg(text) {
  checkSize(text);
  let source = text.replace(/^\ufeff/, '').trimStart();
  let { root, message } = parse(source);
  if (message) {
    source = withPrefixes(source);
    ({ root, message } = parse(source));
  }
  if (message) throw new VextureError(errorText(source, message), 'markup');
  if (root.localName === 'svg' && root.namespaceURI === null) ({ root } = parse(declare(source, 'xmlns', SVG)));
  return checkRoot(root);
}

/** @param {string} source @returns {{ root: Element, message: string }} and the message of an error, if there is one */
function parse(source) {
  const parsed = withTrust(source, (trusted) => new DOMParser().parseFromString(trusted, 'image/svg+xml'));
  return { root: parsed.documentElement, message: parsed.getElementsByTagName('parsererror')[0]?.textContent ?? '' };
}

/** @param {string} source @returns {string} with declarations of all its prefixes, which HTML does not need */
function withPrefixes(source) {
  const used = new Set([...source.matchAll(/<([\w.-]+):|\s([\w.-]+):[\w.-]+\s*=/g)].map((match) => match[1] ?? match[2]));
  let declared = source;
  for (const prefix of [...used].slice(0, PREFIXES)) {
    const isKnown = prefix === 'xml' || prefix === 'xmlns' || source.includes(`xmlns:${prefix}`);
    if (!isKnown) declared = declare(declared, `xmlns:${prefix}`, KNOWN[prefix] ?? 'about:blank');
  }
  return declared;
}

/**
 * @param {string} source
 * @param {string} name
 * @param {string} value
 * @returns {string} with an attribute of the outermost element
 */
const declare = (source, name, value) => source.replace(/<svg(?=[\s/>])/, `<svg ${name}="${value}"`);

/** @param {string} source @param {string} message of the browser @returns {string} */
function errorText(source, message) {
  if (!source.startsWith('<')) return `not well-formed XML: ${source ? 'it does not begin with <' : 'it is empty'}`;
  const reason = /error on (line.*?)(?=Below is|$)/s.exec(message)?.[1] ?? message;
  return `not well-formed XML: ${shortenText(reason.replace(/\s+/g, ' ').trim(), 160)}`;
}

/**
 * @param {string} text
 * @throws {VextureError} if it is too long, has too many elements, or its entities are too long
 */
export function checkSize(text) {
  const most = (/** @type {number} */ limit) => limit.toLocaleString('en-US');
  if (text.length > LONGEST) {
    throw new VextureError(
      `the file has ${most(text.length)} letters; a page reads ${most(LONGEST)}; simplify or split it, ${PROGRAM}`,
      'size',
    );
  }
  let count = 0;
  for (let at = text.indexOf('<'); at >= 0; at = text.indexOf('<', at + 1)) {
    const code = text.charCodeAt(at + 1) | 32; // in lower case
    if (code >= 97 && code <= 122) count++;
  }
  checkCount(count);
  if (text.includes('<!ENTITY')) checkEntities(text);
}

/** @param {number} count of elements @throws {VextureError} if there are too many */
export function checkCount(count) {
  if (count <= MOST_ELEMENTS) return;
  const [here, most] = [count, MOST_ELEMENTS].map((value) => value.toLocaleString('en-US'));
  throw new VextureError(`it has ${here} elements; a page reads ${most}; simplify it, ${PROGRAM}`, 'elements');
}

/** @param {string} text @throws {VextureError} if the entities that it defines are external, or expand to too much */
function checkEntities(text) {
  /** @type {Map<string, number>} */
  const sizes = new Map();
  const sizeOf = (/** @type {string} */ part) => {
    let size = part.length;
    for (const [, name] of part.matchAll(/&([^#;&\s][^;&\s]*);/g)) size += sizes.get(name) ?? 0;
    return size;
  };
  let end = 0;
  for (const match of text.matchAll(/<!ENTITY\s+(%\s+)?([^\s"']+)\s+(?:(["'])(.*?)\3|(SYSTEM|PUBLIC))/gs)) {
    if (match[5]) {
      throw new VextureError(
        `Entity '${shortenText(match[2], 40)}' is external; only entities that the file itself defines are read, `
          + 'external ones never',
        'entity',
      );
    }
    if (!sizes.has(match[2])) sizes.set(match[2], sizeOf(match[4]));
    end = match.index + match[0].length;
  }
  if (sizeOf(text.slice(end)) - (text.length - end) > LONGEST_ENTITY || Math.max(...sizes.values()) > LONGEST_ENTITY) {
    throw new VextureError(
      'its entities expand to too much text (an entity bomb?); write the drawing without entities',
      'entity',
    );
  }
}

/** @param {Element} root @returns {Element} @throws {VextureError} if it is not SVG, or exceeds a limit */
function checkRoot(root) {
  checkName(root.localName, root.namespaceURI);
  let depth = 1;
  for (let one = /** @type {Element | null} */ (root); one;) {
    checkElement(one.localName, one.attributes.length, depth);
    if (one.firstElementChild) [one, depth] = [one.firstElementChild, depth + 1];
    else {
      while (one && one !== root && !one.nextElementSibling) [one, depth] = [one.parentElement, depth - 1];
      one = one === root ? null : one?.nextElementSibling ?? null;
    }
  }
  return root;
}

/** @param {string} name @param {string | null} namespace of the root @throws {VextureError} if it is not that of SVG */
export function checkName(name, namespace) {
  if (name !== 'svg') throw new VextureError(`the root element is <${name.slice(0, 40)}>, not <svg>; this is not an SVG file`, 'root');
  if (namespace !== SVG) {
    throw new VextureError(`the root element has the namespace '${namespace?.slice(0, 80)}'; the one of SVG is '${SVG}'`, 'root');
  }
}

/** @param {string} name @param {number} attributes their number @param {number} depth @throws {VextureError} if an element exceeds a limit */
export function checkElement(name, attributes, depth) {
  if (depth > DEEPEST) {
    throw new VextureError(`its elements are nested more than ${DEEPEST} deep; flatten its groups`, 'depth');
  }
  if (attributes > MOST_ATTRIBUTES) {
    const [count, most] = [attributes, MOST_ATTRIBUTES].map((value) => value.toLocaleString('en-US'));
    throw new VextureError(`<${name.slice(0, 40)}> has ${count} attributes; the limit is ${most}; remove those that draw nothing`, 'attributes');
  }
}
