// The style of a stroke; its outline comes from a function of the caller.
import { number, words } from './lengths.js';
import { propertyLength, readLength } from './shapes.js';

/** @typedef {import('./shapes.js').Shape} Shape */
/** @typedef {import('./contours.js').Outline} Outline */

/**
 * @typedef {object} StrokeStyle in the units of the path
 * @property {number} width of the line
 * @property {string} cap "butt", "round" or "square"
 * @property {string} join "miter", "round" or "bevel"
 * @property {number} miterLimit longest miter, in stroke widths
 * @property {number[]} dashes alternating lengths of dashes and gaps, an even number; empty for a solid line
 * @property {number} dashOffset position in the pattern at which the line starts
 * @property {number} tolerance largest distance from the exact outline
 *
 * @typedef {(cubics: Float64Array, closed: boolean, style: StrokeStyle) => Float64Array[]} StrokeOutline
 *   contours of a stroke, to fill by the nonzero rule
 */

/** Most dashes that are counted: numbers up to here are exact. */
const MOST_COUNTED = 1e15;

/** Positive nodes and weights of Gauss-Legendre quadrature with 16 nodes. */
const QUADRATURE = [
  [0.09501250983763744, 0.1894506104550685], [0.2816035507792589, 0.1826034150449236],
  [0.45801677765722737, 0.16915651939500254], [0.6178762444026438, 0.14959598881657674],
  [0.755404408355003, 0.12462897125553388], [0.8656312023878318, 0.09515851168249279],
  [0.9445750230732326, 0.062253523938647894], [0.9894009349916499, 0.027152459411754094],
];

/** @param {Float64Array} cubics @returns {number} their length */
function arcLength(cubics) {
  let length = 0;
  for (let k = 0; k < cubics.length; k += 8) {
    for (const [node, weight] of QUADRATURE) {
      for (const t of [(1 - node) / 2, (1 + node) / 2]) length += (weight / 2) * speedAt(cubics, k, t);
    }
  }
  return length;
}

/** @param {Float64Array} cubics @param {number} at @param {number} t @returns {number} */
function speedAt(cubics, at, t) {
  const s = 1 - t;
  const [x, y] = [0, 1].map((axis) => {
    const [p0, p1, p2, p3] = [0, 2, 4, 6].map((k) => cubics[at + k + axis]);
    return 3 * (s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2));
  });
  return Math.sqrt(x * x + y * y);
}

/**
 * The stroke of a shape; null if it has no width.
 *
 * @param {Shape} shape
 * @param {Outline[]} outlines
 * @returns {Omit<StrokeStyle, 'tolerance'> | null}
 */
export function strokeOf(shape, outlines) {
  const { style, report } = shape;
  const width = propertyLength(shape, 'stroke-width') ?? 0;
  if (!(width > 0)) return null;
  let join = style.get('stroke-linejoin');
  if (join === 'miter-clip' || join === 'arcs') {
    report.simplified(`stroke-linejoin ${join} drawn as miter`);
    join = 'miter';
  }
  let dashes = dashesOf(shape);
  let dashOffset = propertyLength(shape, 'stroke-dashoffset') ?? 0;
  const whole = number(report.engine.attribute(shape.element, 'pathLength') ?? '');
  if (dashes.length && whole !== null && whole > 0) {
    const factor = outlines.reduce((sum, { cubics }) => sum + arcLength(cubics), 0) / whole;
    [dashes, dashOffset] = [dashes.map((dash) => dash * factor), dashOffset * factor];
  }
  const miterLimit = Math.max(number(style.get('stroke-miterlimit')) ?? 0, 1);
  return { width, cap: style.get('stroke-linecap'), join, miterLimit, dashes, dashOffset };
}

/** @param {Shape} shape @returns {number[]} lengths of dashes and gaps; none for a solid line */
function dashesOf(shape) {
  const text = shape.style.get('stroke-dasharray');
  if (text === 'none') return [];
  const lengths = words(text).map((part) => readLength(shape, 'stroke-dasharray', part) ?? 0);
  if (lengths.length % 2) lengths.push(...lengths);
  return lengths.reduce((sum, length) => sum + length, 0) > 0 ? lengths : [];
}

/**
 * Count the dashes of a stroke, up to 1e15.
 *
 * @param {Outline[]} outlines
 * @param {Omit<StrokeStyle, 'tolerance'>} stroke
 * @returns {number} of dashes; 0 for a solid line
 */
export function dashCount(outlines, { dashes }) {
  if (!dashes.length) return 0;
  const length = outlines.reduce((sum, { cubics }) => sum + arcLength(cubics), 0);
  const count = ((length / dashes.reduce((sum, dash) => sum + dash, 0)) * dashes.length) / 2;
  return count <= MOST_COUNTED ? Math.floor(count) : MOST_COUNTED;
}
