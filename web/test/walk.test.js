import { describe, expect, test } from 'vitest';
import { readPacked } from '../src/packed.js';
import { ThesisTexture, readThesis } from '../src/thesis/index.js';
import { VectorTexture } from '../src/vector-texture.js';
import { bounds, cellAt, contains, counts } from '../src/walk.js';
import { fixture, ktx2 } from './files.js';

const duck = await readPacked(fixture('duck.ktx2'));
const drawings = await readPacked(fixture('drawings.ktx2'));

/** FORMAT.md, B.10. */
const triangle = await readPacked(
  ktx2([
    [1, 1, 0x14140c, 0x48488f],
    [0x80002000, 0xa0006000, 0x80006000, 0x20002000],
    [0x20006000, 0x80008000, 0xa0006000, 0x80000000],
    [0x20000000, 0x60006000, 0x60008000, 0x20006000],
    [0x8000, 0x6000a000, 0x80008000, 0x60002000],
    [0x60002000, 0x80006000, 0x60006000, 0x2000],
    [0, 0, 0, 0],
    [0, 0, 0, 0],
  ]),
);

/** Points all over the unit square and on the lines of its cells. */
const points = Array.from({ length: 4096 }, (_, i) => [((i % 64) + (i % 3) / 3) / 64, (Math.floor(i / 64) + (i % 5) / 7) / 64]);

describe('contains', () => {
  test('the triangle of FORMAT.md', () => {
    for (const [u, v] of points) {
      const slack = u + v - 1;
      if (Math.abs(slack) < 1e-4) continue;
      expect(contains(triangle, 0, u, v)).toBe(u >= 0.125 && v >= 0.125 && slack < 0);
    }
  });

  test('nothing beyond the unit square, and no number', () => {
    for (const [u, v] of [[-0.001, 0.5], [1, 0.5], [0.5, 1], [0.5, -1], [NaN, 0.5], [0.5, Infinity]]) {
      expect(contains(duck, 0, u, v)).toBe(false);
      expect(cellAt(duck, 0, u, v)).toBeNull();
    }
  });

  test('a thesis texture agrees but for its tolerance', async () => {
    const pair = await readThesis(fixture('sixteen/duck.quads.png'), fixture('sixteen/duck.curves.png'));
    const [packed, thesis] = [new VectorTexture(duck), new ThesisTexture(pair)];
    const differ = points.filter(([u, v]) => packed.contains(u, v) !== thesis.contains(u, v));
    expect(differ.length).toBeLessThan(points.length / 500);
    expect(points.filter(([u, v]) => thesis.contains(u, v)).length).toBeGreaterThan(1000);
    expect(thesis.contains(1, 0.5)).toBe(false);
  });
});

describe('cellAt', () => {
  test('a leaf of the triangle, its curves in the unit square', () => {
    const cell = cellAt(triangle, 0, 0.9, 0.1);
    expect(cell).toMatchObject({ depth: 1, x: 0.5, y: 0, size: 0.5, isQuad: false, quad: 0, cell: 1, winding: 0 });
    expect(cell?.coverage).toBeCloseTo(0.28125, 2);
    expect(cell?.curves.map((curve) => [...curve.slice(0, 2), ...curve.slice(6)])).toEqual([
      [0.875, 0.125, 0.5, 0.5],
      [0.5, 0.125, 0.875, 0.125],
    ]);
    expect(cell?.curves[0][2]).toBeCloseTo(0.75, 12); // P1 at one third
    expect(cellAt(triangle, 0, 0.9, 0.9)).toMatchObject({ cell: 3, coverage: 0, curves: [], winding: 0 });
  });

  test('tiles the unit square, each leaf with what its quad says', () => {
    for (const root of drawings.roots) {
      const leaves = new Map();
      for (const [u, v] of points) {
        const cell = cellAt(drawings, root.quad, u, v);
        if (!cell) throw new Error('a point of the unit square without a cell');
        expect(u >= cell.x && u < cell.x + cell.size && v >= cell.y && v < cell.y + cell.size).toBe(true);
        expect(cell.size).toBe(2 ** -cell.depth);
        expect(cell.isQuad).toBe(false);
        leaves.set(`${cell.quad} ${cell.cell}`, cell);
      }
      const all = [...leaves.values()];
      expect(all.reduce((sum, { size }) => sum + size * size, 0)).toBeCloseTo(1, 12);
      expect(all.reduce((sum, { curves }) => sum + curves.length, 0)).toBe(counts(drawings, root.quad).curves);
    }
  });

  test('no deeper than asked', () => {
    const { depth } = counts(duck, 0);
    expect(depth).toBeGreaterThan(0);
    for (const most of [0, 1, 2]) {
      const cells = points.map(([u, v]) => cellAt(duck, 0, u, v, most));
      expect(Math.max(...cells.map((cell) => cell?.depth ?? 99))).toBe(most);
      expect(cells.some((cell) => cell?.isQuad)).toBe(most <= depth);
      expect(cells.every((cell) => !cell?.isQuad || cell.curves.length === 0)).toBe(true);
    }
    const whole = cellAt(duck, 0, 0.3, 0.3, 0);
    const inside = points.filter(([u, v]) => contains(duck, 0, u, v)).length / points.length;
    expect(whole).toMatchObject({ depth: 0, size: 1, isQuad: true, cell: -1 });
    expect(whole?.coverage).toBeCloseTo(inside, 1);
  });
});

describe('bounds and counts', () => {
  test('of the triangle', () => {
    for (const [axis, at] of bounds(triangle, 0).entries()) expect(at).toBeCloseTo(axis < 2 ? 0.125 : 0.875, 4);
    expect(counts(triangle, 0)).toEqual({ quads: 1, curves: 5, depth: 0 });
  });

  test('hold every point inside, and little else', () => {
    for (const [data, quad] of /** @type {const} */ ([[duck, 0], ...drawings.roots.map((root) => [drawings, root.quad])])) {
      const [x0, y0, x1, y1] = bounds(data, quad);
      const inside = points.filter(([u, v]) => contains(data, quad, u, v));
      for (const [u, v] of inside) expect(u >= x0 && u < x1 && v >= y0 && v < y1).toBe(true);
      const [us, vs] = [0, 1].map((axis) => inside.map((point) => point[axis]));
      const slack = [Math.min(...us) - x0, Math.min(...vs) - y0, x1 - Math.max(...us), y1 - Math.max(...vs)];
      expect(Math.max(...slack)).toBeLessThan(0.04); // the points are 1/64 apart
    }
  });

  test('of leaves that are filled beyond their curves', async () => {
    const vertical = [0x20002000, 0x6aab6000, 0x95556000, 0x40002000]; // x = 1/4, y from 1/4 to 1/2, upwards
    const leaf = async (/** @type {number} */ winding) =>
      bounds(await readPacked(ktx2([[0, 1, 0x08 + 4 + winding, 0x7f], vertical])), 0);
    expect(await leaf(1)).toEqual([0, 0, 0.5, 0.5]); // filled, but for what is right of the curve
    const [x0, y0, x1, y1] = await leaf(0);
    for (const [at, expected] of [[x0, 0.125], [y0, 0.125], [x1, 0.125], [y1, 0.25]]) expect(at).toBeCloseTo(expected, 3);
  });

  test('of a leaf that is filled above its only, horizontal curve', async () => {
    const level = [0x40000000, 0x80006aab, 0x80009555, 0x40008000]; // y = 1/2 of the leaf, from its left edge
    const [x0, y0, x1, y1] = bounds(await readPacked(ktx2([[0, 1, 0x0c, 0x7f], level])), 0);
    expect([x0, x1, y1]).toEqual([0, 0.5, 0.5]);
    expect(y0).toBeCloseTo(0.25, 4);
  });

  test('go down no deeper than cells of 1/256', async () => {
    const texels = Array.from({ length: 16 }, (_, quad) => (quad < 15 ? [quad + 1, 0, 0x80, 0] : [0, 0, 0, 0xff]));
    const deep = await readPacked(ktx2(texels));
    expect(bounds(deep, 0)).toEqual([0, 0, 1 / 256, 1 / 256]);
    expect(counts(deep, 0)).toEqual({ quads: 16, curves: 0, depth: 15 });
  });

  test('of an empty shape', async () => {
    expect(bounds(await readPacked(ktx2([[0, 0, 0, 0]])), 0)).toEqual([0, 0, 0, 0]);
  });
});
