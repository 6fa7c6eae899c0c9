// Identifies files of a wrong kind: many servers answer a wrong address with a page, and some with nothing.
import { REMEDY, VextureError, line } from './errors.js';

/**
 * @typedef {object} Expected What a file should be.
 * @property {string} what such as `texture`
 * @property {string} form such as `a packed texture is a KTX 2.0 file`
 * @property {string} make how to make one of a drawing
 * @property {string} [remedy] of what is not recognised
 */

/** Bytes in which a page or an SVG begins: comments may precede it. */
export const START_BYTES = 4096;

/** Bytes that a message shows. */
const SHOWN_BYTES = 12;

/** Byte order marks, of which the bytes are characters here, white space and comments. */
const LEADING = /^(?:\xef\xbb\xbf|\xff\xfe|\xfe\xff|\s|<!--[^]*?-->)*/;

/** Zeros are every second byte of a text in UTF-16. */
const ZEROS = /\0/g;

/** In the order in which they are tried: a page may hold an SVG. */
const KINDS = /** @type {const} */ ([
  ['a web page', /^(?:<\?xml[^>]*>\s*)?<(?:!doctype\s+html|html|head|body)\b/i],
  ['an SVG', /^(?:<svg\b|<[?!][^]*<svg\b)/i],
  ['XML', /^<\?xml\b/i],
  ['a web page', /^<[a-z!/]/i],
  ['a picture', /^(?:\x89PNG|\xff\xd8\xff|GIF8|RIFF)/],
]);

/**
 * @param {ArrayBuffer | Uint8Array} file
 * @throws {VextureError} if it is no contents of a file
 */
export function checkContents(file) {
  if (!(file?.byteLength >= 0)) throw new VextureError(`contents are ${line(file)}; give a file's bytes`, 'contents');
}

/** @param {Uint8Array} bytes its numbers are the characters' */
const characters = (bytes) => String.fromCharCode(...bytes);

/**
 * What a file is, if it is one that is often taken for another.
 *
 * @param {Uint8Array} bytes
 * @returns {'nothing' | typeof KINDS[number][0] | null}
 */
export function kindOf(bytes) {
  if (bytes.length === 0) return 'nothing';
  const start = characters(bytes.subarray(0, START_BYTES));
  const text = start.replace(ZEROS, '').replace(LEADING, '');
  return KINDS.find(([, pattern]) => pattern.test(text))?.[0] ?? null;
}

/**
 * What a message says of a file that is another one, and what to do; null if that is not known.
 *
 * @param {Uint8Array} bytes
 * @param {Pick<Expected, 'what' | 'make'>} expected
 */
export function mistakenFor(bytes, { what, make }) {
  const kind = kindOf(bytes);
  if (kind === null) return null;
  if (kind === 'nothing') return `has no bytes, so is no ${what}; check the address, and the file on its server`;
  const isDrawing = kind === 'an SVG' || kind === 'a picture';
  return `is ${kind}, not a ${what}; ${isDrawing ? make : 'check the address'}`;
}

/**
 * The error about a file that does not begin as it should.
 *
 * @param {Uint8Array} bytes
 * @param {string} field
 * @param {Expected} expected
 */
export function mistaken(bytes, field, expected) {
  const begins = `begins with ${line(characters(bytes.subarray(0, SHOWN_BYTES)))}; ${expected.form}; ${expected.remedy ?? REMEDY}`;
  return new VextureError(mistakenFor(bytes, expected) ?? begins, field);
}
