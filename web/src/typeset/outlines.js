// Outlines of glyphs as cubics.
import * as hb from 'harfbuzzjs';

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

/**
 * The contours of a glyph in units of its font, closed.
 *
 * @param {hb.Font} font
 * @param {number} glyph
 * @returns {Float64Array[]}
 */
export function contoursOf(font, glyph) {
  const outline = new Outline();
  font.drawGlyph(glyph, pen, outline);
  return outline.contours();
}

/**
 * Box of the control points of contours: least x and y, largest x and y.
 *
 * @param {readonly Float64Array[]} contours
 * @returns {[number, number, number, number]}
 */
export function controlBox(contours) {
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
  return [left, bottom, right, top];
}
