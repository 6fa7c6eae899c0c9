// Calls of HarfBuzz: a run of one font, script and direction becomes glyphs.
import * as hb from 'harfbuzzjs';
import { kern } from './kern.js';

/** @import { Instance } from './font.js' */

/**
 * @typedef {object} Shaped A run as glyphs, from left to right or from top to bottom; lengths in units of the font.
 * @property {Instance} instance
 * @property {boolean} isReversed whether its text goes from right to left
 * @property {boolean} isUpright whether it is set from top to bottom
 * @property {number} count of glyphs
 * @property {number[]} glyphs
 * @property {number[]} clusters UTF-16 index in the text where each glyph's cluster begins
 * @property {number[]} advances along the line
 * @property {number[]} dx
 * @property {number[]} dy
 * @property {Set<number> | null} unsafe clusters before which the run must not be cut without shaping it again
 *
 * @typedef {object} ShapeStyle
 * @property {hb.Feature[]} features
 * @property {string} language
 */

/** Characters around a run that HarfBuzz looks at, at most five, each of two units at most. */
const CONTEXT = 10;

const buffer = new hb.Buffer();

/**
 * Shape a part of a text.
 *
 * @param {Instance} instance
 * @param {string} text
 * @param {number} start
 * @param {number} end
 * @param {hb.Direction} direction
 * @param {ShapeStyle} style
 * @returns {Shaped}
 */
export function shapeRun(instance, text, start, end, direction, { features, language }) {
  const from = Math.max(start - CONTEXT, 0);
  buffer.reset();
  buffer.addText(text.slice(from, end + CONTEXT), start - from, end - start);
  buffer.setDirection(direction);
  if (language) buffer.setLanguage(language);
  buffer.guessSegmentProperties();
  hb.shape(direction === hb.Direction.TTB ? instance.uprightFont : instance.font, buffer, features);
  const infos = buffer.getGlyphInfos(), places = buffer.getGlyphPositions(), count = infos.length;
  const isUpright = direction === hb.Direction.TTB;
  /** @type {Shaped} */
  const shaped = {
    instance, isReversed: direction === hb.Direction.RTL, isUpright, count,
    glyphs: new Array(count), clusters: new Array(count), advances: new Array(count), dx: new Array(count), dy: new Array(count), unsafe: null,
  };
  for (let k = 0; k < count; k++) {
    const { codepoint, cluster, flags } = infos[k], { xAdvance, yAdvance, xOffset, yOffset } = places[k];
    shaped.glyphs[k] = codepoint;
    shaped.clusters[k] = cluster + from;
    shaped.advances[k] = isUpright ? -yAdvance : xAdvance;
    shaped.dx[k] = xOffset;
    shaped.dy[k] = yOffset;
    if (flags & hb.GlyphFlag.UNSAFE_TO_BREAK) (shaped.unsafe ??= new Set()).add(cluster + from);
  }
  const { kerning } = instance.owner;
  if (kerning.length && !isUpright && !features.some(({ tag, value }) => tag === 'kern' && value === 0)) kern(shaped, kerning);
  return shaped;
}

/**
 * Features from the text of CSS or of HarfBuzz.
 *
 * @param {string} text such as `smcp, ss01=2` or `"smcp" on, "liga" 0`
 * @returns {hb.Feature[] | string} the part that is none, if there is one
 */
export function featuresOf(text) {
  const features = [];
  for (const part of text.split(',')) {
    const words = part.trim().replace(/^(['"])(....)\1/, '$2').replace(/\s+on$/, '=1').replace(/\s+off$/, '=0').replace(/^(\S{4})\s+(\d+)$/, '$1=$2');
    if (!words) continue;
    const feature = hb.Feature.fromString(words);
    if (!feature) return part.trim();
    features.push(feature);
  }
  return features;
}
