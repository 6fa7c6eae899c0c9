// The bytes of a font file as HarfBuzz reads them.
import { VextureError, line } from '../errors.js';

/** First four bytes of files that HarfBuzz reads as they are: TrueType, OpenType, collections. */
const PLAIN = new Set([0x00010000, 0x4f54544f, 0x74727565, 0x74746366]);

/**
 * Return the tables of a font file as TrueType or OpenType.
 *
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 * @throws {VextureError} if it is no font
 */
export async function sfntOf(bytes) {
  if (bytes.length < 12) throw new VextureError(`${bytes.length} bytes are no font; give a TTF, OTF, WOFF or WOFF2 file`, 'font');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const signature = view.getUint32(0);
  if (PLAIN.has(signature)) return bytes;
  const start = line(String.fromCharCode(...bytes.subarray(0, 4)));
  throw new VextureError(`a file that begins with ${start} is no font; give a TTF, OTF, WOFF or WOFF2 file`, 'font');
}
