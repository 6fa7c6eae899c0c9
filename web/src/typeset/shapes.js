// Glyphs as shapes of a texture: outlines by HarfBuzz, texels by the kernels.
import { VextureError } from '../errors.js';
import { silhouetteOf } from '../convert/silhouette.js';
import { outlineStroke } from '../convert/stroke-outline.js';
import { contoursOf, controlBox } from './outlines.js';

/** @import { Kernels } from '../convert/kernels.js' */
/** @import { ModuleName } from '../convert/kernel-modules.js' */
/** @import { Instance, TypeFont } from './font.js' */

/**
 * @typedef {object} Shape
 * @property {number} place its index
 * @property {number} x least coordinates of its square, in units of its font
 * @property {number} y
 * @property {number} side of its square
 * @property {number} width of its control points' box
 * @property {number} height
 *
 * @typedef {{ key: string, quad: number, box: [number, number], isMap: boolean, hasGradients: boolean }} AddedShape
 * @typedef {{ firstShape: number, shapes: AddedShape[], first: number, words: Uint32Array<ArrayBuffer> }} Added
 *
 * @typedef {object} Kind What is drawn of a glyph.
 * @property {'' | 'o' | 's'} part itself, itself with an outline, or a line along its edge
 * @property {number} width of the outline or the line, in ems
 * @property {boolean} isTurned by a quarter, clockwise
 * @property {string} ink colour of the text, of a glyph that has parts in it beside other colours; else ''
 * @property {string} key
 *
 * @typedef {typeof import('./color-glyphs.js')} ColorGlyphs
 */

/** Limit of the work on a glyph. */
const MAX_SECONDS = 10;

/** Largest distance of an outline from the exact one, in ems. */
const STROKE_TOLERANCE = 1e-4;

/** Digits of an outline's width. */
const DIGITS = 4;

/**
 * @param {Kind['part']} part
 * @param {number} width in ems
 * @param {boolean} isTurned
 * @param {string} [ink]
 * @returns {Kind}
 */
export function kindOf(part, width, isTurned, ink = '') {
  const rounded = Number(width.toPrecision(DIGITS));
  return { part, width: rounded, isTurned, ink, key: `${part}${part ? rounded : ''}${isTurned ? 'r' : ''}${ink && `#${ink}`}` };
}

/** What a shape's key says; null if it is none. @param {unknown} key */
export function partsOfKey(key) {
  const match = /^(\d+):([^:]*):(\d+)(?::(?:([os])([\d.e+-]+))?(r?)(?:#([\da-f]{6}))?)?$/.exec(String(key));
  if (!match) return null;
  const [, font, variation, glyph, part = '', width = '0', turned = '', ink = ''] = match;
  return { font: Number(font), variation, glyph: Number(glyph), kind: kindOf(/** @type {Kind['part']} */ (part), Number(width), turned !== '', ink) };
}

/**
 * Modules that a shape needs besides that of silhouettes.
 *
 * @param {TypeFont} font
 * @param {number} glyph
 * @param {Kind} kind
 * @returns {ModuleName[]}
 */
export function modulesOf(font, glyph, { part }) {
  /** @type {ModuleName[]} */
  const names = font.isColored(glyph) ? ['maps'] : [];
  return part ? [...names, 'strokes'] : names;
}

/** The shapes of a texture that grows. */
export class Shapes {
  /** Modules that are loaded. @type {Partial<Record<ModuleName, Kernels>>} */
  kernels = {};
  /** @type {ColorGlyphs | null} */
  colors = null;
  /** Modules without which glyphs were left out. @type {Set<ModuleName>} */
  wanted = new Set();
  #count = 0;
  #next = 0;
  /** @type {AddedShape[]} */
  #added = [];
  /** @type {Uint32Array[]} */
  #texels = [];
  /** @type {Set<Map<number, Shape | null>>} */
  #known = new Set();

  /**
   * The shape of a glyph; null if it shows nothing, or a module is wanted first.
   *
   * @param {Instance} instance
   * @param {number} glyph
   * @param {Kind} kind
   * @returns {Shape | null}
   */
  of(instance, glyph, kind) {
    let shapes = instance.shapes.get(kind.key);
    if (!shapes) {
      shapes = new Map();
      instance.shapes.set(kind.key, shapes);
      this.#known.add(shapes);
    }
    let shape = shapes.get(glyph);
    if (shape === undefined) {
      shape = this.#add(instance, glyph, kind);
      if (shape === undefined) return null;
      shapes.set(glyph, shape);
    }
    return shape;
  }

  /**
   * Whether a glyph in colours has parts in that of its text, so that each colour is another shape. Glyphs that are all in
   * it take it from their material.
   *
   * @param {Instance} instance
   * @param {number} glyph
   */
  hasInk(instance, glyph) {
    const { inked } = instance.owner;
    let found = inked.get(glyph);
    if (found !== undefined) return found;
    if (!this.colors) return false; // it is wanted by `of`
    const painted = instance.owner.isColored(glyph) ? this.colors.paintGlyph(instance, glyph, false, '') : null;
    found = painted !== null && painted.hasInk && !painted.isPlain;
    inked.set(glyph, found);
    return found;
  }

  /** What was added since it was last taken. @returns {Added} */
  take() {
    const shapes = this.#added, words = new Uint32Array(this.#texels.reduce((sum, { length }) => sum + length, 0));
    const first = this.#next - words.length / 4, firstShape = this.#count - shapes.length;
    let at = 0;
    for (const texels of this.#texels) {
      words.set(texels, at);
      at += texels.length;
    }
    this.#added = [];
    this.#texels = [];
    return { firstShape, shapes, first, words };
  }

  /** Forget all shapes, and number them from 0 again. */
  clear() {
    for (const shapes of this.#known) shapes.clear();
    this.#known.clear();
    this.#added = [];
    this.#texels = [];
    this.#count = this.#next = 0;
  }

  /**
   * Convert a shape again; one that cannot be is left out, and refused when a text needs it.
   *
   * @param {Instance} instance
   * @param {number} glyph
   * @param {Kind} kind
   */
  restore(instance, glyph, kind) {
    try {
      this.of(instance, glyph, kind);
    } catch (error) {
      if (!(error instanceof VextureError)) throw error;
    }
  }

  /** @param {ModuleName} name */
  #kernels(name) {
    const kernels = this.kernels[name];
    if (!kernels) this.wanted.add(name);
    return kernels ?? null;
  }

  /** @param {Instance} instance @param {number} glyph @param {Kind} kind @returns {Shape | null | undefined} undefined if a module is wanted */
  #add(instance, glyph, kind) {
    const key = `${instance.key}:${glyph}${kind.key && `:${kind.key}`}`;
    if (instance.owner.isColored(glyph)) {
      if (!this.#kernels('maps') || !this.colors) return undefined;
      const painted = this.colors.paintGlyph(instance, glyph, kind.isTurned, kind.ink);
      if (!painted) return null;
      if (!kind.part && !painted.isPlain) return this.#addMap(painted, key, instance);
      return this.#addParts(painted.paths.map(({ contours }) => contours), kind, key, instance.em);
    }
    if (instance.owner.hasImages) instance.owner.noteImages(instance, glyph);
    let contours = contoursOf(instance.font, glyph);
    if (kind.isTurned) contours = contours.map(turned);
    return contours.length ? this.#addParts([contours], kind, key, instance.em) : null;
  }

  /** @param {Float64Array[][]} parts @param {Kind} kind @param {string} key @param {number} em @returns {Shape | null | undefined} */
  #addParts(parts, { part, width }, key, em) {
    if (!part) return this.#addSilhouette(parts, key);
    const strokes = this.#kernels('strokes');
    if (!strokes) return undefined;
    const style = {
      width: em * width * (part === 'o' ? 2 : 1), tolerance: em * STROKE_TOLERANCE,
      cap: 'round', join: 'round', miterLimit: 4, dashes: [], dashOffset: 0,
    };
    const lines = parts.flat().flatMap((contour) => outlineStroke(strokes, contour, true, style)).filter(({ length }) => length);
    if (part === 'o') return this.#addSilhouette([...parts, lines], key);
    return lines.length ? this.#addSilhouette([lines], key) : null;
  }

  /** @param {Float64Array[][]} parts each filled by itself @param {string} key @returns {Shape} */
  #addSilhouette(parts, key) {
    const kernels = /** @type {Kernels} */ (this.kernels.silhouettes), box = controlBox(parts.flat()), [left, bottom] = box;
    const side = sideOf(box);
    const placed = (/** @type {Float64Array} */ contour) => contour.map((value, k) => (value - (k & 1 ? bottom : left)) / side);
    const paths = parts.map((contours) => ({ contours: contours.map(placed), fillRule: 0 }));
    const drawing = /** @type {import('../convert/drawing.js').Drawing} */ (/** @type {unknown} */ ({ name: `glyph ${key}`, paths }));
    const texels = silhouetteOf(kernels, drawing, boundsOf(kernels), this.#next);
    return this.#push(box, { key, quad: this.#next, isMap: false, hasGradients: false }, texels);
  }

  /** @param {NonNullable<ReturnType<ColorGlyphs['paintGlyph']>>} painted @param {string} key @param {Instance} instance */
  #addMap(painted, key, instance) {
    const kernels = /** @type {Kernels} */ (this.kernels.maps), colors = /** @type {ColorGlyphs} */ (this.colors);
    const found = colors.mapTexels(kernels, painted, `glyph ${key}`, boundsOf(kernels), this.#next);
    for (const note of painted.notes) instance.owner.notes.add(note);
    if (!found) throw new VextureError(`the emoji of glyph ${key} is too complex for a texture; take another font`, 'text');
    return this.#push(painted.box, { key, quad: found.quad, isMap: true, hasGradients: found.hasGradients }, found.texels);
  }

  /** @param {[number, number, number, number]} box @param {Omit<AddedShape, 'box'>} shape @param {Uint32Array} texels @returns {Shape} */
  #push(box, shape, texels) {
    const [x, y, right, top] = box, side = sideOf(box), width = right - x, height = top - y;
    this.#added.push({ ...shape, box: [width / side, height / side] });
    this.#texels.push(texels);
    this.#next += texels.length / 4;
    return { place: this.#count++, x, y, side, width, height };
  }
}

/** @param {readonly number[]} box */
const sideOf = ([left, bottom, right, top]) => Math.max(right - left, top - bottom) || 1;

/** @param {Kernels} kernels */
const boundsOf = ({ constants: { TOLERANCE, NEAR, MAX_DEPTH } }) => ({
  capacity: undefined, tolerance: TOLERANCE, near: NEAR, leastDepth: 1, maxDepth: MAX_DEPTH, maxSeconds: MAX_SECONDS,
});

/** A contour turned clockwise by a quarter. @param {Float64Array} contour */
const turned = (contour) => contour.map((value, k) => (k % 2 ? -contour[k - 1] : contour[k + 1]));
