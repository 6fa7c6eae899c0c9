// What a file is that cannot be converted, by its first letters.
import { line } from '../errors.js';

/** Kinds of files by their first letters, as UTF-8 reads them: bytes that are none of it are U+FFFD. @type {readonly [RegExp, string][]} */
const KINDS = [
  [/^\ufffdPNG\r\n/, 'a PNG picture'],
  [/^\ufffd{2,4}[^]{0,8}(?:JFIF|Exif)/, 'a JPEG picture'],
  [/^GIF8[79]a/, 'a GIF picture'],
  [/^RIFF[^]{4,12}WEBP/, 'a WebP picture'],
  [/^BM[^]{0,12}[\0\ufffd]/, 'a BMP picture'],
  [/^\ufffdKTX 20\ufffd/, 'a KTX2 texture, which needs no conversion'],
  [/^%PDF-/, 'a PDF document'],
  [/^%!PS/, 'a PostScript document'],
  [/^PK\x03\x04/, 'a ZIP archive'],
  [/^(?:wOFF|wOF2|OTTO|\0\x01\0\0)/, 'a font'],
];

/** Pictures: those that are whole come no further than their decoder. */
const PICTURE = / picture$/;

/**
 * Describe what a text is that is no markup and no JSON, and what to do.
 *
 * @param {string} text of a file
 * @returns {string} the end of a sentence about the file
 */
export function describeContent(text) {
  const remedy = 'give SVG, GeoJSON or TopoJSON';
  if (!text.trim()) return `is empty; ${remedy}`;
  const kind = KINDS.find(([start]) => start.test(text))?.[1];
  if (kind) return PICTURE.test(kind) ? `is ${kind} that is damaged; save it again` : `is ${kind}; ${remedy}`;
  const isText = !/[\0-\x08\x0e-\x1f\ufffd]/.test(text.slice(0, 1000));
  return `${isText ? 'is a text that' : 'is no text; it'} begins with ${line(text.slice(0, 20))}; ${remedy}`;
}
