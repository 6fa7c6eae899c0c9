// Glyphs as shapes of a texture: outlines by HarfBuzz, texels by the kernels.
import * as hb from 'harfbuzzjs';
import { silhouetteOf } from '../convert/silhouette.js';

/** Limit of the work on a glyph. */
const MAX_SECONDS = 10;

/** @import { Kernels } from '../convert/kernels.js' */
/** @import { Instance } from './font.js' */

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
 * @typedef {{ firstShape: number, shapes: AddedShape[], first: number, words: Uint32Array }} Added
 */

/** Collects the cubics of a glyph. */
class Outline {
  /** @type {number[]} */
  cubics = [];
  /** Numbers at which a contour begins. @type {number[]} */
  starts = [];
  x = 0;
  y = 0;

  /** @param {number} x @param {number} y */
  move(x, y) {
    if (this.starts.at(-1) !== this.cubics.length) this.starts.push(this.cubics.length);
    this.x = x;
    this.y = y;
  }

  /** @param {number} x @param {number} y */
  line(x, y) {
    const { x: a, y: b } = this, dx = x - a, dy = y - b;
    if (dx || dy) this.cubic(a + dx / 3, b + dy / 3, a + dx * (2 / 3), b + dy * (2 / 3), x, y);
  }

  /** @param {number} u @param {number} v @param {number} x @param {number} y */
  quadratic(u, v, x, y) {
    const { x: a, y: b } = this, third = 2 / 3;
    this.cubic(a + (u - a) * third, b + (v - b) * third, x + (u - x) * third, y + (v - y) * third, x, y);
  }

  /** @param {number} a @param {number} b @param {number} c @param {number} d @param {number} x @param {number} y */
  cubic(a, b, c, d, x, y) {
    this.cubics.push(this.x, this.y, a, b, c, d, x, y);
    this.x = x;
    this.y = y;
  }

  /** Its contours, closed; those without a cubic are left out. @returns {Float64Array[]} */
  contours() {
    const { cubics, starts } = this;
    const parts = starts.map((start, k) => Float64Array.from(cubics.slice(start, starts[k + 1] ?? cubics.length)));
    return parts.filter(({ length }) => length);
  }
}

const pen = new hb.DrawFuncs();
pen.setMoveToFunc((x, y, out) => /** @type {Outline} */ (out).move(x, y));
pen.setLineToFunc((x, y, out) => /** @type {Outline} */ (out).line(x, y));
pen.setQuadraticToFunc((u, v, x, y, out) => /** @type {Outline} */ (out).quadratic(u, v, x, y));
pen.setCubicToFunc((a, b, c, d, x, y, out) => /** @type {Outline} */ (out).cubic(a, b, c, d, x, y));

/** The shapes of a texture that grows. */
export class Shapes {
  /** Kernels of silhouettes. @type {Kernels | null} */
  silhouettes = null;
  #count = 0;
  #next = 0;
  /** @type {AddedShape[]} */
  #added = [];
  /** @type {Uint32Array[]} */
  #texels = [];
  /** @type {Set<Map<number, Shape | null>>} */
  #known = new Set();

  /**
   * The shape of a glyph; null if it shows nothing.
   *
   * @param {Instance} instance
   * @param {number} glyph
   * @param {string} kind what is drawn of it: '' itself, 'r' turned clockwise
   * @returns {Shape | null}
   */
  of(instance, glyph, kind) {
    let shapes = instance.shapes.get(kind);
    if (!shapes) {
      shapes = new Map();
      instance.shapes.set(kind, shapes);
      this.#known.add(shapes);
    }
    let shape = shapes.get(glyph);
    if (shape === undefined) {
      shape = this.#add(instance, glyph, kind);
      shapes.set(glyph, shape);
    }
    return shape;
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
    this.#added = [];
    this.#texels = [];
    this.#count = this.#next = 0;
  }

  /** @param {Instance} instance @param {number} glyph @param {string} kind @returns {Shape | null} */
  #add(instance, glyph, kind) {
    const outline = new Outline();
    instance.font.drawGlyph(glyph, pen, outline);
    let contours = outline.contours();
    if (kind === 'r') contours = contours.map(turned);
    return contours.length ? this.#addSilhouette(contours, `${instance.key}:${glyph}${kind && `:${kind}`}`) : null;
  }

  /** @param {Float64Array[]} contours @param {string} key @returns {Shape} */
  #addSilhouette(contours, key) {
    const kernels = /** @type {Kernels} */ (this.silhouettes);
    let left = Infinity, bottom = Infinity, right = -Infinity, top = -Infinity;
    for (const contour of contours) {
      for (let k = 0; k < contour.length; k += 2) {
        const x = contour[k], y = contour[k + 1];
        if (x < left) left = x;
        if (x > right) right = x;
        if (y < bottom) bottom = y;
        if (y > top) top = y;
      }
    }
    const width = right - left, height = top - bottom, side = Math.max(width, height) || 1;
    for (const contour of contours) {
      for (let k = 0; k < contour.length; k += 2) {
        contour[k] = (contour[k] - left) / side;
        contour[k + 1] = (contour[k + 1] - bottom) / side;
      }
    }
    const { TOLERANCE, NEAR, MAX_DEPTH } = kernels.constants;
    const bounds = { capacity: undefined, tolerance: TOLERANCE, near: NEAR, leastDepth: 1, maxDepth: MAX_DEPTH, maxSeconds: MAX_SECONDS };
    const texels = silhouetteOf(kernels, /** @type {any} */ ({ name: `glyph ${key}`, paths: [{ contours, fillRule: 0 }] }), bounds, this.#next);
    this.#added.push({ key, quad: this.#next, box: [width / side, height / side], isMap: false, hasGradients: false });
    this.#texels.push(texels);
    this.#next += texels.length / 4;
    return { place: this.#count++, x: left, y: bottom, side, width, height };
  }
}

/** A contour turned clockwise by a quarter. @param {Float64Array} contour */
const turned = (contour) => contour.map((value, k) => (k % 2 ? -contour[k - 1] : contour[k + 1]));
