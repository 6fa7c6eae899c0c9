import { encode } from 'fast-png';
import { describe, expect, it } from 'vitest';
import { mixedLevels, readLevels } from '../flood/levels.js';
import { opennessOver } from '../flood/openness.js';
import { Relief } from '../flood/relief.js';

const FACTS = { lowest: -2.5, unit: 0.5 };
const SIZE = { columns: 3, rows: 2 };
const png = (/** @type {number[]} */ numbers, width = 3, depth = 16) => encode({
  width, height: numbers.length / width, channels: 1, depth: /** @type {8 | 16} */ (depth),
  data: depth === 16 ? Uint16Array.from(numbers) : Uint8Array.from(numbers),
});

describe('levels', () => {
  it('are the lowest and so many units, and none where there is no water', () => {
    const { levels, wet } = readLevels(png([0, 1, 2, 32767, 32768 + 3, 11]), FACTS, SIZE);
    expect([...levels]).toEqual([NaN, -2.5, -2, 16380.5, -1.5, 2.5]);
    expect([...wet]).toEqual([0, 1, 1, 1, 0, 1]);
  });

  it('are refused in another size or depth', () => {
    expect(() => readLevels(png([1, 2, 3, 4], 2), FACTS, SIZE)).toThrow('2 x 2 with 1 x 16 bits, not 3 x 2 with 16');
    expect(() => readLevels(png([1, 2, 3, 4, 5, 6], 3, 8), FACTS, SIZE)).toThrow('1 x 8 bits');
  });

  it('between two steps are between theirs, or those of the one that has water', () => {
    const [from, to] = [Float32Array.of(1, NaN, 3, NaN), Float32Array.of(2, 5, NaN, NaN)];
    expect([...mixedLevels(from, to, 0.25)]).toEqual([1.25, 5, 3, NaN]);
  });
});

describe('openness', () => {
  it('is 0 without a picture', () => {
    expect([...opennessOver(new Relief(SIZE, new Float32Array(6)), null)]).toEqual([0, 0, 0, 0, 0, 0]);
  });

  it('is that of the pixels, whose middles are not at the border', () => {
    const found = opennessOver(new Relief(SIZE, new Float32Array(6)), png([255, 255, 0, 0, 255, 255, 0, 0], 4, 8));
    expect([...found]).toEqual([1, 0.5, 0, 1, 0.5, 0]);
  });
});
