// Fonts that are baked into a texture: texts in them need no worker, no HarfBuzz and no kernels.
import { VextureError, line } from '../errors.js';
import { fetchResponse } from '../fetching.js';
import { VectorTextureLoader } from '../vector-texture-loader.js';
import { setLines } from './atlas-layout.js';

/** @import { Request, TextLayout } from './layout.js' */
/** @import { AnyVectorTexture } from '../vector-texture.js' */

/**
 * @typedef {object} AtlasGlyph A character of a baked font; lengths are in ems, y up, from its origin on the baseline.
 * @property {number} advance to the next origin
 * @property {number | null} shape its index in the texture; null for a blank
 * @property {[number, number, number, number] | null} [box] left, bottom, right and top
 * @property {[number, number, number] | null} [square] left, bottom and side of the square that is the shape's unit square
 *
 * @typedef {object} AtlasMetrics What `vexture font` writes beside a texture.
 * @property {Record<string, AtlasGlyph>} glyphs by character
 * @property {Record<string, Record<string, number>>} kerning what to add to the advance of a character before another one
 * @property {{ ascender: number, descender: number, line_gap: number, x_height: number, cap_height: number }} lines of its lines, in ems
 * @property {AtlasGlyph} notdef for characters that it lacks
 */

/**
 * A font whose characters are the shapes of a texture, as `vexture font` and `bakeFont` make them. Characters are set one
 * by one from left to right, with kerning: right for Latin, Greek, Cyrillic, Chinese and Japanese, and for no script whose
 * letters join or change their places.
 */
export class AtlasFont {
  /**
   * @param {AnyVectorTexture} texture
   * @param {AtlasMetrics} metrics
   * @throws {VextureError} if the metrics are none
   */
  constructor(texture, metrics) {
    const hasAll = [metrics?.glyphs, metrics?.lines, metrics?.notdef].every((part) => typeof part === 'object' && part !== null);
    if (!hasAll) throw new VextureError('the metrics of a font lack glyphs, lines or notdef; give the JSON that vexture font writes', 'metrics');
    /** Its shapes. */
    this.texture = texture;
    /** Places and sizes of its characters. */
    this.metrics = { ...metrics, kerning: metrics.kerning ?? {} };
    /** Of each shape the part of its unit square that it fills. @type {[number, number][]} */
    this.boxes = texture.roots.map(() => [1, 1]);
    for (const { shape, box, square } of [...Object.values(metrics.glyphs), metrics.notdef]) {
      if (typeof shape !== 'number' || !box || !square) continue;
      if (!(shape in this.boxes)) throw new VextureError(`the metrics have a shape ${line(shape)}, the texture has ${texture.roots.length}; load files of one font`, 'shape');
      this.boxes[shape] = [(box[2] - square[0]) / square[2], (box[3] - square[1]) / square[2]];
    }
  }

  /**
   * Load a baked font.
   *
   * @param {string} url of the texture; its metrics are beside it, with the ending `.json`
   * @param {{ metrics?: string }} [options] address of the metrics, if they are elsewhere
   * @returns {Promise<AtlasFont>}
   * @throws {VextureError} if a file cannot be loaded, or is none of a font
   */
  static async load(url, { metrics = url.replace(/\.ktx2(?=$|[?#])/, '.json') } = {}) {
    const signal = new AbortController().signal;
    const [texture, response] = await Promise.all([new VectorTextureLoader().loadAsync(url), fetchResponse(metrics, { signal })]);
    try {
      return new AtlasFont(texture, await response.json());
    } catch (error) {
      throw error instanceof VextureError ? error.in(metrics) : new VextureError(`${metrics}: ${line(error)}; give the JSON that vexture font writes`, 'metrics');
    }
  }

  /** @internal */
  get isAtlasFont() {
    return true;
  }

  /**
   * Set a text.
   *
   * @internal
   * @param {Omit<Request, 'fonts'>} request
   * @returns {TextLayout}
   */
  typeset(request) {
    return setLines(this.metrics, request);
  }
}
