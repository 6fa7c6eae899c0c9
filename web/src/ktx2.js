// Reads one RGBA32UI image and its texts from an untrusted KTX 2.0 file (Khronos KTX File Format Specification, version
// 2.0). Numbers are little-endian in the file, as on every machine with WebGL.
import { MOST_ROWS, MOST_TEXT_BYTES, ROW_BITS } from '../generated/layout.js';
import { REMEDY, VextureError, line } from './errors.js';
import { inflate } from './inflate.js';
import { mistaken } from './mistaken.js';

/** The file identifier of KTX 2.0. */
export const MAGIC = Object.freeze([0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a]);

/** @type {import('./mistaken.js').Expected} */
const TEXTURE = {
  what: 'texture',
  form: 'a packed texture is a KTX 2.0 file',
  make: 'convert it first: vexture convert FILE, or import FILE?vexture with vexture/vite',
};

export const HEADER_BYTES = 80;
export const LEVEL_BYTES = 24;
export const TEXEL_BYTES = 16;
export const LENGTH_BYTES = 4;

/** VK_FORMAT_R32G32B32A32_UINT. */
const R32G32B32A32_UINT = 107;

const NONE = 0;
const ZLIB = 3;

/** Header fields with a fixed set of values: their offsets and these values, of which vexture writes the first. */
export const FIXED = /** @type {const} */ ([
  ['vkFormat', 12, [R32G32B32A32_UINT]],
  ['typeSize', 16, [4]],
  ['pixelDepth', 28, [0]],
  ['layerCount', 32, [0]],
  ['faceCount', 36, [1]],
  ['levelCount', 40, [1, 0]],
  ['supercompressionScheme', 44, [ZLIB, NONE]],
]);

/**
 * @typedef {object} Ktx2Image
 * @property {number} width texels in a row
 * @property {number} height rows
 * @property {Uint32Array} texels four words each, row by row
 * @property {Map<string, string>} texts values by key, without their terminating zero; others than UTF-8 are omitted
 * @property {Map<string, Uint8Array>} values the same as they are in the file
 */

/**
 * Return whether bytes begin with the file identifier of KTX 2.0.
 *
 * @param {ArrayBuffer | Uint8Array} file
 */
export function isKtx2(file) {
  const bytes = asBytes(file);
  return bytes.length >= MAGIC.length && MAGIC.every((byte, place) => bytes[place] === byte);
}

/**
 * Read the texels and texts of a file. The header bounds the memory used, and the format's limits bound the header.
 *
 * @param {ArrayBuffer | Uint8Array} file
 * @param {import('./mistaken.js').Expected} [expected] what it should be
 * @returns {Promise<Ktx2Image>}
 */
export async function readKtx2(file, expected = TEXTURE) {
  const bytes = asBytes(file);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const { width, height } = readHeader(bytes, view, expected);
  const dfd = part(bytes, view.getUint32(48, true), view.getUint32(52, true), 'dfdByteOffset');
  if (dfd.length && (dfd.length % 4 || view.getUint32(dfd.byteOffset - bytes.byteOffset, true) !== dfd.length)) {
    throw new VextureError(`the data format descriptor is not as long as it says; ${REMEDY}`, 'dfdTotalSize');
  }
  const kvdLength = view.getUint32(60, true);
  if (kvdLength > MOST_TEXT_BYTES) {
    throw new VextureError(
      `${kvdLength} bytes of key/value data; the limit is ${MOST_TEXT_BYTES}; ${REMEDY}`,
      'kvdByteLength',
    );
  }
  const { texts, values } = readTexts(part(bytes, view.getUint32(56, true), kvdLength, 'kvdByteOffset'));
  const raw = await readImage(bytes, view, width * height * TEXEL_BYTES);
  return { width, height, texels: new Uint32Array(raw), texts, values };
}

/**
 * @param {ArrayBuffer | Uint8Array} file
 */
function asBytes(file) {
  return file instanceof Uint8Array ? file : new Uint8Array(file);
}

/**
 * @param {Uint8Array} bytes
 * @param {DataView} view of them
 * @param {import('./mistaken.js').Expected} expected
 */
function readHeader(bytes, view, expected) {
  if (!isKtx2(bytes)) {
    throw mistaken(bytes, 'identifier', expected);
  }
  if (bytes.length < HEADER_BYTES + LEVEL_BYTES) {
    throw new VextureError(
      `${bytes.length} bytes; the header alone has ${HEADER_BYTES + LEVEL_BYTES}; load the whole file`,
      'header',
    );
  }
  for (const [name, at, allowed] of FIXED) {
    const value = view.getUint32(at, true);
    if (!allowed.some((one) => one === value)) {
      throw new VextureError(`${name} is ${value}; it must be ${allowed.join(' or ')}; ${REMEDY}`, name);
    }
  }
  if (view.getBigUint64(72, true) !== 0n) {
    throw new VextureError(`sgdByteLength is ${view.getBigUint64(72, true)}; it must be 0; ${REMEDY}`, 'sgdByteLength');
  }
  const width = view.getUint32(20, true);
  const height = view.getUint32(24, true);
  const widest = 1 << ROW_BITS;
  const wide = width >= 1 && width <= widest && (width & (width - 1)) === 0;
  if (!wide || height < 1 || height > (width === widest ? MOST_ROWS : 1)) {
    throw new VextureError(
      `${width} x ${height} texels; a texture is ${widest} wide and 1 to ${MOST_ROWS} high, or one row of a ` +
        `smaller power of two; ${REMEDY}`,
      wide ? 'pixelHeight' : 'pixelWidth',
    );
  }
  return { width, height };
}

/**
 * A range of the file's bytes, checked against its length.
 *
 * @param {Uint8Array} bytes
 * @param {number} offset
 * @param {number} length
 * @param {string} field
 */
function part(bytes, offset, length, field) {
  if (length && (offset < HEADER_BYTES || offset + length > bytes.length)) {
    throw new VextureError(
      `bytes ${offset} to ${offset + length} of a file of ${bytes.length} (${field}); it is cut off or damaged; ` +
        'load the whole file',
      field,
    );
  }
  return bytes.subarray(offset, offset + length);
}

/**
 * @param {Uint8Array} pairs
 */
function readTexts(pairs) {
  const decoder = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true });
  const view = new DataView(pairs.buffer, pairs.byteOffset, pairs.byteLength);
  /** @type {Map<string, string>} */
  const texts = new Map();
  /** @type {Map<string, Uint8Array>} */
  const values = new Map();
  for (let at = 0; at < pairs.length; ) {
    const length = at + LENGTH_BYTES <= pairs.length ? view.getUint32(at, true) : 0;
    at += LENGTH_BYTES;
    const pair = pairs.subarray(at, at + length);
    const zero = pair.indexOf(0);
    if (zero < 1 || at + length > pairs.length) {
      throw new VextureError(
        `key/value data are damaged at byte ${at} of ${pairs.length}; ${REMEDY}`,
        'keyAndValueByteLength',
      );
    }
    const whole = pair.subarray(zero + 1);
    const value = whole.at(-1) === 0 ? whole.subarray(0, -1) : whole;
    const key = decoded(decoder, pair.subarray(0, zero));
    if (key !== undefined && values.has(key)) {
      throw new VextureError(`key ${line(key)} is there twice; each may be there once; ${REMEDY}`, key);
    }
    const text = decoded(decoder, value); // keys of other writers may hold any bytes
    if (key !== undefined) values.set(key, whole);
    if (key !== undefined && text !== undefined) texts.set(key, text);
    at += length + (-length & 3);
  }
  return { texts, values };
}

/**
 * @param {TextDecoder} decoder
 * @param {Uint8Array} bytes
 */
function decoded(decoder, bytes) {
  try {
    return decoder.decode(bytes);
  } catch {
    return undefined;
  }
}

/**
 * @param {Uint8Array} bytes
 * @param {DataView} view of them
 * @param {number} size in bytes
 */
async function readImage(bytes, view, size) {
  const [offset, length, inflated] = [0, 8, 16].map((at) => Number(view.getBigUint64(HEADER_BYTES + at, true)));
  const stored = part(bytes, offset, length, 'byteLength');
  if (view.getUint32(44, true) === NONE) {
    if (stored.length !== size) {
      throw new VextureError(
        `the image has ${stored.length} bytes; its size in texels makes it ${size}; ${REMEDY}`,
        'byteLength',
      );
    }
    // a copy, of a Buffer of Node.js too: a Uint32Array needs an offset that is a multiple of four
    return new Uint8Array(stored).buffer;
  }
  if (inflated !== size) {
    throw new VextureError(
      `uncompressedByteLength is ${inflated}; the size in texels makes it ${size}; ${REMEDY}`,
      'uncompressedByteLength',
    );
  }
  return inflate(stored, size, 'image');
}
