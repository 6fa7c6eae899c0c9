// Unpacks WOFF2 (W3C, WOFF File Format 2.0), the first font of a collection. Instructions are left out: nothing hints here.
import { VextureError, line } from '../errors.js';
import { MOST_BYTES, damaged, joinTables } from './tables.js';

/** @import { Table } from './tables.js' */

/** Tags of tables by their numbers. */
const TAGS =
  'cmap head hhea hmtx maxp name OS/2 post cvt  fpgm glyf loca prep CFF  VORG EBDT EBLC gasp hdmx kern LTSH ' +
  'PCLT VDMX vhea vmtx BASE GDEF GPOS GSUB EBSC JSTF MATH CBDT CBLC COLR CPAL SVG  sbix acnt avar bdat bloc ' +
  'bsln cvar fdsc feat fmtx fvar gvar hsty just lcar mort morx opbd prop trak Zapf Silf Glat Gloc Feat Sill';

/** Number of a table whose tag follows. */
const OTHER = 63;

const COLLECTION = 0x74746366;

/** @param {string} tag */
const tagOf = (tag) => new DataView(Uint8Array.from(tag, (one) => one.charCodeAt(0)).buffer).getUint32(0);

const GLYF = tagOf('glyf'), LOCA = tagOf('loca'), HMTX = tagOf('hmtx'), HEAD = tagOf('head'), HHEA = tagOf('hhea');

/** Reads a stream of numbers. */
class Reader {
  /** @param {DataView} view @param {number} at @param {number} [end] */
  constructor(view, at, end = view.byteLength) {
    this.view = view;
    this.at = at;
    if (end > view.byteLength) throw damaged('it ends too early');
  }

  byte() {
    return this.view.getUint8(this.at++);
  }

  short() {
    return this.view.getInt16((this.at += 2) - 2);
  }

  word() {
    return this.view.getUint16((this.at += 2) - 2);
  }

  long() {
    return this.view.getUint32((this.at += 4) - 4);
  }

  /** The type 255UInt16. */
  number() {
    const code = this.byte();
    if (code === 253) return this.word();
    return code === 255 ? this.byte() + 253 : code === 254 ? this.byte() + 506 : code;
  }

  /** The type UIntBase128. */
  length() {
    let value = 0;
    for (let k = 0; k < 5; k++) {
      const byte = this.byte();
      value = value * 128 + (byte & 127);
      if (byte < 128) return value;
    }
    throw damaged('a length has no end');
  }
}

/**
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {DataView} view of them
 * @returns {Promise<Uint8Array<ArrayBuffer>>} as TrueType or OpenType
 */
export async function unpackWoff2(bytes, view) {
  const reader = new Reader(view, 48), count = view.getUint16(12);
  let flavor = view.getUint32(4), total = 0;
  const entries = Array.from({ length: count }, () => {
    const flags = reader.byte(), known = flags & 63;
    const tag = known === OTHER ? reader.long() : tagOf(TAGS.slice(5 * known, 5 * known + 4));
    const size = reader.length(), version = flags >> 6;
    const isTransformed = tag === GLYF || tag === LOCA ? version !== 3 : version !== 0;
    const stored = isTransformed ? reader.length() : size, start = total;
    total += stored;
    return { tag, size, isTransformed, start, end: total };
  });
  if (total > MOST_BYTES) throw damaged(`it has more than ${MOST_BYTES} bytes`);
  let chosen = entries;
  if (flavor === COLLECTION) {
    reader.long(); // its version
    const fonts = Array.from({ length: reader.number() }, () => {
      const own = reader.number(), flavor = reader.long();
      return { flavor, tables: Array.from({ length: own }, () => entries[reader.number()]) };
    });
    if (!fonts[0]?.tables.every(Boolean)) throw damaged('its first font has no tables');
    flavor = fonts[0].flavor;
    chosen = fonts[0].tables;
  }
  const unpacked = await unpack(bytes.subarray(reader.at, reader.at + view.getUint32(20)), total);
  return joinTables(flavor, tablesOf(unpacked, chosen));
}

/**
 * Unpack by the browser, if it knows Brotli, or else by a library.
 *
 * @param {Uint8Array<ArrayBuffer>} packed
 * @param {number} size
 */
async function unpack(packed, size) {
  const native = nativeStream(), decompress = native ? null : await loadBrotli();
  let bytes;
  try {
    bytes = native ? await readThrough(native, packed, size) : /** @type {Decompress} */ (decompress)(packed, size);
  } catch (error) {
    throw damaged(`Brotli finds "${line(error)}"`);
  }
  if (bytes.length !== size) throw damaged(`it unpacks to ${bytes.length} bytes, not ${size}`);
  return bytes;
}

/** @typedef {(packed: Uint8Array, size: number) => Uint8Array} Decompress */

/** @returns {Promise<Decompress>} */
async function loadBrotli() {
  try {
    return (await import('brotli/decompress')).decompress;
  } catch (error) {
    const remedy = 'check that the page may load the module brotli, or give a WOFF file';
    throw new VextureError(`WOFF2 cannot be unpacked (${line(error)}); ${remedy}`, 'font', { cause: error });
  }
}

function nativeStream() {
  try {
    return new DecompressionStream(/** @type {CompressionFormat} */ ('brotli'));
  } catch {
    return null; // an older browser
  }
}

/** @param {DecompressionStream} stream @param {Uint8Array<ArrayBuffer>} packed @param {number} size */
async function readThrough(stream, packed, size) {
  const bytes = new Uint8Array(size), reader = new Blob([packed]).stream().pipeThrough(stream).getReader();
  for (let at = 0; ; ) {
    const { done, value } = await reader.read();
    if (done) return bytes.subarray(0, at);
    if (at + value.length > size) {
      reader.cancel().catch(() => {}); // the error says what is wrong
      throw new Error(`more than ${size} bytes`);
    }
    bytes.set(value, at);
    at += value.length;
  }
}

/**
 * @param {Uint8Array} bytes
 * @param {{ tag: number, size: number, isTransformed: boolean, start: number, end: number }[]} entries
 * @returns {Table[]}
 */
function tablesOf(bytes, entries) {
  const part = (/** @type {number} */ tag) => {
    const entry = entries.find((one) => one.tag === tag);
    if (!entry) throw damaged('it lacks a table');
    return bytes.subarray(entry.start, entry.end);
  };
  const outlines = entries.find(({ tag, isTransformed }) => tag === GLYF && isTransformed) ? glyphsOf(part(GLYF)) : null;
  return entries.map(({ tag, isTransformed }) => {
    if (outlines && tag === GLYF) return { tag, data: outlines.glyf };
    if (outlines && tag === LOCA) return { tag, data: outlines.loca };
    if (outlines && tag === HEAD) {
      const data = part(HEAD).slice();
      viewOf(data).setInt16(50, 1); // offsets of 32 bits
      return { tag, data };
    }
    if (tag === HMTX && isTransformed) {
      if (!outlines) throw damaged('its advances need outlines');
      return { tag, data: advancesOf(part(HMTX), viewOf(part(HHEA)).getUint16(34), outlines.lefts) };
    }
    if (isTransformed) throw damaged('a table is transformed in an unknown way');
    return { tag, data: part(tag) };
  });
}

/** @param {Uint8Array} bytes */
const viewOf = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/**
 * Restore advances and left side bearings (5.4).
 *
 * @param {Uint8Array} bytes
 * @param {number} count of advances
 * @param {Int16Array} lefts least x of each glyph
 */
function advancesOf(bytes, count, lefts) {
  const reader = new Reader(viewOf(bytes), 0), flags = reader.byte(), glyphs = lefts.length;
  if (count > glyphs || !count) throw damaged(`${count} advances of ${glyphs} glyphs`);
  const advances = Array.from({ length: count }, () => reader.word());
  const data = new Uint8Array(2 * (count + glyphs)), view = viewOf(data);
  for (let k = 0; k < glyphs; k++) {
    const isShort = k >= count, isLeft = flags & (isShort ? 2 : 1);
    if (!isShort) view.setUint16(4 * k, advances[k]);
    view.setInt16(isShort ? 2 * (count + k) : 4 * k + 2, isLeft ? lefts[k] : reader.short());
  }
  return data;
}

/**
 * Restore outlines (5.1, 5.2), with coordinates of 16 bits.
 *
 * @param {Uint8Array} bytes
 */
function glyphsOf(bytes) {
  const view = viewOf(bytes), count = view.getUint16(4), hasOverlaps = view.getUint16(2) & 1;
  let at = 36;
  const streams = Array.from({ length: 7 }, (_, k) => {
    const stream = new Reader(view, at, at + view.getUint32(8 + 4 * k));
    at += view.getUint32(8 + 4 * k);
    return stream;
  });
  const [contours, points, flags, shapes, composites, boxes] = streams, marks = boxes.at;
  boxes.at += 4 * ((count + 31) >> 5);
  const loca = new Uint8Array(4 * (count + 1)), offsets = viewOf(loca), lefts = new Int16Array(count);
  let glyf = new Uint8Array(4 * bytes.length + 64), out = viewOf(glyf), end = 0;
  const room = (/** @type {number} */ more) => {
    if (end + more <= glyf.length) return;
    if (end + more > MOST_BYTES) throw damaged(`its outlines have more than ${MOST_BYTES} bytes`);
    const larger = new Uint8Array(Math.max(2 * glyf.length, end + more));
    larger.set(glyf);
    glyf = larger;
    out = viewOf(glyf);
  };
  for (let k = 0; k < count; k++) {
    const number = contours.short(), start = end, hasBox = view.getUint8(marks + (k >> 3)) & (128 >> (k & 7));
    if (number !== 0) {
      room(10);
      out.setInt16(end, number);
      if (hasBox) for (let n = 1; n <= 4; n++) out.setInt16(end + 2 * n, boxes.short());
      end += 10;
      if (number < 0) copyComposite();
      else copySimple(number, !hasBox, hasOverlaps ? view.getUint8(at + (k >> 3)) & (128 >> (k & 7)) : 0);
      end = (end + 3) & ~3;
      lefts[k] = out.getInt16(start + 2);
    }
    offsets.setUint32(4 * k + 4, end);
  }
  return { glyf: glyf.subarray(0, end), loca, lefts };

  function copyComposite() {
    let flag = 32, hasCode = 0;
    while (flag & 32) {
      flag = composites.word();
      hasCode |= flag & 256;
      const size = 2 + (flag & 1 ? 4 : 2) + (flag & 8 ? 2 : flag & 64 ? 4 : flag & 128 ? 8 : 0);
      room(size + 2);
      out.setUint16(end, flag & ~256);
      for (let n = 0; n < size; n++) out.setUint8(end + 2 + n, composites.byte());
      end += size + 2;
    }
    if (hasCode) shapes.number();
  }

  /** @param {number} number @param {boolean} needsBox @param {number} overlaps */
  function copySimple(number, needsBox, overlaps) {
    const start = end - 10;
    let total = 0;
    room(2 * number + 2);
    for (let n = 0; n < number; n++, end += 2) {
      total += points.number();
      out.setUint16(end, total - 1);
    }
    end += 2; // no instructions
    room(5 * total + 4);
    let x = 0, y = 0, low = 32767, right = -32768, bottom = 32767, top = -32768;
    for (let n = 0; n < total; n++) {
      const code = flags.byte(), [dx, dy] = step(code & 127, shapes);
      x += dx;
      y += dy;
      low = Math.min(low, x);
      right = Math.max(right, x);
      bottom = Math.min(bottom, y);
      top = Math.max(top, y);
      out.setUint8(end + n, (code < 128 ? 1 : 0) | (n === 0 && overlaps ? 64 : 0));
      out.setInt16(end + total + 2 * n, dx);
      out.setInt16(end + 3 * total + 2 * n, dy);
    }
    end += 5 * total;
    shapes.number(); // length of the instructions
    if (needsBox) [low, bottom, right, top].forEach((value, n) => out.setInt16(start + 2 + 2 * n, value));
  }
}

/** The step to a point (5.2, table of triplets). @param {number} code @param {Reader} from @returns {[number, number]} */
function step(code, from) {
  const signed = (/** @type {number} */ sign, /** @type {number} */ value) => (sign & 1 ? value : -value);
  const a = from.byte();
  if (code < 10) return [0, signed(code, ((code & 14) << 7) + a)];
  if (code < 20) return [signed(code, (((code - 10) & 14) << 7) + a), 0];
  if (code < 84) {
    const n = code - 20;
    return [signed(code, 1 + (n & 0x30) + (a >> 4)), signed(code >> 1, 1 + ((n & 12) << 2) + (a & 15))];
  }
  const b = from.byte();
  if (code < 120) {
    const n = code - 84;
    return [signed(code, 1 + (Math.floor(n / 12) << 8) + a), signed(code >> 1, 1 + (((n % 12) >> 2) << 8) + b)];
  }
  const c = from.byte();
  if (code < 124) return [signed(code, (a << 4) + (b >> 4)), signed(code >> 1, ((b & 15) << 8) + c)];
  return [signed(code, (a << 8) + b), signed(code >> 1, (c << 8) + from.byte())];
}
