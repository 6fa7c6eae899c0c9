// Fonts for production: the characters that texts show as a texture and its metrics.
import { writePacked } from '../convert/write-packed.js';
import { Glyphs } from './glyphs.js';
import { LAYOUT, requestOf } from './text-options.js';

/** @import { AtlasGlyph, AtlasMetrics } from './atlas-font.js' */
/** @import { FontSource } from './faces.js' */
/** @import { GlyphsOptions } from './glyphs.js' */

/** Fonts of more characters have no kerning: pairs are as many as their square. */
const MOST_KERNED = 256;

/** Kerning below this part of an em is rounding. */
const LEAST = 1e-5;

/**
 * Bake characters of a font into a texture, as `vexture font` does. `AtlasFont` shows texts in it without a worker.
 *
 * @param {object} options
 * @param {string} options.characters such as `glyphs.characters`
 * @param {FontSource | null} [options.font] by default that of the package
 * @param {number} [options.weight] 400 by default
 * @param {GlyphsOptions} [options.glyphs] where the kernels and the worker are
 * @returns {Promise<{ texture: Uint8Array<ArrayBuffer>, metrics: AtlasMetrics }>} the contents of a `.ktx2` and a JSON file
 * @throws {VextureError} if the font cannot be read
 */
export async function bakeFont({ characters, font = null, weight = 400, glyphs: options }) {
  const glyphs = new Glyphs(options);
  const setText = (/** @type {string} */ text) =>
    glyphs.typeset(requestOf({ ...LAYOUT, text, fontSize: 1, anchorY: 'top-baseline', fontWeight: weight }), { font, weight, isItalic: false });
  const single = [...new Set(characters)].filter((character) => character !== '\n');
  const [missing, ...set] = await Promise.all(['\u{10ffff}', ...single].map(setText));
  const kerning = single.length > MOST_KERNED ? {} : await kerningOf(single, set.map(advanceOf), setText);
  const { roots, width, texels } = glyphs.texture.data;
  const rows = Math.ceil(glyphs.texture.length / width);
  /** @type {Map<number, string>} */
  const names = new Map([[missing.shapes[0], '.notdef']]);
  set.forEach(({ shapes }, k) => shapes.length && !names.has(shapes[0]) && names.set(shapes[0], single[k]));
  const texture = await writePacked({
    encoding: 'packed', name: 'font', width, height: rows, texels: texels.slice(0, 4 * width * rows),
    roots: roots.map((root, shape) => ({ ...root, name: names.get(shape) ?? root.name })),
  });
  const lines = set[0] ?? missing;
  const metrics = {
    glyphs: Object.fromEntries(set.map((layout, k) => [single[k], glyphOf(layout, glyphs)])),
    kerning,
    lines: {
      ascender: lines.ascender, descender: lines.descender, line_gap: lines.lineHeight - lines.ascender + lines.descender,
      x_height: lines.xHeight, cap_height: lines.capHeight,
    },
    notdef: glyphOf(missing, glyphs),
  };
  glyphs.dispose();
  return { texture, metrics };
}

/** @param {{ carets: Float32Array }} layout @returns {number} */
const advanceOf = ({ carets }) => Math.abs(carets[1] - carets[0]);

/**
 * @param {import('./layout.js').TextLayout} layout of one character
 * @param {Glyphs} glyphs
 * @returns {AtlasGlyph}
 */
function glyphOf(layout, glyphs) {
  const advance = advanceOf(layout);
  if (!layout.shapes.length) return { advance, shape: null, box: null, square: null };
  const [left, bottom, side] = layout.places, [width, height] = glyphs.texture.boxes[layout.shapes[0]];
  return { advance, shape: layout.shapes[0], box: [left, bottom, left + width * side, bottom + height * side], square: [left, bottom, side] };
}

/**
 * @param {string[]} characters
 * @param {number[]} advances
 * @param {(text: string) => Promise<{ carets: Float32Array }>} setText
 * @returns {Promise<Record<string, Record<string, number>>>}
 */
async function kerningOf(characters, advances, setText) {
  /** @type {Record<string, Record<string, number>>} */
  const kerning = {};
  for (const [k, first] of characters.entries()) {
    const pairs = await Promise.all(characters.map((second) => setText(first + second)));
    pairs.forEach((pair, n) => {
      const more = advanceOf(pair) - advances[k];
      if (Math.abs(more) > LEAST && pair.carets[4 * first.length] !== pair.carets[0]) (kerning[first] ??= {})[characters[n]] = more;
    });
  }
  return kerning;
}
