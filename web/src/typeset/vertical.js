// Metrics of vertical text (vhea, vmtx, VORG), which the build of HarfBuzz for pages leaves out: functions of a font in
// their place, as `hb-ot-font.cc` of HarfBuzz computes them. Their variations (VVAR) are left out.
import * as hb from 'harfbuzzjs';

/** @import { Instance } from './font.js' */

/** Place of the number of long metrics in vhea. */
const COUNT = 34;

/** @param {Uint8Array | undefined} table */
const viewOf = (table) => (table?.length ? new DataView(table.buffer, table.byteOffset, table.byteLength) : null);

/**
 * The advances and distances from the top of a font with the table vmtx; null if it has none.
 *
 * @param {hb.Face} face
 */
function vmtxOf(face) {
  const head = viewOf(face.referenceTable('vhea')), table = viewOf(face.referenceTable('vmtx'));
  const count = head && head.byteLength > COUNT + 1 ? head.getUint16(COUNT) : 0;
  if (!table || !count || table.byteLength < 4 * count) return null;
  return {
    advance: (/** @type {number} */ glyph) => table.getUint16(4 * Math.min(glyph, count - 1)),
    top: (/** @type {number} */ glyph) => {
      const at = glyph < count ? 4 * glyph + 2 : 2 * (count + glyph);
      return at + 2 <= table.byteLength ? table.getInt16(at) : 0;
    },
  };
}

/**
 * Heights of the origins of a font with the table VORG; null if it has none.
 *
 * @param {hb.Face} face
 */
function vorgOf(face) {
  const table = viewOf(face.referenceTable('VORG'));
  if (!table || table.byteLength < 8) return null;
  const usual = table.getInt16(4), count = Math.min(table.getUint16(6), (table.byteLength - 8) >> 2);
  const heights = new Map(Array.from({ length: count }, (_, k) => [table.getUint16(8 + 4 * k), table.getInt16(10 + 4 * k)]));
  return (/** @type {number} */ glyph) => heights.get(glyph) ?? usual;
}

/**
 * The font of an instance for text from top to bottom.
 *
 * @param {Instance} instance
 * @returns {hb.Font}
 */
export function uprightFont({ font, owner, ascender, descender }) {
  const { face } = owner, vmtx = vmtxOf(face), vorg = vorgOf(face), whole = ascender - descender;
  const hasGlyf = Boolean(face.referenceTable('glyf')?.length), usual = owner.instance('').font;
  const height = (/** @type {number} */ glyph) => {
    if (vorg) return vorg(glyph);
    const isPhantom = vmtx !== null && hasGlyf; // the top of a glyph is a point of its outline, of which variations move others
    const extents = (isPhantom ? usual : font).glyphExtents(glyph);
    if (isPhantom) return vmtx.top(glyph) + (extents?.yBearing ?? 0);
    return extents ? extents.yBearing + Math.floor((whole + extents.height) / 2) : ascender;
  };
  const functions = new hb.FontFuncs(), upright = font.subFont();
  functions.setGlyphVAdvanceFunc((_, glyph) => -(vmtx ? vmtx.advance(glyph) : whole));
  functions.setGlyphVOriginFunc((_, glyph) => [Math.trunc(font.glyphHAdvance(glyph) / 2), height(glyph)]);
  upright.setFuncs(functions);
  return upright;
}
