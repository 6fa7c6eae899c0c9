/** Depths of the water, or classes of them, from images of them. */
import { decode } from 'fast-png';
import { short } from './shades.js';

/** A class of depth: metres from which it begins and at which it ends, if it does. @typedef {[number, number | null]} Range */

/** Metres from which depths have less than two decimals, and less than one: the picture does not tell more. */
const [ONE_DECIMAL, NO_DECIMAL] = [200, 2000];

/** A grid over the box, the northernmost row first. */
class Grid {
  /** @param {Uint8Array} png gray @param {number} bits @param {string} what */
  constructor(png, bits, what) {
    const { width, height, depth, channels, data } = decode(png);
    if (depth !== bits || channels !== 1) {
      throw new Error(`The picture of the ${what} has ${channels} x ${depth} bits, not ${bits}.`);
    }
    Object.assign(this, { width, height, data });
  }

  width = 0;
  height = 0;
  /** @type {ArrayLike<number>} */
  data = [];

  /**
   * The four samples around a place, and their shares of it.
   *
   * @param {number} s eastwards, 0..1
   * @param {number} t northwards, 0..1
   */
  around(s, t) {
    const { width, height, data } = this;
    const x = Math.min(Math.max(s * width - 0.5, 0), width - 1);
    const y = Math.min(Math.max((1 - t) * height - 0.5, 0), height - 1);
    const [column, row] = [Math.min(Math.floor(x), Math.max(width - 2, 0)), Math.min(Math.floor(y), Math.max(height - 2, 0))];
    return [[0, 0], [1, 0], [0, 1], [1, 1]].map(([right, down]) => ({
      number: data[Math.min(row + down, height - 1) * width + Math.min(column + right, width - 1)],
      share: Math.abs(1 - right - (x - column)) * Math.abs(1 - down - (y - row)),
    }));
  }
}

export class Depths {
  #grid;
  #code;

  /**
   * @param {Uint8Array} png 16-bit gray, over the box, northernmost row first; 0: dry or unknown
   * @param {{scale: number, step: number}} code a depth is `scale` times the hyperbolic sine of its number times `step`
   */
  constructor(png, code) {
    this.#grid = new Grid(png, 16, 'depths');
    this.#code = code;
  }

  /**
   * Metres at a place of the box, between the samples around it that are wet; NaN if none is.
   *
   * @param {number} s eastwards, 0..1
   * @param {number} t northwards, 0..1
   */
  at(s, t) {
    const { scale, step } = this.#code;
    const wet = this.#grid.around(s, t).filter(({ number, share }) => number > 0 && share > 0);
    const whole = wet.reduce((sum, { share }) => sum + share, 0);
    return wet.reduce((sum, { number, share }) => sum + share * scale * Math.sinh(number * step), 0) / whole;
  }

  /** What is said of a place; null if its depth is not known. @param {number} s @param {number} t */
  textAt(s, t) {
    const depth = this.at(s, t);
    return Number.isNaN(depth) ? null : metres(depth);
  }
}

export class Ranks {
  #grid;
  #ranges;

  /**
   * @param {Uint8Array} png 8-bit gray, over the box, northernmost row first; 0: dry or unknown, 1: the first class
   * @param {Range[]} ranges of the classes
   */
  constructor(png, ranges) {
    this.#grid = new Grid(png, 8, 'classes');
    this.#ranges = ranges;
  }

  /**
   * Number of the class at a place of the box, from 1, and 0 where it is dry: that of the nearest sample.
   *
   * @param {number} s eastwards, 0..1
   * @param {number} t northwards, 0..1
   */
  at(s, t) {
    return this.#nearest(s, t)[0].number;
  }

  /** What is said of a wet place; null if no sample around it is wet. @param {number} s @param {number} t */
  textAt(s, t) {
    const wet = this.#nearest(s, t).find(({ number }) => number > 0); // the shore is between samples
    return wet ? this.textOf(wet.number) : null;
  }

  /** @param {number} s @param {number} t */
  #nearest(s, t) {
    return this.#grid.around(s, t).filter(({ share }) => share > 0).sort((one, other) => other.share - one.share);
  }

  /** What is said of a class. @param {number} rank from 1 */
  textOf(rank) {
    return rangeText(this.#ranges[rank - 1]);
  }
}

/** A range for people. @param {Range} range */
export const rangeText = ([low, high]) => (high === null ? `over ${short(low)} m` : `${short(low)} to ${short(high)} m`);

/** A depth for people. @param {number} depth */
export function metres(depth) {
  const digits = depth < ONE_DECIMAL ? 2 : depth < NO_DECIMAL ? 1 : 0;
  return `${depth.toLocaleString('en', { minimumFractionDigits: digits, maximumFractionDigits: digits })} m`;
}
