// Families as style sheets describe them, such as those of Fontsource and Google Fonts.
import { VextureError } from '../errors.js';
import { fetchResponse } from '../fetching.js';

/** @import { FontFace } from './faces.js' */

/** Formats of which one is enough; the first is the smallest. */
const FORMATS = Object.freeze([/\.woff2\b/i, /\.woff\b/i, /\.[ot]tf\b/i]);

const ADDRESS = /url\(\s*(?:"([^"]*)"|'([^']*)'|([^)\s]*))\s*\)/g;

/**
 * Load the faces of a style sheet with `@font-face` rules. Their files are loaded when a text has a character of them.
 *
 * @param {string | URL} url of the style sheet
 * @returns {Promise<FontFace[]>} for the option `font`
 * @throws {VextureError} if it cannot be loaded, or has no such rule
 */
export async function loadFontFaces(url) {
  const base = new URL(url, globalThis.document?.baseURI).href;
  const text = await (await fetchResponse(base, { signal: new AbortController().signal })).text();
  const sheet = new CSSStyleSheet();
  await sheet.replace(text);
  const faces = [...sheet.cssRules].flatMap((rule) => (rule instanceof CSSFontFaceRule ? faceOf(rule.style, base) : []));
  if (faces.length) return faces;
  throw new VextureError(`${base} has no @font-face rule with the address of a font; give another style sheet`, 'font');
}

/**
 * @param {CSSStyleDeclaration} style
 * @param {string} base address of the style sheet
 * @returns {FontFace[]} one, or none without an address
 */
function faceOf(style, base) {
  const value = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
  const addresses = [...value('src').matchAll(ADDRESS)].map(([, a, b, c]) => a ?? b ?? c);
  const src = FORMATS.map((format) => addresses.find((address) => format.test(address))).find(Boolean) ?? addresses[0];
  if (!src) return [];
  const weights = value('font-weight').split(/\s+/).filter(Boolean).map(Number).filter(Number.isFinite);
  const isSlanted = /^(italic|oblique)/.test(value('font-style'));
  return [{
    src: new URL(src, base).href,
    family: value('font-family').replace(/^["']|["']$/g, ''),
    ...(weights.length && { weight: /** @type {[number, number]} */ ([weights[0], weights.at(-1)]) }),
    style: isSlanted ? 'italic' : 'normal',
    ...(value('unicode-range') && { unicodeRange: value('unicode-range') }),
  }];
}
