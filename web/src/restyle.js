// New colours for the elements of a planar map: another table of paints and other means, in place, for the same tree.
import { CELL_BITS, COORDINATE_BITS, COVERAGE_ONE, IS_MEAN, LATTICE, PAINT_ONE, QUAD_FLAG } from '../generated/layout.js';
import { VextureError, line } from './errors.js';
import { curvesOf, leafOf } from './leaf.js';
import { basePaint, headOf, meanBytes, paintSteps, sidesOf } from './planar-map.js';
import { nearNames } from './select-root.js';
import { composited } from './style.js';

/**
 * @typedef {import('./data.js').PackedData} PackedData
 * @typedef {import('./style.js').Style} Style
 * @typedef {[number, number, number, number]} Paint red, green, blue, opacity: sRGB, not premultiplied, 0..1
 */

const BYTE = (1 << CELL_BITS) - 1;

/** Colours and opacities of elements are whole numbers of these parts, as in files. */
const DIGITS = 1e6;

/** The nearest whole number, of two the even one, as Python rounds: so both write the same texels. @param {number} value */
function rounded(value) {
  const up = Math.round(value);
  return up - value === 0.5 && up % 2 !== 0 ? up - 1 : up;
}

/**
 * Give elements other colours: texels and the style are changed in place.
 *
 * @param {PackedData} data
 * @param {number[]} places of the roots, maps with a style
 * @param {Map<string, Paint>} paints by name
 * @returns {boolean} whether something became visible that was not, or the reverse
 * @throws {VextureError} if no element has a name, or one that hides others would not stay opaque
 */
export function restyle(data, places, paints) {
  const styles = places.map((place) => styleOf(data.roots[place]));
  const known = new Set(styles.flatMap(({ elements }) => elements.map((element) => element.name)));
  known.delete('');
  for (const name of paints.keys()) {
    if (!known.has(name)) {
      throw new VextureError(`${data.name} has no element ${line(name)}; ${nearNames(name, [...known])}`, 'name');
    }
  }
  for (const { elements } of styles) for (const { name, hides } of elements) {
    const opacity = paints.get(name)?.[3] ?? 1;
    if (hides && opacity < 1) {
      throw new VextureError(
        `"${name}" gets the opacity ${opacity}, but the texture does not have what it hides; make it opaque, ` +
          'or convert the drawing with that colour', 'opacity');
    }
  }
  let appears = false;
  for (const [k, quad] of places.map((place) => data.roots[place].quad).entries()) {
    appears = repaint(data, quad, styles[k], paints) || appears;
    for (const root of data.roots) if (root.isMap && root.quad === quad) root.style = styles[k];
  }
  return appears;
}

/**
 * @param {import('./data.js').Root} root
 * @returns {Style}
 */
export function styleOf({ name, style }) {
  if (!style) throw new VextureError(`"${name}" has no elements; convert the drawing with --restyle`, 'style');
  return style;
}

/**
 * @param {PackedData} data
 * @param {number} quad
 * @param {Style} style
 * @param {Map<string, Paint>} paints
 */
function repaint({ texels }, quad, style, paints) {
  const changed = new Set();
  style.elements.forEach((element, number) => {
    const paint = paints.get(element.name);
    if (!paint || !element.name) return;
    const [red, green, blue, opacity] = paint.map((part) => rounded(part * DIGITS) / DIGITS);
    changed.add(number);
    element.color = [red, green, blue];
    element.opacity = opacity;
  });
  const head = headOf(texels, quad);
  let appears = false;
  style.stacks.forEach((stack, paint) => {
    if (!stack.some((number) => changed.has(number))) return;
    const steps = composited(style, stack).map((part) => rounded(PAINT_ONE * Math.min(Math.max(part, 0), 1)));
    appears ||= (paintSteps(texels, head, paint)[3] > 0) !== steps[3] > 0;
    const at = 4 * head.paints + 2 * paint;
    texels[at] = steps[0] + steps[1] * 2 ** COORDINATE_BITS;
    texels[at + 1] = steps[2] + steps[3] * 2 ** COORDINATE_BITS;
  });
  renewMeans(texels, quad);
  return appears;
}

/**
 * What the means of a map are computed from, which no colour changes.
 *
 * @typedef {object} Weights
 * @property {Int32Array} bases base paint of each cell; QUAD and MEAN of those without
 * @property {Int32Array} below of each cell that is a quad, its place in the map
 * @property {Int32Array} starts where the curves of each cell begin, and end
 * @property {Float64Array} areas how often the left paint of each curve counts more in its leaf, the right one less
 * @property {Int32Array} sides left and right paint of each curve
 */

/** @type {WeakMap<Uint32Array, Map<number, Weights>>} */
const WEIGHTS = new WeakMap();

const QUAD = -1;
const MEAN = -2;

/**
 * @param {Uint32Array} texels
 * @param {number} root
 * @returns {Weights}
 */
function weightsOf(texels, root) {
  const known = WEIGHTS.get(texels) ?? new Map();
  WEIGHTS.set(texels, known);
  if (!known.has(root)) known.set(root, measured(texels, root));
  return known.get(root);
}

/**
 * @param {Uint32Array} texels
 * @param {number} root
 * @returns {Weights}
 */
function measured(texels, root) {
  const head = headOf(texels, root);
  /** @type {number[]} */ const bases = [];
  /** @type {number[]} */ const below = [];
  const starts = [0];
  /** @type {number[]} */ const areas = [];
  /** @type {number[]} */ const sides = [];
  for (let quad = root, end = root + 1; quad < end; quad++) {
    for (let k = 0; k < 4; k++) {
      const leaf = leafOf(texels, quad, k);
      const isQuad = leaf.byte === QUAD_FLAG;
      if (isQuad) end = Math.max(end, leaf.below + 1);
      below.push(isQuad ? leaf.below - root : 0);
      bases.push(isQuad ? QUAD : leaf.byte === IS_MEAN ? MEAN : basePaint(texels, head, quad, k));
      if (!isQuad) curvesOf(texels, leaf).forEach((curve, i) => {
        areas.push(areaOf(curve));
        sides.push(...sidesOf(texels, head, leaf.first + i));
      });
      starts.push(areas.length);
    }
  }
  return {
    bases: Int32Array.from(bases), below: Int32Array.from(below), starts: Int32Array.from(starts),
    areas: Float64Array.from(areas), sides: Int32Array.from(sides),
  };
}

/**
 * Part of a leaf in which the left paint of a curve counts more (FORMAT.md, D.8), with the integral of x dy in closed form
 * (Manson and Schaefer, "Wavelet Rasterization", Eurographics 2011).
 *
 * @param {number[]} curve in lattice units
 */
function areaOf(curve) {
  const [x0, y0, x1, y1, x2, y2, x3, y3] = curve.map((at) => at / LATTICE);
  const integral = (x0 * (-10 * y0 + 6 * y1 + 3 * y2 + y3) + x1 * (-6 * y0 + 3 * y2 + 3 * y3)
    + x2 * (-3 * y0 - 3 * y1 + 6 * y3) + x3 * (-y0 - 3 * y1 - 6 * y2 + 10 * y3)) / 20;
  return integral - (y3 - y0) + (x0 === 0 ? 1 - y0 : 0) - (x3 === 0 ? 1 - y3 : 0);
}

/**
 * Write the means of all cells anew, from the leaves up; of a leaf of which only the mean is known it stays.
 *
 * @param {Uint32Array} texels
 * @param {number} root
 */
function renewMeans(texels, root) {
  const { bases, below, starts, areas, sides } = weightsOf(texels, root);
  const head = headOf(texels, root);
  const table = new Float64Array(4 * head.used);
  for (let paint = 0; paint < head.used; paint++) {
    const at = 4 * head.paints + 2 * paint;
    table[4 * paint] = (texels[at] & PAINT_ONE) / PAINT_ONE;
    table[4 * paint + 1] = (texels[at] >>> COORDINATE_BITS) / PAINT_ONE;
    table[4 * paint + 2] = (texels[at + 1] & PAINT_ONE) / PAINT_ONE;
    table[4 * paint + 3] = (texels[at + 1] >>> COORDINATE_BITS) / PAINT_ONE;
  }
  const means = new Float64Array(4 * bases.length);
  for (let cell = bases.length - 1; cell >= 0; cell--) {
    const base = bases[cell];
    const place = 4 * cell;
    if (base === QUAD) {
      for (let c = 0; c < 4; c++) {
        const first = 16 * below[cell] + c;
        means[place + c] = 0.25 * (means[first] + means[first + 4] + means[first + 8] + means[first + 12]);
      }
    } else if (base === MEAN) {
      meanBytes(texels, head, root + (cell >> 2), cell & 3).forEach((part, c) => (means[place + c] = part / COVERAGE_ONE));
    } else {
      for (let c = 0; c < 4; c++) {
        let sum = table[4 * base + c];
        for (let i = starts[cell]; i < starts[cell + 1]; i++) {
          sum += areas[i] * (table[4 * sides[2 * i] + c] - table[4 * sides[2 * i + 1] + c]);
        }
        means[place + c] = sum;
      }
    }
    const opacity = Math.min(Math.max(means[place + 3], 0), 1);
    let word = 0;
    for (let c = 3; c >= 0; c--) {
      word = (word << CELL_BITS) | (rounded(COVERAGE_ONE * Math.min(Math.max(means[place + c], 0), opacity)) & BYTE);
    }
    texels[4 * (head.cells + 2 * (cell >> 2)) + (cell & 3)] = word >>> 0;
  }
}
