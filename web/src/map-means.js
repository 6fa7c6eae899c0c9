// Recomputes the means of a planar map's cells where a paint has changed. Plain data, without three.js.
import { CELL_BITS, COORDINATE_BITS, COVERAGE_ONE, IS_MEAN, LATTICE, PAINT_ONE, QUAD_FLAG } from '../generated/layout.js';
import { curvesOf, leafOf } from './leaf.js';
import { basePaint, headOf, meanBytes, meansAt, paintSteps, sidesOf } from './planar-map.js';

const QUAD = -1;
const MEAN = -2;

/**
 * What no colour of a map changes. Colours lie in arrays of four components, so places in those are four times as large.
 *
 * @typedef {object} Cells
 * @property {Int32Array} bases of each cell, the place of its base paint's colour; QUAD and MEAN of those without
 * @property {Int32Array} below of each cell that is a quad, the place of the mean of its first cell
 * @property {Int32Array} above of each quad, the cell that it is; -1 of the root
 * @property {Int32Array} starts where the curves of each cell begin, and end
 * @property {Float64Array} areas how often the left paint of each curve counts more in its leaf, the right one less
 * @property {Int32Array} sides places of the colours on the left and right of each curve
 */

/** The nearest whole number, of two the even one, as Python rounds: so both write the same texels. @param {number} value */
export function nearest(value) {
  const up = Math.round(value);
  return up - value === 0.5 && up % 2 !== 0 ? up - 1 : up;
}

/** @param {number} part of a colour, 0..1 but for rounding */
const stepOf = (part) => nearest(PAINT_ONE * Math.min(Math.max(part, 0), 1));

/** The means of a map, unrounded, beside its texels. */
export class MapMeans {
  #texels;
  #head;
  #cells;
  #leaves;
  #colors;
  #means;
  /** Of each cell, whether its mean is to be computed; at first of all. */
  #isStale;

  /**
   * @param {Uint32Array} texels
   * @param {number} quad index of the map's root quad
   */
  constructor(texels, quad) {
    this.#texels = texels;
    this.#head = headOf(texels, quad);
    this.#cells = cellsOf(texels, this.#head);
    const { bases } = this.#cells;
    this.#leaves = leavesOf(this.#cells, this.#head.used);
    this.#colors = new Float64Array(4 * this.#head.used);
    for (let paint = 0; paint < this.#head.used; paint++) {
      this.#colors.set(paintSteps(texels, this.#head, paint).map((part) => part / PAINT_ONE), 4 * paint);
    }
    this.#means = new Float64Array(4 * bases.length);
    for (let cell = 0; cell < bases.length; cell++) {
      if (bases[cell] !== MEAN) continue;
      this.#means.set(meanBytes(texels, this.#head, quad + (cell >> 2), cell & 3).map((part) => part / COVERAGE_ONE), 4 * cell);
    }
    this.#isStale = new Uint8Array(bases.length).fill(1);
  }

  /** Runs of texels, first and end, that hold what can change: means and paints. @returns {[number, number][]} */
  get runs() {
    const { quad, cells, paints, used } = this.#head;
    return [[cells, meansAt(this.#head, quad + this.#cells.bases.length / 4 - 1) + 1], [paints, paints + Math.ceil(used / 2)]];
  }

  /**
   * Recolour a paint; `renew` then updates the means.
   *
   * @param {number} paint
   * @param {import('./planar-map.js').Color} color premultiplied sRGB and opacity, 0..1
   * @returns {boolean} whether it became visible, or the reverse
   */
  repaint(paint, color) {
    const red = stepOf(color[0]);
    const green = stepOf(color[1]);
    const blue = stepOf(color[2]);
    const opacity = stepOf(color[3]);
    const at = 4 * this.#head.paints + 2 * paint;
    const low = (red | (green << COORDINATE_BITS)) >>> 0;
    const high = (blue | (opacity << COORDINATE_BITS)) >>> 0;
    const wasSeen = this.#texels[at + 1] >>> COORDINATE_BITS > 0;
    if (this.#texels[at] === low && this.#texels[at + 1] === high) return false;
    this.#texels[at] = low;
    this.#texels[at + 1] = high;
    const colors = this.#colors;
    colors[4 * paint] = red / PAINT_ONE;
    colors[4 * paint + 1] = green / PAINT_ONE;
    colors[4 * paint + 2] = blue / PAINT_ONE;
    colors[4 * paint + 3] = opacity / PAINT_ONE;
    const { starts, members } = this.#leaves;
    const isStale = this.#isStale;
    for (let i = starts[paint], end = starts[paint + 1]; i < end; i++) isStale[members[i]] = 1;
    return wasSeen !== opacity > 0;
  }

  /** Recompute the means that depend on changed paints, from the leaves up; a leaf of which only the mean is known keeps it. */
  renew() {
    const { bases, below, above } = this.#cells;
    const isStale = this.#isStale;
    const means = this.#means;
    for (let cell = bases.length - 1; cell >= 0; cell--) {
      if (!isStale[cell]) continue;
      isStale[cell] = 0;
      if (bases[cell] >= 0) this.#sum(cell);
      else if (bases[cell] === QUAD) {
        const first = below[cell];
        for (let c = 0; c < 4; c++) {
          means[4 * cell + c] = 0.25 * (means[first + c] + means[first + 4 + c] + means[first + 8 + c] + means[first + 12 + c]);
        }
      }
      this.#write(cell);
      const parent = above[cell >> 2];
      if (parent >= 0) isStale[parent] = 1; // it comes later, as quads lie after those above them
    }
  }

  /** Mean of a leaf. @param {number} cell */
  #sum(cell) {
    const { bases, starts, areas, sides } = this.#cells;
    const colors = this.#colors;
    const base = bases[cell];
    let red = colors[base];
    let green = colors[base + 1];
    let blue = colors[base + 2];
    let opacity = colors[base + 3];
    for (let i = starts[cell]; i < starts[cell + 1]; i++) {
      const area = areas[i];
      const left = sides[2 * i];
      const right = sides[2 * i + 1];
      red += area * (colors[left] - colors[right]);
      green += area * (colors[left + 1] - colors[right + 1]);
      blue += area * (colors[left + 2] - colors[right + 2]);
      opacity += area * (colors[left + 3] - colors[right + 3]);
    }
    const means = this.#means;
    means[4 * cell] = red;
    means[4 * cell + 1] = green;
    means[4 * cell + 2] = blue;
    means[4 * cell + 3] = opacity;
  }

  /** Mean of a cell into its texel. @param {number} cell */
  #write(cell) {
    const means = this.#means;
    const opacity = Math.min(Math.max(means[4 * cell + 3], 0), 1);
    let word = 0;
    for (let c = 3; c >= 0; c--) {
      word = (word << CELL_BITS) | nearest(COVERAGE_ONE * Math.min(Math.max(means[4 * cell + c], 0), opacity));
    }
    this.#texels[4 * meansAt(this.#head, this.#head.quad + (cell >> 2)) + (cell & 3)] = word;
  }
}

/**
 * @param {Uint32Array} texels
 * @param {import('./planar-map.js').Head} head
 * @returns {Cells}
 */
function cellsOf(texels, head) {
  /** @type {number[]} */ const bases = [];
  /** @type {number[]} */ const below = [];
  const above = [-1];
  const starts = [0];
  /** @type {number[]} */ const areas = [];
  /** @type {number[]} */ const sides = [];
  for (let cell = 0; cell < 4 * above.length; cell++) {
    const quad = head.quad + (cell >> 2);
    const leaf = leafOf(texels, quad, cell & 3, true);
    const place = leaf.byte === QUAD_FLAG ? leaf.below - head.quad : 0;
    if (place) above[place] = cell;
    else curvesOf(texels, leaf).forEach((curve, i) => {
      areas.push(areaOf(curve));
      for (const paint of sidesOf(texels, head, leaf.number + i)) sides.push(4 * paint);
    });
    below.push(16 * place);
    bases.push(place ? QUAD : leaf.byte === IS_MEAN ? MEAN : 4 * basePaint(texels, head, quad, cell & 3));
    starts.push(areas.length);
  }
  return {
    bases: Int32Array.from(bases), below: Int32Array.from(below), above: Int32Array.from(above), starts: Int32Array.from(starts),
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
  const [x0, y0, x1, y1, x2, y2, x3, y3] = curve;
  const integral = (x0 * (-10 * y0 + 6 * y1 + 3 * y2 + y3) + x1 * (-6 * y0 + 3 * y2 + 3 * y3)
    + x2 * (-3 * y0 - 3 * y1 + 6 * y3) + x3 * (-y0 - 3 * y1 - 6 * y2 + 10 * y3)) / 20;
  return (y0 - y3 + integral / LATTICE + (x0 === 0 ? LATTICE - y0 : 0) - (x3 === 0 ? LATTICE - y3 : 0)) / LATTICE;
}

/**
 * The leaves that hold each paint.
 *
 * @param {Cells} cells
 * @param {number} used number of paints
 */
function leavesOf({ bases, starts, sides }, used) {
  const last = new Int32Array(used);
  return listed(used, (add) => {
    last.fill(-1);
    const once = (/** @type {number} */ paint, /** @type {number} */ cell) => {
      if (last[paint] !== cell) add(paint, cell);
      last[paint] = cell;
    };
    for (let cell = 0; cell < bases.length; cell++) {
      if (bases[cell] < 0) continue;
      once(bases[cell] / 4, cell);
      for (let i = 2 * starts[cell]; i < 2 * starts[cell + 1]; i++) once(sides[i] / 4, cell);
    }
  });
}

/**
 * A list of numbers for each of some keys, in one array.
 *
 * @typedef {object} Lists
 * @property {Int32Array} starts where the list of each key begins, and that of the one before ends
 * @property {Int32Array} members
 *
 * @param {number} count of keys
 * @param {(add: (key: number, member: number) => void) => void} visit adds all members; it is called twice
 * @returns {Lists}
 */
export function listed(count, visit) {
  const starts = new Int32Array(count + 1);
  visit((key) => starts[key + 1]++);
  for (let key = 0; key < count; key++) starts[key + 1] += starts[key];
  const ends = starts.slice();
  const members = new Int32Array(starts[count]);
  visit((key, member) => (members[ends[key]++] = member));
  return { starts, members };
}
