// Fonts: loaded when a text first needs one, with an instance of HarfBuzz for each set of variations.
import * as hb from 'harfbuzzjs';
import { VextureError, line } from '../errors.js';
import { fetchBytes, fileBytes, isTransport, shown } from '../fetching.js';
import { kerningOf } from './kern.js';
import { sfntOf } from './sfnt.js';
import { MOST_BYTES } from './tables.js';
import { uprightFont } from './vertical.js';

/** @typedef {Record<string, number>} Variations values of axes by their tags */

/** Time in ms after which a font that could not be fetched is tried again. */
const PATIENCE = 10_000;

/** Heights in ems of fonts that neither say them nor have the letters. */
const ESTIMATES = { capHeight: 0.7, xHeight: 0.5 };

/** Tables of images of glyphs. */
const IMAGES = ['CBDT', 'sbix', 'SVG '];

const images = new hb.PaintFuncs();
images.setImageFunc((_image, _width, _height, _format, _extents, found) => {
  /** @type {{ hasImage: boolean }} */ (found).hasImage = true;
  return true;
});

/** A font of a page. */
export class TypeFont {
  #source;
  #ranges;
  /** @type {Promise<void> | null} */
  #loading = null;
  /** @type {Map<string, Instance>} */
  #instances = new Map();
  /** @type {Map<number, boolean>} */
  #known = new Map();
  /** @type {hb.Face | null} */
  #face = null;
  #failedAt = -Infinity;
  /** Ranges of glyphs with an SVG. @type {[number, number][]} */
  #pictures = [];
  #isPainted = false;
  #isLayered = false;

  /**
   * @param {number} id
   * @param {string | ArrayBuffer | Uint8Array} source address or content of its file
   * @param {string} [unicodeRange] as in CSS
   */
  constructor(id, source, unicodeRange) {
    this.id = id;
    this.#source = source;
    this.#ranges = unicodeRange ? rangesOf(unicodeRange) : null;
    /** Why it cannot be used. @type {VextureError | null} */
    this.error = null;
    /** Whether it draws glyphs in colours, or has images of them. */
    this.hasColor = false;
    /** Names of tables with images of glyphs, which are not drawn. */
    this.hasImages = '';
    /** Kerning without OpenType's features. @type {import('./kern.js').Pairs[]} */
    this.kerning = [];
    /** Which glyphs have parts in the colour of their text, beside other colours. @type {Map<number, boolean>} */
    this.inked = new Map();
    /** What cannot be drawn. @type {Set<string>} */
    this.notes = new Set();
  }

  get isLoaded() {
    return this.#face !== null;
  }

  /** Whether loading it now makes sense. */
  get isPending() {
    if (this.#face) return false;
    return !this.error || (isTransport(this.error) && Date.now() - this.#failedAt > PATIENCE);
  }

  get face() {
    return /** @type {hb.Face} */ (this.#face);
  }

  /** Whether its `unicodeRange` includes a character. @param {number} code */
  covers(code) {
    return this.#ranges === null || this.#ranges.some(([first, last]) => first <= code && code <= last);
  }

  /** Whether it has a glyph for a character. @param {number} code */
  has(code) {
    let known = this.#known.get(code);
    if (known === undefined) {
      known = this.covers(code) && Boolean(this.instance('').font.nominalGlyph(code));
      this.#known.set(code, known);
    }
    return known;
  }

  /** Load its file; it never throws, but leaves an `error`. */
  load() {
    this.#loading ??= this.#load().then(
      () => {
        this.error = null;
      },
      (error) => {
        const about = error instanceof VextureError ? error : new VextureError(line(error), 'font', { cause: error });
        const { message, field } = about;
        const isNamed = typeof this.#source !== 'string' || message.startsWith(shown(this.#source));
        this.error = isNamed ? about : new VextureError(`${shown(String(this.#source))}: ${message}`, field, { cause: error });
        this.#failedAt = Date.now();
        this.#loading = null;
      },
    );
    return this.#loading;
  }

  async #load() {
    const source = this.#source;
    const signal = new AbortController().signal;
    const fetched = async (/** @type {string} */ url) => (await fileBytes(url, MOST_BYTES)) ?? fetchBytes(url, { signal }, MOST_BYTES);
    const file = typeof source === 'string' ? await fetched(source) : new Uint8Array(source);
    const bytes = await sfntOf(/** @type {Uint8Array<ArrayBuffer>} */ (file));
    const face = new hb.Face(new hb.Blob(bytes));
    if (!face.referenceTable('cmap')?.length) {
      throw new VextureError('the font has no characters (no table cmap), or is damaged; give another file', 'font');
    }
    const has = (/** @type {string} */ tag) => Boolean(face.referenceTable(tag)?.length);
    this.#isPainted = face.hasColorPaint();
    this.#isLayered = face.hasColorLayers();
    if (!this.#isPainted && !this.#isLayered) this.hasImages = IMAGES.filter(has).join(', ');
    this.hasColor = this.#isPainted || this.#isLayered || this.hasImages !== '';
    if (this.hasImages.includes('SVG')) this.#pictures = picturesOf(face.referenceTable('SVG '));
    this.axes = face.getAxisInfos();
    this.kerning = kerningOf(face);
    this.#face = face;
  }

  /** Whether a glyph has colours of its own (COLR). @param {number} glyph */
  isColored(glyph) {
    const { face } = this;
    return (this.#isPainted && face.glyphHasColorPaint(glyph)) || (this.#isLayered && face.getGlyphColorLayers(glyph).length > 0);
  }

  /** Note that a glyph has an image, if it has one. @param {Instance} instance @param {number} glyph */
  noteImages({ font }, glyph) {
    const found = { hasImage: this.#pictures.some(([first, last]) => first <= glyph && glyph <= last) };
    font.paintGlyph(glyph, images, found);
    if (!found.hasImage) return;
    const remedy = 'take a font of the format COLR';
    this.notes.add(`glyphs with images (${this.hasImages.trim()}) are shown as outlines without colours, if they have any; ${remedy}`);
  }

  /**
   * An instance by its variations.
   *
   * @param {string} key as `variationKey` makes it
   * @returns {Instance}
   */
  instance(key) {
    let instance = this.#instances.get(key);
    if (!instance) {
      instance = new Instance(this, key);
      this.#instances.set(key, instance);
    }
    return instance;
  }

  /** Forget its instances, and so what they have shaped and converted. */
  forget() {
    this.#instances.clear();
  }

  /**
   * A key of variations: those axes that the font has, clamped.
   *
   * @param {Variations} variations
   */
  variationKey(variations) {
    const parts = [];
    for (const tag of Object.keys(this.axes ?? {}).sort()) {
      const { min, max, default: usual } = /** @type {Record<string, hb.AxisInfo>} */ (this.axes)[tag];
      const value = Math.min(Math.max(variations[tag] ?? usual, min), max);
      if (value !== usual) parts.push(`${tag}=${value}`);
    }
    return parts.join(',');
  }
}

/** A font with values of its axes. Lengths are in its own units, `em` to the em. */
export class Instance {
  /** @type {Map<string, Map<number, import('./shapes.js').Shape | null>>} shapes of its glyphs by kind, then glyph */
  shapes = new Map();
  /** @type {hb.Font | null} */
  #upright = null;

  /** @param {TypeFont} owner @param {string} key */
  constructor(owner, key) {
    this.owner = owner;
    /** Names it in keys of shapes. */
    this.key = `${owner.id}:${key}`;
    this.font = new hb.Font(owner.face);
    if (key) this.font.setVariations(key.split(',').map((part) => /** @type {hb.Variation} */ (hb.Variation.fromString(part))));
    this.em = owner.face.upem;
    const { ascender, descender, lineGap } = this.font.hExtents();
    this.ascender = ascender;
    this.descender = descender;
    this.lineGap = lineGap;
    this.capHeight = this.#height(hb.MetricsTag.CAP_HEIGHT, 'H', ESTIMATES.capHeight);
    this.xHeight = this.#height(hb.MetricsTag.X_HEIGHT, 'x', ESTIMATES.xHeight);
  }

  /** @param {hb.MetricsTag} tag @param {string} letter that is as high, for old fonts @param {number} estimate for others */
  #height(tag, letter, estimate) {
    const glyph = this.font.nominalGlyph(letter.charCodeAt(0));
    return this.font.getMetricPosition(tag) || (glyph && this.font.glyphExtents(glyph)?.yBearing) || estimate * this.em;
  }

  /** Its font for text from top to bottom. */
  get uprightFont() {
    this.#upright ??= uprightFont(this);
    return this.#upright;
  }

  /** Carets within a ligature. @param {number} glyph @param {hb.Direction} direction */
  caretsOf(glyph, direction) {
    return glyph < 0 ? [] : this.font.getLigatureCarets(direction, glyph);
  }
}

/**
 * Ranges of glyphs from a table of SVG documents; HarfBuzz is built without it.
 *
 * @param {Uint8Array | undefined} table
 * @returns {[number, number][]}
 */
function picturesOf(table) {
  if (!table || table.length < 12) return [];
  const view = new DataView(table.buffer, table.byteOffset, table.byteLength), start = view.getUint32(2);
  const count = start + 2 <= table.length ? Math.min(view.getUint16(start), Math.floor((table.length - start - 2) / 12)) : 0;
  return Array.from({ length: count }, (_, k) => [view.getUint16(start + 2 + 12 * k), view.getUint16(start + 4 + 12 * k)]);
}

/**
 * Ranges of characters from the text of CSS.
 *
 * @param {string} text such as `U+0000-00FF, U+4??`
 * @returns {[number, number][]}
 */
function rangesOf(text) {
  return text.split(',').map((part) => {
    const match = /^\s*u\+([0-9a-f]{1,6}|[0-9a-f]{0,5}\?{1,6})(?:-([0-9a-f]{1,6}))?\s*$/i.exec(part);
    if (!match) throw new VextureError(`the unicodeRange ${line(part)} is none; write U+26, U+0-7F or U+4??, with commas`, 'unicodeRange');
    const [, first, last] = match;
    const low = Number.parseInt(first.replaceAll('?', '0'), 16);
    return [low, last ? Number.parseInt(last, 16) : Number.parseInt(first.replaceAll('?', 'f'), 16)];
  });
}
