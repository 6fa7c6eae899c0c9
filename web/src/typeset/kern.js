// Kerning by the table `kern` of older fonts, which the build of HarfBuzz for pages leaves out. It is applied as
// `hb-kern.hh` of HarfBuzz does: half of it to each glyph of a pair.

/** @import * as hb from 'harfbuzzjs' */
/** @import { Shaped } from './shaper.js' */

/** @typedef {(left: number, right: number) => number} Pairs what is added between two glyphs */

/** Bits of a subtable's coverage, of which only horizontal kerning along the line is read. */
const KIND = 7, HORIZONTAL = 1, APPLE_KIND = 0xe0;

/**
 * Kerning of a font; none if it has the feature `kern`, or no such table.
 *
 * @param {hb.Face} face
 * @returns {Pairs[]}
 */
export function kerningOf(face) {
  const table = face.referenceTable('kern');
  if (!table || table.length < 4 || face.getTableFeatureTags('GPOS').includes('kern')) return [];
  const view = new DataView(table.buffer, table.byteOffset, table.byteLength), isApple = view.getUint16(0) === 1;
  const count = isApple && table.length > 7 ? view.getUint32(4) : view.getUint16(2), head = isApple ? 8 : 6;
  /** @type {Pairs[]} */
  const found = [];
  for (let k = 0, at = isApple ? 8 : 4; k < count && at + head + 8 <= view.byteLength; k++) {
    const length = isApple ? view.getUint32(at) : view.getUint16(at + 2);
    const [format, coverage] = isApple ? [view.getUint8(at + 5), view.getUint8(at + 4)] : [view.getUint8(at + 4), view.getUint8(at + 5)];
    if (isApple ? !(coverage & APPLE_KIND) : (coverage & KIND) === HORIZONTAL) {
      if (format === 0) found.push(listedPairs(view, at + head));
      if (format === 2) found.push(classPairs(view, at, head));
    }
    at += Math.max(length, head);
  }
  return found;
}

/** Format 0: a list. @param {DataView} view @param {number} at after the head @returns {Pairs} */
function listedPairs(view, at) {
  const count = Math.min(view.getUint16(at), Math.floor((view.byteLength - at - 8) / 6));
  const values = new Map(Array.from({ length: count }, (_, k) => [view.getUint32(at + 8 + 6 * k), view.getInt16(at + 12 + 6 * k)]));
  return (left, right) => values.get(left * 65536 + right) ?? 0;
}

/** Format 2: classes of glyphs, as offsets of rows and columns. @param {DataView} view @param {number} at @param {number} head @returns {Pairs} */
function classPairs(view, at, head) {
  const word = (/** @type {number} */ place) => (place + 2 <= view.byteLength ? view.getUint16(place) : 0);
  const offset = (/** @type {number} */ table, /** @type {number} */ glyph) => {
    const place = at + word(at + head + table), n = glyph - word(place);
    return n >= 0 && n < word(place + 2) ? word(place + 4 + 2 * n) : 0;
  };
  const array = word(at + head + 6);
  return (left, right) => {
    const place = offset(2, left) + offset(4, right);
    return place < array || at + place + 2 > view.byteLength ? 0 : view.getInt16(at + place);
  };
}

/**
 * Kern a run; glyphs without a width, such as marks, are left out.
 *
 * @param {Shaped} shaped
 * @param {Pairs[]} kerning
 */
export function kern(shaped, kerning) {
  const { glyphs, clusters, advances, dx, count } = shaped;
  for (const pairs of kerning) {
    let last = -1;
    for (let k = 0; k < count; k++) {
      if (advances[k] === 0) continue;
      const value = last < 0 ? 0 : pairs(glyphs[last], glyphs[k]), half = value >> 1;
      if (value) {
        advances[last] += half;
        advances[k] += value - half;
        dx[k] += value - half;
        (shaped.unsafe ??= new Set()).add(Math.max(clusters[last], clusters[k])); // another line has no kerning
      }
      last = k;
    }
  }
}
