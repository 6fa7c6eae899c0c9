// Writes a packed texture as a KTX 2.0 file (FORMAT.md, parts B and D; Khronos KTX File Format Specification, version 2.0).
import {
  ENCODING_PACKED,
  MOST_STYLE_BYTES,
  MOST_TEXT_BYTES,
  TEXT_ENCODING,
  TEXT_NAME,
  TEXT_ROOTS,
  TEXT_STYLES,
  TEXT_VERSION,
  TEXT_WRITER,
} from '../../generated/layout.js';
import { modeName } from '../blend.js';
import { VextureError } from '../errors.js';
import { FIXED, HEADER_BYTES, LENGTH_BYTES, LEVEL_BYTES, MAGIC, TEXEL_BYTES } from '../ktx2.js';
import { versionOf } from '../read-roots.js';

const WRITER = 'vexture';

/** Bytes of styles from which they are deflated: shorter styles would grow. */
const WORTH = 200;

/** Red, green, blue and alpha, as the Khronos Data Format Specification numbers them. */
const CHANNELS = [0, 1, 2, 15];

const WORD_BITS = 32;

/** Bytes of the head of the descriptor's block, and of each sample after it. */
const BLOCK_BYTES = 24;
const SAMPLE_BYTES = 16;

/** @typedef {import('../data.js').PackedData} PackedData */
/** @typedef {import('../data.js').Root} Root */

/**
 * Write a texture to the content of a `.ktx2` file, which every loader of vexture reads.
 *
 * @param {PackedData} data
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 * @throws {VextureError} if the description of the shapes is too long
 */
export async function writePacked(data) {
  const { width, height, texels, roots } = data;
  const pairs = keyValues(await textsOf(data));
  const image = new Uint8Array(texels.buffer, texels.byteOffset, texels.byteLength);
  const stored = await deflate(image);
  const descriptor = dataFormat();
  const dfdOffset = HEADER_BYTES + LEVEL_BYTES;
  const kvdOffset = dfdOffset + descriptor.length;
  const imageOffset = kvdOffset + pairs.length;
  if (pairs.length > MOST_TEXT_BYTES) {
    throw new VextureError(
      `${pairs.length} bytes say what its ${roots.length} shapes are; the limit is ${MOST_TEXT_BYTES}; use several textures`,
      TEXT_ROOTS,
    );
  }
  const file = new Uint8Array(imageOffset + stored.length);
  const view = new DataView(file.buffer);
  file.set(MAGIC);
  for (const [, at, [value]] of FIXED) view.setUint32(at, value, true);
  view.setUint32(20, width, true);
  view.setUint32(24, height, true);
  [dfdOffset, descriptor.length, kvdOffset, pairs.length].forEach((value, k) => view.setUint32(48 + 4 * k, value, true));
  [imageOffset, stored.length, image.length].forEach((value, k) =>
    view.setBigUint64(HEADER_BYTES + 8 * k, BigInt(value), true),
  );
  file.set(descriptor, dfdOffset);
  file.set(pairs, kvdOffset);
  file.set(stored, imageOffset);
  return file;
}

/**
 * Texts of a file by their keys; a value of bytes is stored as it is.
 *
 * @param {PackedData} data
 * @returns {Promise<Record<string, string | Uint8Array>>}
 */
async function textsOf({ name, roots }) {
  const texts = {
    [TEXT_WRITER]: WRITER,
    [TEXT_VERSION]: versionOf(roots),
    [TEXT_ENCODING]: ENCODING_PACKED,
    [TEXT_NAME]: name,
  };
  const styles = roots.some(({ style }) => style) ? new TextEncoder().encode(JSON.stringify(roots.map(styleOf))) : null;
  if (!styles) return { ...texts, [TEXT_ROOTS]: JSON.stringify(roots.map((root) => entryOf(root))) };
  if (styles.length > MOST_STYLE_BYTES) {
    throw new VextureError(
      `${styles.length} bytes say what can be restyled; the limit is ${MOST_STYLE_BYTES}; use several textures`,
      TEXT_STYLES,
    );
  }
  if (styles.length < WORTH) {
    return { ...texts, [TEXT_ROOTS]: JSON.stringify(roots.map((root) => ({ ...entryOf(root), style: styleOf(root) ?? undefined }))) };
  }
  const deflated = await deflate(styles);
  const packed = new Uint8Array(LENGTH_BYTES + deflated.length);
  new DataView(packed.buffer).setUint32(0, styles.length, true);
  packed.set(deflated, LENGTH_BYTES);
  return { ...texts, [TEXT_ROOTS]: JSON.stringify(roots.map((root) => entryOf(root))), [TEXT_STYLES]: packed };
}

/** @param {Root} root */
function entryOf({ name, quad, transform, tolerance, isMap, crs, paint }) {
  return {
    name, quad, transform, tolerance,
    ...(isMap && { map: true }),
    ...(crs !== null && { crs }),
    ...(paint !== null && { paint }),
  };
}

/**
 * A style in the form of the file; null for a shape without one.
 *
 * @param {Root} root
 */
function styleOf({ style }) {
  if (!style) return null;
  return {
    elements: style.elements.map(({ name, color, opacity, group, hides }) => ({
      name, color,
      ...(opacity !== 1 && { opacity }),
      ...(group >= 0 && { group }),
      ...(hides && { hides }),
    })),
    groups: style.groups.map(({ outer, opacity, blend, mask }) => ({
      outer, opacity, blend: modeName(blend),
      ...(mask !== 'none' && { mask }),
    })),
    stacks: style.stacks,
  };
}

/** Data format descriptor: one basic block of four unsigned integers of 32 bits (Khronos Data Format Specification 1.3). */
function dataFormat() {
  const size = BLOCK_BYTES + CHANNELS.length * SAMPLE_BYTES;
  const bytes = new Uint8Array(LENGTH_BYTES + size);
  const view = new DataView(bytes.buffer);
  const version = 2, rgbsda = 1, bt709 = 1, linear = 1;
  view.setUint32(0, bytes.length, true);
  view.setUint16(8, version, true);
  view.setUint16(10, size, true);
  bytes.set([rgbsda, bt709, linear], 12);
  bytes[20] = TEXEL_BYTES;
  CHANNELS.forEach((channel, k) => {
    const at = LENGTH_BYTES + BLOCK_BYTES + k * SAMPLE_BYTES;
    view.setUint16(at, k * WORD_BITS, true);
    bytes[at + 2] = WORD_BITS - 1;
    bytes[at + 3] = channel;
    view.setUint32(at + 12, 1, true);
  });
  return bytes;
}

/**
 * Key/value data, sorted by key, each pair padded to four bytes. A text is stored as UTF-8 with a zero byte.
 *
 * @param {Record<string, string | Uint8Array>} texts
 */
function keyValues(texts) {
  const encoder = new TextEncoder();
  const pairs = Object.keys(texts).sort().map((key) => {
    const value = texts[key];
    const bytes = typeof value === 'string' ? encoder.encode(`${value}\0`) : value;
    const name = encoder.encode(`${key}\0`);
    const length = name.length + bytes.length;
    const pair = new Uint8Array(LENGTH_BYTES + length + (-length & 3));
    new DataView(pair.buffer).setUint32(0, length, true);
    pair.set(name, LENGTH_BYTES);
    pair.set(bytes, LENGTH_BYTES + name.length);
    return pair;
  });
  return joined(pairs);
}

/** @param {Uint8Array[]} parts */
function joined(parts) {
  const whole = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

/**
 * Deflate as zlib does (RFC 1950).
 *
 * @param {Uint8Array} bytes
 */
async function deflate(bytes) {
  const stream = new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (bytes)]).stream().pipeThrough(new CompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
