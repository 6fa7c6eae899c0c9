// The textures of this folder, and files made from them that are broken in one place.
import { readFileSync } from 'node:fs';
import { deflateSync, inflateSync } from 'node:zlib';
import { TEXT_ENCODING, TEXT_ROOTS, TEXT_VERSION } from '../generated/layout.js';

/** @param {string} name */
export const fixture = (name) => new Uint8Array(readFileSync(new URL(`fixtures/${name}`, import.meta.url)));

/** Where the header has its fields: offset and bytes. */
export const FIELDS = {
  vkFormat: 12,
  typeSize: 16,
  pixelWidth: 20,
  pixelHeight: 24,
  pixelDepth: 28,
  layerCount: 32,
  faceCount: 36,
  levelCount: 40,
  supercompressionScheme: 44,
  dfdByteOffset: 48,
  dfdByteLength: 52,
  kvdByteOffset: 56,
  kvdByteLength: 60,
  sgdByteLength: 72,
  byteOffset: 80,
  byteLength: 88,
  uncompressedByteLength: 96,
};

/**
 * A copy with one 32-bit number changed.
 *
 * @param {Uint8Array} file
 * @param {number} at
 * @param {number} value
 */
export function patched(file, at, value) {
  const copy = file.slice();
  new DataView(copy.buffer).setUint32(at, value, true);
  return copy;
}

/** Texts that a packed texture must have. */
export const TEXTS = {
  [TEXT_ENCODING]: 'packed',
  [TEXT_ROOTS]: '[{"name":"one","quad":0,"transform":[1,0,0,0,1,0]}]',
  [TEXT_VERSION]: '1',
};

/**
 * The bytes of key/value data; texts end with a zero byte.
 *
 * @param {Record<string, string | Uint8Array>} texts
 */
export function keyValues(texts) {
  const pairs = Object.entries(texts).map(([key, value]) => {
    const pair = Buffer.concat([Buffer.from(`${key}\0`), Buffer.from(value), Buffer.from(typeof value === 'string' ? [0] : [])]);
    const length = Buffer.alloc(4);
    length.writeUInt32LE(pair.length);
    return Buffer.concat([length, pair, Buffer.alloc(-pair.length & 3)]);
  });
  return Buffer.concat(pairs);
}

/**
 * A KTX 2.0 file of one row of texels.
 *
 * @param {number[][] | Uint32Array} texels
 * @param {Record<string, string | Uint8Array>} [texts]
 * @param {{ image?: Uint8Array, scheme?: number, width?: number, height?: number }} [instead]
 */
export function ktx2(texels, texts = TEXTS, instead = {}) {
  const words = Uint32Array.from(Array.isArray(texels) ? texels.flat() : texels);
  const { width = words.length / 4, height = 1, scheme = 3 } = instead;
  const raw = new Uint8Array(words.buffer);
  const image = instead.image ?? (scheme ? deflateSync(raw) : raw);
  const pairs = keyValues(texts);
  const head = Buffer.alloc(104);
  Buffer.from('ab4b5458203230bb0d0a1a0a', 'hex').copy(head);
  const numbers = [107, 4, width, height, 0, 0, 1, 1, scheme, 0, 0, 104, pairs.length];
  numbers.forEach((number, place) => head.writeUInt32LE(number, 12 + 4 * place));
  [104 + pairs.length, image.length, 16 * width * height].forEach((number, place) =>
    head.writeBigUInt64LE(BigInt(number), 80 + 8 * place),
  );
  return new Uint8Array(Buffer.concat([head, pairs, image]));
}

/**
 * The file of the same texture with its texels changed.
 *
 * @param {import('../src/data.js').PackedData} data
 * @param {(texels: Uint32Array) => void} change
 */
export function altered(data, change) {
  const texels = data.texels.slice();
  change(texels);
  const roots = data.roots.map(({ paint, isMap, hasGradients: _, hasPictures: __, style, ...root }) => ({ ...root, map: isMap, ...(style ? { style } : {}), ...(paint ? { paint } : {}) }));
  const version = roots.some(({ map }) => map) ? '2' : '1';
  const texts = { ...TEXTS, [TEXT_VERSION]: version, [TEXT_ROOTS]: JSON.stringify(roots) };
  return ktx2(texels, texts, { width: data.width, height: data.height });
}

/**
 * The chunks of a PNG.
 *
 * @param {Uint8Array} file
 */
export function chunksOf(file) {
  const chunks = [];
  const view = new DataView(file.buffer, file.byteOffset);
  for (let at = 8; at < file.length; ) {
    const length = view.getUint32(at);
    chunks.push({ tag: Buffer.from(file.subarray(at + 4, at + 8)).toString('latin1'), body: file.slice(at + 8, at + 8 + length) });
    at += 12 + length;
  }
  return chunks;
}

/**
 * A PNG of chunks.
 *
 * @param {{ tag: string, body: Uint8Array }[]} chunks
 */
export function png(chunks) {
  const parts = [Buffer.from('89504e470d0a1a0a', 'hex')];
  for (const { tag, body } of chunks) {
    const content = Buffer.concat([Buffer.from(tag, 'latin1'), body]);
    const frame = Buffer.alloc(4);
    frame.writeUInt32BE(body.length);
    const checksum = Buffer.alloc(4);
    checksum.writeUInt32BE(crc32(content));
    parts.push(frame, content, checksum);
  }
  return new Uint8Array(Buffer.concat(parts));
}

/** @param {Uint8Array} bytes */
function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/**
 * A PNG with its chunks changed.
 *
 * @param {Uint8Array} file
 * @param {(chunks: { tag: string, body: Uint8Array }[]) => { tag: string, body: Uint8Array }[] | void} change
 */
export function rechunked(file, change) {
  const chunks = chunksOf(file);
  return png(change(chunks) ?? chunks);
}

/**
 * A PNG of 8 or 16 bits with its channels changed, all rows under filter 0.
 *
 * @param {Uint8Array} file
 * @param {Uint8Array | Uint16Array} pixels
 * @param {number} width
 * @param {(pixels: Uint8Array | Uint16Array) => void} change
 */
export function repainted(file, pixels, width, change) {
  const copy = pixels.slice();
  change(copy);
  const size = copy.BYTES_PER_ELEMENT;
  const row = 3 * width;
  const raw = Buffer.alloc((copy.length / row) * (1 + row * size));
  copy.forEach((channel, place) => {
    const at = Math.floor(place / row) * (1 + row * size) + 1 + (place % row) * size;
    if (size === 1) raw.writeUInt8(channel, at);
    else raw.writeUInt16BE(channel, at);
  });
  return rechunked(file, (chunks) => [
    ...chunks.filter(({ tag }) => tag !== 'IDAT' && tag !== 'IEND'),
    { tag: 'IDAT', body: deflateSync(raw) },
    { tag: 'IEND', body: new Uint8Array() },
  ]);
}

/** Deflated and inflated bytes of a file's image. */
export { deflateSync, inflateSync };
