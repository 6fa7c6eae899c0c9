// Lines of baked fonts, and what bends them.
import { describe, expect, it } from 'vitest';
import { AtlasFont } from '../src/text/atlas-font.js';
import { onCylinder, isBent } from '../src/text/bends.js';
import { DEFAULTS, requestOf } from '../src/text/text-options.js';

const square = { advance: 0.6, shape: 0, box: [0, 0, 0.5, 0.5], square: [0, 0, 0.5] };
const metrics = {
  glyphs: { a: square, ' ': { advance: 0.25, shape: null } }, kerning: {}, notdef: square,
  lines: { ascender: 1, descender: -0.25, line_gap: 0, x_height: 0.5, cap_height: 0.7 },
};
const font = new AtlasFont(/** @type {any} */ ({ roots: [{}] }), /** @type {any} */ (metrics));
const set = (options) => font.typeset(requestOf({ ...DEFAULTS, ...options }));
const starts = ({ carets }, index) => carets[4 * index];

describe('a text in a baked font', () => {
  it('has tabs that lead to stops', () => {
    const { carets } = set({ text: 'a\ta\ta' });
    expect([2, 4].map((index) => starts({ carets }, index))).toEqual([2, 4]);
    expect(starts(set({ text: 'aaa\ta', tabSize: 2 }), 4)).toBe(2);
    expect(starts(set({ text: 'aaaa\ta', tabSize: 10, fontSize: 2 }), 5)).toBe(10); // 4.8 is too near to 5
    expect(set({ text: 'a\ta\ta', maxWidth: 3 }).lines.map(({ first }) => first)).toEqual([0, 4]);
  });

  it('is indented', () => {
    const { lines, places } = set({ text: 'a a a a', maxWidth: 2.5, textIndent: 1 });
    expect(lines.map(({ left }) => left)).toEqual([1, 0]);
    expect(places[0]).toBe(1);
  });

  it('of no size shows nothing', () => {
    const { shapes, carets, blockBounds, visibleBounds, lines } = set({ text: 'a\ta a\na', fontSize: 0, letterSpacing: 0.1, textIndent: 1, maxWidth: 0 });
    expect(shapes.length).toBe(0);
    expect(lines.length).toBe(2);
    expect([...carets, ...blockBounds, ...visibleBounds].every((value) => value === 0)).toBe(true);
  });
});

describe('a radius', () => {
  it('of 0 or infinity bends nothing, and others a text by it', () => {
    expect([0, -0, Infinity, -Infinity].some(isBent)).toBe(false);
    expect([1, -1, 1e300, 1e-300].every(isBent)).toBe(true);
    const { position, rotation } = onCylinder(1e300)(2, 3);
    expect(position).toEqual([2, 3, 0]);
    [0, 0, 0, 1].forEach((part, k) => expect(rotation[k]).toBeCloseTo(part));
  });
});
