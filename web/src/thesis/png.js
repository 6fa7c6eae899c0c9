// Reads RGB images of 8 or 16 bits and their texts from untrusted PNG files.
import { decode } from 'fast-png';
import { FILE_LIMIT, LIST_LIMIT } from '../../generated/thesis-layout.js';
import { REMEDY, VextureError, line } from '../errors.js';
import { inflate } from '../inflate.js';
import { mistaken } from '../mistaken.js';

const SIGNATURE = Object.freeze([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);

/** @type {import('../mistaken.js').Expected} */
const THESIS = {
  what: 'thesis texture',
  form: 'a thesis texture is a pair of PNGs',
  make: 'convert it first: vexture convert --encoding thesis FILE',
};

const RGB = 2; // colour type
const FRAME_BYTES = 12; // length, tag and checksum of a chunk

/** Chunks passed to the decoder. Others are untrusted: a colour profile, for example, may inflate without bound. */
const KEPT = ['IHDR', 'tEXt', 'IDAT', 'IEND'];

/**
 * @typedef {object} Chunk
 * @property {string} tag
 * @property {Uint8Array} body
 * @property {Uint8Array} framed with its length, tag and checksum
 */

/**
 * @typedef {object} Png
 * @property {number} height
 * @property {8 | 16} bits
 * @property {Uint8Array | Uint16Array} pixels RGB, row by row
 * @property {Map<string, string>} texts
 */

/**
 * Whether bytes begin with the signature of PNG.
 *
 * @param {Uint8Array} bytes
 */
function isPng(bytes) {
  return SIGNATURE.every((byte, place) => bytes[place] === byte);
}

/**
 * Pixels and texts of a file. The header bounds the memory used, and the format's limits bound the header.
 *
 * @param {Uint8Array} file
 * @param {number} width that it must have
 * @returns {Promise<Png>}
 */
export async function readPng(file, width) {
  if (file.length > FILE_LIMIT) {
    throw new VextureError(`longer than ${FILE_LIMIT} bytes, so not a texture; ${REMEDY}`, 'byteLength');
  }
  const chunks = readChunks(file);
  const { height, bits } = readHeader(chunks, width);
  const deflated = joined(chunks.filter(({ tag }) => tag === 'IDAT').map(({ body }) => body));
  await inflate(deflated, height * (1 + (width * 3 * bits) / 8), 'IDAT'); // bounds the size, which the decoder does not
  const kept = chunks.filter(({ tag }) => KEPT.includes(tag)).map(({ framed }) => framed);
  let image;
  try {
    image = decode(joined([Uint8Array.from(SIGNATURE), ...kept]), { checkCrc: true });
  } catch (error) {
    throw damaged(line(error), 'PNG');
  }
  return { height, bits, pixels: /** @type {Uint8Array | Uint16Array} */ (image.data), texts: readTexts(chunks) };
}

/**
 * @param {string} what
 * @param {string} field
 */
function damaged(what, field) {
  return new VextureError(`damaged PNG (${what}); ${REMEDY}`, field);
}

/**
 * @param {Uint8Array[]} parts
 */
function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/**
 * @param {Uint8Array} file
 * @returns {Chunk[]}
 */
function readChunks(file) {
  if (!isPng(file)) {
    throw mistaken(file, 'signature', THESIS);
  }
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const chunks = [];
  for (let at = SIGNATURE.length; chunks.at(-1)?.tag !== 'IEND'; ) {
    const length = at + FRAME_BYTES <= file.length ? view.getUint32(at) : 0;
    if (at + FRAME_BYTES + length > file.length) throw damaged(`cut off at byte ${file.length}`, 'IEND');
    const tag = String.fromCharCode(...file.subarray(at + 4, at + 8));
    const end = at + FRAME_BYTES + length;
    chunks.push({ tag, body: file.subarray(at + 8, end - 4), framed: file.subarray(at, end) });
    at = end;
  }
  return chunks;
}

/**
 * @param {Chunk[]} chunks
 * @param {number} width that it must have
 * @returns {{ height: number, bits: 8 | 16 }}
 */
function readHeader([first, ...others], width) {
  if (first.tag !== 'IHDR' || first.body.length !== 13 || others.some(({ tag }) => tag === 'IHDR')) {
    throw damaged('its first chunk is not the only header', 'IHDR');
  }
  const view = new DataView(first.body.buffer, first.body.byteOffset);
  const [found, height] = [view.getUint32(0), view.getUint32(4)];
  const [bits, color, , , interlace] = first.body.subarray(8);
  const field = color !== RGB ? 'colour type' : bits !== 8 && bits !== 16 ? 'bit depth' : interlace ? 'interlace' : null;
  if (field) {
    throw new VextureError(
      `colour type ${color}, ${bits} bits, interlace ${interlace}; a texture is RGB (type ${RGB}), 8 or 16 bits, ` +
        `not interlaced; ${REMEDY}`,
      field,
    );
  }
  const most = bits === 8 ? LIST_LIMIT[8] : LIST_LIMIT[16];
  if (found !== width || height < 1 || height > most) {
    throw new VextureError(
      `${found} x ${height} pixels; a texture of ${bits} bits is ${width} wide and 1 to ${most} high; ${REMEDY}`,
      found === width ? 'height' : 'width',
    );
  }
  return { height, bits: bits === 8 ? 8 : 16 };
}

/**
 * Values of the tEXt and uncompressed iTXt chunks by keyword.
 *
 * @param {Chunk[]} chunks
 */
function readTexts(chunks) {
  const utf8 = new TextDecoder('utf-8', { fatal: true });
  const latin1 = (/** @type {Uint8Array} */ bytes) => Array.from(bytes, (byte) => String.fromCharCode(byte)).join('');
  /** @type {Map<string, string>} */
  const texts = new Map();
  for (const { tag, body } of chunks) {
    const zero = body.indexOf(0);
    if (zero < 1) continue;
    const keyword = latin1(body.subarray(0, zero));
    const value = body.subarray(zero + 1);
    if (tag === 'tEXt') texts.set(keyword, latin1(value));
    if (tag !== 'iTXt' || value[0]) continue; // compressed
    const languageEnd = value.indexOf(0, 2);
    const start = languageEnd < 0 ? 0 : value.indexOf(0, languageEnd + 1) + 1;
    if (!start) throw damaged(`its text ${line(keyword)} has no end`, keyword);
    try {
      texts.set(keyword, utf8.decode(value.subarray(start)));
    } catch {
      throw damaged(`its text ${line(keyword)} is not UTF-8`, keyword);
    }
  }
  return texts;
}
