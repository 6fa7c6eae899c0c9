// Font files as tables.
import { VextureError } from '../errors.js';

/** @typedef {{ tag: number, data: Uint8Array }} Table */

/** Most bytes of an unpacked font. */
export const MOST_BYTES = 1 << 27;

/** @param {string} what */
export const damaged = (what) => new VextureError(`the font is damaged: ${what}; give another file`, 'font');

/**
 * A file of tables (OpenType, "Organization of an OpenType Font"). Checksums are left 0: HarfBuzz ignores them.
 *
 * @param {number} flavor
 * @param {Table[]} tables
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function joinTables(flavor, tables) {
  const sorted = [...tables].sort((one, other) => one.tag - other.tag), start = 12 + 16 * sorted.length;
  const bytes = new Uint8Array(sorted.reduce((sum, { data }) => sum + ((data.length + 3) & ~3), start)), view = new DataView(bytes.buffer);
  view.setUint32(0, flavor);
  view.setUint16(4, sorted.length);
  let at = start;
  sorted.forEach(({ tag, data }, k) => {
    [tag, 0, at, data.length].forEach((word, n) => view.setUint32(12 + 16 * k + 4 * n, word));
    bytes.set(data, at);
    at += (data.length + 3) & ~3;
  });
  return bytes;
}
