// Pictures in a drawing: their size from their first bytes, and their pixels as the browser decodes them.
import { MOST_FILE_PIXELS } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';

/**
 * @typedef {object} Pixels The pixels of a picture.
 * @property {number} columns number of pixels in a row
 * @property {number} rows number of rows
 * @property {Uint8Array} rgba red, green, blue and opacity, premultiplied sRGB, row by row from the top
 * @property {string} label what a note calls it
 */

/** Message for what is no image. */
export const NO_IMAGE = 'it is no SVG, PNG, JPEG, WebP, GIF or BMP';

const ONE = 255;

/**
 * The format of a picture and its size, which it declares in its first bytes.
 *
 * @param {Uint8Array} bytes
 * @returns {{ format: string, columns: number, rows: number } | null} null if it is no picture
 */
export function pictureSize(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const tag = (/** @type {number} */ at, /** @type {number} */ length) => String.fromCharCode(...bytes.subarray(at, at + length));
  try {
    if (tag(0, 8) === '\x89PNG\r\n\x1a\n') return { format: 'PNG', columns: view.getUint32(16), rows: view.getUint32(20) };
    if (/^GIF8[79]a$/.test(tag(0, 6))) return { format: 'GIF', columns: view.getUint16(6, true), rows: view.getUint16(8, true) };
    if (tag(0, 2) === 'BM') return { format: 'BMP', columns: view.getInt32(18, true), rows: Math.abs(view.getInt32(22, true)) };
    if (tag(0, 3) === '\xff\xd8\xff') return jpegSize(view);
    if (tag(0, 4) === 'RIFF' && tag(8, 4) === 'WEBP') return webpSize(view, tag(12, 4));
  } catch (error) {
    if (!(error instanceof RangeError)) throw error; // it ends before its size
  }
  return null;
}

/** The size in a JPEG's start of frame (ITU-T T.81, B.2.2). @param {DataView} view */
function jpegSize(view) {
  for (let at = 2; ; at += 2 + view.getUint16(at + 2)) {
    while (view.getUint8(at + 1) === 0xff) at++;
    const marker = view.getUint8(at + 1);
    const isFrame = marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);
    if (isFrame) return { format: 'JPEG', columns: view.getUint16(at + 7), rows: view.getUint16(at + 5) };
    if (view.getUint8(at) !== 0xff || marker === 0xda) return null;
  }
}

/** The size in a WebP's first chunk (RFC 9649). @param {DataView} view @param {string} chunk */
function webpSize(view, chunk) {
  const both = (/** @type {number} */ columns, /** @type {number} */ rows) => ({ format: 'WebP', columns, rows });
  if (chunk === 'VP8 ') return both(view.getUint16(26, true) & 0x3fff, view.getUint16(28, true) & 0x3fff);
  if (chunk === 'VP8L') {
    const bits = view.getUint32(21, true);
    return both((bits & 0x3fff) + 1, ((bits >>> 14) & 0x3fff) + 1);
  }
  const side = (/** @type {number} */ at) => 1 + view.getUint16(at, true) + 65536 * view.getUint8(at + 2);
  return chunk === 'VP8X' ? both(side(24), side(27)) : null;
}

/**
 * Decode a picture. The browser turns it as its EXIF data say, and brings its colours to sRGB.
 *
 * @param {Uint8Array} bytes
 * @param {string} label
 * @returns {Promise<Pixels>}
 * @throws {VextureError} if it is too large or damaged, or nothing here decodes pictures
 */
export async function decodePicture(bytes, label) {
  const size = pictureSize(bytes);
  const fault = (/** @type {string} */ text) => new VextureError(text, 'href');
  if (!size) throw fault(NO_IMAGE);
  const { columns, rows } = size;
  if (columns * rows > MOST_FILE_PIXELS) {
    throw fault(`it has ${columns} x ${rows} pixels; the limit is ${MOST_FILE_PIXELS.toLocaleString('en-US')}; scale it down`);
  }
  if (typeof createImageBitmap !== 'function') throw fault('nothing decodes pictures outside of a browser; convert it in a page or in Python');
  const bitmap = await createImageBitmap(new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (bytes)])).catch(() => {
    throw fault('it is damaged');
  });
  try {
    return { ...pixelsOf(bitmap), label };
  } finally {
    bitmap.close();
  }
}

/** @param {ImageBitmap} bitmap @returns {Omit<Pixels, 'label'>} */
function pixelsOf(bitmap) {
  const { width, height } = bitmap;
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw new VextureError('the browser gives no canvas to decode it', 'href');
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  const rgba = new Uint8Array(data.buffer, data.byteOffset, data.length);
  for (let k = 0; k < rgba.length; k += 4) {
    const opacity = rgba[k + 3];
    if (opacity === ONE) continue;
    for (let c = k; c < k + 3; c++) rgba[c] = Math.round((rgba[c] * opacity) / ONE);
  }
  return { columns: width, rows: height, rgba };
}
