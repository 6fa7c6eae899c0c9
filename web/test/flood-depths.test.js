import { encode } from 'fast-png';
import { describe, expect, it } from 'vitest';
import { classesAt } from '../flood/chart.js';
import { Depths, Ranks, metres } from '../flood/depths.js';

const CODE = { scale: 50, step: 1e-4 };
/** @type {[number, number | null][]} */
const RANGES = [[0.5, 1], [1, 5], [5, null]];

/** The picture of depths that the Python part makes. @param {number[]} depths @param {number} width */
const pictured = (depths, width) => encode({
  width, height: depths.length / width, channels: 1, depth: 16,
  data: Uint16Array.from(depths, (depth) => Math.round(Math.asinh(depth / CODE.scale) / CODE.step)),
});

/** @param {number[]} ranks @param {number} width */
const ranked = (ranks, width) => new Ranks(
  encode({ width, height: ranks.length / width, channels: 1, depth: 8, data: Uint8Array.from(ranks) }), RANGES,
);

describe('Depths', () => {
  it('are exact to a centimetre or a thousandth, beside the deepest sea', () => {
    const depths = [0.05, 0.27, 0.59, 1, 3.3, 20, 202, 11000];
    const read = new Depths(pictured(depths, depths.length), CODE);
    depths.forEach((depth, at) => {
      const found = read.at((at + 0.5) / depths.length, 0.5);
      expect(Math.abs(found - depth)).toBeLessThan(Math.max(0.003, depth * 1e-4));
    });
    expect(read.textAt(3.5 / depths.length, 0.5)).toBe('1.00 m');
  });

  it('are between the samples that are wet, the northernmost row first', () => {
    const read = new Depths(pictured([1, 3, 0, 0], 2), CODE);
    expect(read.at(0.5, 1)).toBeCloseTo(2, 2);
    expect(read.at(0.25, 0.6)).toBeCloseTo(1, 2); // what is dry counts for nothing
    expect(read.at(0.5, 0)).toBeNaN();
    expect(read.textAt(0.5, 0)).toBeNull();
  });

  it('are said with the digits that are known', () => {
    expect([0.5, 12.345, 199, 202.04, 3548.2].map(metres)).toEqual(['0.50 m', '12.35 m', '199.00 m', '202.0 m', '3,548 m']);
  });

  it('are refused with other bits', () => {
    const png = encode({ width: 1, height: 1, channels: 1, depth: 8, data: new Uint8Array([1]) });
    expect(() => new Depths(png, CODE)).toThrow('8 bits, not 16');
  });
});

describe('Ranks', () => {
  it('are said as the range of the class', () => {
    const read = ranked([0, 1, 2, 3], 4);
    expect([0.375, 0.625, 0.9].map((s) => read.textAt(s, 0.5))).toEqual(['0.5 to 1 m', '1 to 5 m', 'over 5 m']);
    expect(read.textAt(0, 0.5)).toBeNull();
    expect([read.at(0.2, 0.5), read.textAt(0.2, 0.5)]).toEqual([0, '0.5 to 1 m']); // the shore is between samples
  });

  it('are charted as classes of a place', () => {
    const { values, what, range } = classesAt([[0, 0], [1, 0], [3, 0]].map((ranks) => ranked(ranks, 2)), 0, 0.5);
    expect(values).toEqual([NaN, 1, 3]);
    expect(`${what}: ${range(1, 3)}`).toBe('Depth at the marked place: least 0.5 to 1 m, most over 5 m');
    expect(range(1, 1)).toBe('0.5 to 1 m');
  });
});
