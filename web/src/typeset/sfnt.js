// The bytes of a font file as HarfBuzz reads them: tables of WOFF and WOFF2 are unpacked (WOFF File Format 1.0, 2.0).
import { VextureError, line } from '../errors.js';
import { inflate } from '../inflate.js';
import { MOST_BYTES, damaged, joinTables } from './tables.js';

const COLLECTION = 0x74746366, WOFF = 0x774f4646, WOFF2 = 0x774f4632;

/** First four bytes of files that HarfBuzz reads as they are: TrueType, OpenType, collections. */
const PLAIN = new Set([0x00010000, 0x4f54544f, 0x74727565, COLLECTION]);

/**
 * Return the tables of a font file as TrueType or OpenType.
 *
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 * @throws {VextureError} if it is no font
 */
export async function sfntOf(bytes) {
  if (bytes.length < 12) throw new VextureError(`${bytes.length} bytes are no font; give a TTF, OTF, WOFF or WOFF2 file`, 'font');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), signature = view.getUint32(0);
  try {
    if (PLAIN.has(signature)) return checked(bytes, view);
    if (signature === WOFF) return await unpackWoff(bytes, view);
    if (signature === WOFF2) {
      const { unpackWoff2 } = await import('./woff2.js');
      return await unpackWoff2(bytes, view);
    }
  } catch (error) {
    throw error instanceof RangeError ? damaged('it ends too early') : error; // a read beyond its end
  }
  const start = line(String.fromCharCode(...bytes.subarray(0, 4)));
  throw new VextureError(`a file that begins with ${start} is no font; give a TTF, OTF, WOFF or WOFF2 file`, 'font');
}

/** A file whose tables all are there; of a collection, those of the first font. @param {Uint8Array<ArrayBuffer>} bytes @param {DataView} view */
function checked(bytes, view) {
  const start = view.getUint32(0) === COLLECTION ? view.getUint32(12) : 0, count = view.getUint16(start + 4);
  for (let at = start + 12; at < start + 12 + 16 * count; at += 16) {
    if (view.getUint32(at + 8) + view.getUint32(at + 12) > bytes.length) throw damaged('it ends too early');
  }
  return bytes;
}

/** @param {Uint8Array<ArrayBuffer>} bytes @param {DataView} view */
async function unpackWoff(bytes, view) {
  const count = view.getUint16(12);
  let total = 0;
  const tables = await Promise.all(
    Array.from({ length: count }, async (_, k) => {
      const [tag, offset, packed, length] = [0, 4, 8, 12].map((at) => view.getUint32(44 + 20 * k + at));
      total += length;
      if (offset + packed > bytes.length) throw damaged('it ends too early');
      if (total > MOST_BYTES) throw damaged(`it has more than ${MOST_BYTES} bytes`);
      const stored = bytes.subarray(offset, offset + packed);
      return { tag, data: packed < length ? new Uint8Array(await inflate(stored, length, 'the font')) : stored };
    }),
  );
  return joinTables(view.getUint32(4), tables);
}
