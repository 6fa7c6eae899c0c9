import { encode } from 'fast-png';
import { describe, expect, it } from 'vitest';
import { Depths } from '../flood/depths.js';

describe('Depths', () => {
  it('are shares of the deepest, the northernmost row first', () => {
    const png = encode({ width: 2, height: 2, channels: 1, depth: 8, data: new Uint8Array([0, 255, 51, 102]) });
    const depths = new Depths(png, 10);
    expect([depths.at(0, 1), depths.at(1, 1), depths.at(0, 0), depths.at(1, 0)]).toEqual([0, 10, 2, 4]);
    expect(depths.at(0.9, 0.9)).toBe(10);
  });

  it('are refused with more bits', () => {
    const png = encode({ width: 1, height: 1, channels: 1, depth: 16, data: new Uint16Array([1]) });
    expect(() => new Depths(png, 10)).toThrow('16 bits, not 8');
  });
});
