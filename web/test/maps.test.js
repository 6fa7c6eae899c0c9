import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { TEXT_ROOTS, TEXT_VERSION } from '../generated/layout.js';
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';
import { paintAt } from '../src/walk-map.js';
import { bounds, cellAt, contains, counts } from '../src/walk.js';
import { TEXTS, altered, fixture, ktx2 } from './files.js';
import { expectRefusal } from './refused.js';

/** The example of FORMAT.md, D.9: a red triangle, and a translucent blue one that shares its long side. */
const PART = readFileSync(new URL('../../FORMAT.md', import.meta.url), 'utf8').split('### D.9 Example')[1].split('### D.10')[0];
const ROWS = [...PART.matchAll(/^\| \d+ \|((?: [0-9a-f]{8} \|){4})/gm)].map(([, row]) => row.match(/\w{8}/g) ?? []);
const texels = new Uint32Array(4 * 16);
ROWS.flat().forEach((word, place) => (texels[place] = parseInt(word, 16)));
const texts = { ...TEXTS, [TEXT_VERSION]: '2', [TEXT_ROOTS]: /\[\{"name".*\]/.exec(PART)?.[0] ?? '' };

const example = await readPacked(ktx2(texels, texts));
const maps = await readPacked(fixture('maps.ktx2'));
const drawn = await readPacked(fixture('drawings.ktx2'));
const shades = await readPacked(fixture('shades.ktx2'));

describe('what is read', () => {
  test('the example of FORMAT.md, D.9', () => {
    expect(example.roots).toMatchObject([{ name: 'two', quad: 2, isMap: true, paint: null }]);
    expect(counts(example, 2)).toEqual({ quads: 1, curves: 8, depth: 0 });
    expect([[0.7, 0.7], [0.3, 0.3], [0.05, 0.5], [0.125, 0.5], [0.9, 0.1]].map(([u, v]) => paintAt(example, 2, u, v).paint))
      .toEqual([2, 1, 0, 1, 0]);
    expect(paintAt(example, 2, 0.3, 0.3).color).toEqual([1, 0, 0, 1]);
    expect(paintAt(example, 2, 0.7, 0.7).color).toEqual([0, 0, 0x8000 / 0xffff, 0x8000 / 0xffff]);
  });

  test('more than 256 paints, whose numbers beside curves take two bytes', async () => {
    const wide = new Uint32Array(4 * 256);
    wide.set(texels.subarray(0, 40));
    wide.set([257, 8, 10, 12], 4);
    wide.set([0, 0x00020000], 32);
    wide.set([0x00010000, 0x00020001, 0x00000002, 0x00000001, 0x00020001, 0x00010000, 0x00000002, 0x00020000], 40);
    wide.set(texels.subarray(44, 52), 48);
    const many = await readPacked(ktx2(wide, texts));
    for (const [u, v] of [[0.7, 0.7], [0.3, 0.3], [0.05, 0.5], [0.9, 0.1]]) {
      expect(paintAt(many, 2, u, v)).toEqual(paintAt(example, 2, u, v));
    }
    await expectRefusal(readPacked(altered(many, (words) => (words[40] = 0x01010000))), 'quad 2', /has paint 257 of 257/);
  });

  test('maps and a layer in one file', () => {
    expect(maps.roots.map(({ isMap, paint }) => [isMap, paint !== null])).toEqual([[true, false], [true, false], [false, true]]);
    const red = paintAt(maps, maps.roots[1].quad, 0.5, 0.7).color;
    expect(red).toEqual([0xdc / 255, 0x26 / 255, 0x26 / 255, 1]);
  });

  test('several roots of one map', async () => {
    const [root] = JSON.parse(texts[TEXT_ROOTS]);
    const file = ktx2(texels, { ...texts, [TEXT_ROOTS]: JSON.stringify([root, { ...root, name: 'again' }]) });
    expect((await readPacked(file)).roots).toHaveLength(2);
  });
});

describe('queries', () => {
  test('nothing beyond the unit square, and no number', () => {
    for (const [u, v] of [[-0.001, 0.5], [1, 0.5], [0.5, 1], [0.5, -1], [NaN, 0.5], [0.5, Infinity]]) {
      expect(paintAt(example, 2, u, v)).toEqual({ paint: null, color: [0, 0, 0, 0] });
      expect(contains(example, 2, u, v)).toBe(false);
    }
  });

  test('what is painted is inside, and within the bounds', () => {
    expect([[0.7, 0.7], [0.3, 0.3], [0.05, 0.5], [0.9, 0.1]].map(([u, v]) => contains(example, 2, u, v)))
      .toEqual([true, true, false, false]);
    bounds(example, 2).forEach((at, k) => expect(at).toBeCloseTo([0.125, 0.125, 0.875, 0.875][k], 4));
  });

  test('the colour of a drawing', () => {
    const [texture, layers] = [new VectorTexture(maps), new VectorTexture(drawn)];
    expect(texture.colorAt(0.5, 0.7, 'flag')).toEqual({ color: [0xdc / 255, 0x26 / 255, 0x26 / 255], opacity: 1 });
    expect(texture.colorAt(0.5, 0.05, 'flag')).toEqual({ color: [0, 0, 0], opacity: 0 });
    for (const [u, v] of [[0.5, 0.47], [0.5, 0.1], [0.5, 0.7], [0.02, 0.02]]) {
      const [one, other] = [texture.colorAt(u, v, 'badge'), layers.colorAt(u, v, 'badge')];
      expect(one.opacity).toBeCloseTo(other.opacity, 4);
      one.color.forEach((part, k) => expect(part).toBeCloseTo(other.color[k], 4));
    }
    expect(() => texture.colorAt(0.5, 0.5)).toThrow(/maps holds 3 drawings \(badge, flag, duck\); choose one by root/);
  });

  test('cells have their paints', () => {
    expect(cellAt(example, 2, 0.9, 0.1)).toMatchObject({
      depth: 1, winding: 0, coverage: 0x6c / 255, paints: { base: 0, mean: [0x48, 0, 0x24, 0x6c].map((part) => part / 255) },
    });
    expect(cellAt(example, 2, 0.9, 0.1)?.paints?.sides).toEqual([[1, 2], [2, 0], [1, 0]]);
    expect(cellAt(example, 2, 0.9, 0.1, 0)).toMatchObject({ isQuad: true, paints: { base: null, sides: [] } });
    expect(cellAt(maps, maps.roots[2].quad, 0.5, 0.5)?.paints).toBeNull();
  });
});

/** Broken in one place: what to expect, and the change. @type {[string, RegExp, (texels: Uint32Array) => void][]} */
const BROKEN = [
  ['a head that goes on', /the map with root 2 has a head that is not 0 where it must be/, (words) => (words[3] = 1)],
  ['programs without a number', /has a head that is not 0 where it must be/, (words) => (words[0] = 20)],
  ['no paints', /has 0 paints; the limit is 16777216/, (words) => (words[4] = 0)],
  ['too many paints', /has 16777217 paints/, (words) => (words[4] = 16777217)],
  ['cells beyond the end', /the cells of the map with root 2 end at texel 17 of 16/, (words) => (words[5] = 15)],
  ['cells far beyond the end', /the cells of the map/, (words) => (words[5] = 0xffffffff)],
  ['sides beyond the end', /the sides of the map with root 2 end at texel 17 of 16/, (words) => (words[6] = 16)],
  ['paints beyond the end', /the paints of the map with root 2 end at texel 17 of 16/, (words) => (words[7] = 15)],
  ['cells over curves', /texel 6 is a part of two things/, (words) => (words[5] = 6)],
  ['sides over cells', /texel 8 is a part of two things/, (words) => (words[6] = 8)],
  ['paints over the head', /texel 0 is a part of two things/, (words) => (words[7] = 0)],
  ['a quad with another number', /curves out of number or a curve that goes down/, (words) => (words[11] = 1)],
  ['a curve that goes down', /curves out of number or a curve that goes down/, (words) => (words[12] = 0xa0002000)],
  ['the second of two curves goes down', /or a curve that goes down/, (words) => (words[19] = 0x10006000)],
  ['a curve beside one that is alone', /texel 3 of one curve has a second one/, (words) => (words[14] = 1)],
  ['a cell with a winding', /quad 2, cell 0 is 10, which is no valid cell/, (words) => words[10]++],
  ['a cell of another kind', /quad 2, cell 0 is 1, which is no valid cell/, (words) => (words[10] = 1)],
  ['a base paint of a mean', /a cell without a base paint has one/, (words) => (words[10] = 0x02111909)],
  ['a base paint beyond the table', /has paint 3 of 3/, (words) => (words[32] = 3)],
  ['a side beyond the table', /has paint 4 of 3/, (words) => (words[40] = 0x02010104)],
  ['a mean above its opacity', /a colour above its opacity/, (words) => (words[36] = 0x8f000090)],
  ['a paint above its opacity', /a colour above its opacity/, (words) => (words[49] = 0x80008001)],
  ['an end beyond the lattice', /curve 3 has an end at 40960/, (words) => (words[13] = 0xa0002000)],
  ['an end of a second curve beyond it', /curve 4 has an end at 40960/, (words) => (words[19] = 0xa0006000)],
  ['a texel that is no part', /texel 15 belongs to no root and is not 0/, (words) => (words[60] = 1)],
];

describe('gradients', () => {
  const [{ quad }] = shades.roots;
  /** @param {number} x @param {number} y of the source, downwards */
  const at = (x, y) => paintAt(shades, quad, x / 64, 1 - y / 64).color;
  /** @param {number[]} color @param {number[]} wanted */
  const expectColor = (color, wanted) => wanted.forEach((part, k) => expect(color[k]).toBeCloseTo(part, 4));

  test('along a line', () => {
    for (const t of [0.125, 0.25, 0.75]) expectColor(at(64 * t, 24), [1 - t, 0, t, 1]);
  });

  test('about a point, and back again', () => {
    for (const [t, back] of [[0.25, 0.25], [0.5, 0.5], [1.0625, 0.9375]]) {
      const grey = 1 - back;
      expectColor(at(16 + (16 * t) / Math.SQRT2, 48 - (16 * t) / Math.SQRT2), [grey, grey, grey, 1]);
    }
  });

  test('about a focal point, in a translucent group over a colour', () => {
    // on the axis the circle at t reaches from 40 - 8 t to 40 + 24 t
    for (const [x, t] of [[46, 0.25], [58, 0.75], [34, 0.75]]) expectColor(at(x, 48), [0.5, t / 2, (1 - t) / 2, 1]);
  });

  test('as masks, by luminance and by opacity', () => {
    for (const t of [0.25, 0.75]) {
      expectColor(at(16 * t, 5), [t * (1 - t / 4), 1 - t, (t * t) / 4, 1]);
      const below = 56 / 64;
      expectColor(at(56, 16 * t), [t + (1 - t) * (1 - below), t, t + (1 - t) * below, 1]);
    }
  });

  test('cells know what paints are programs', () => {
    expect(contains(shades, quad, 0.5, 0.5)).toBe(true);
    expect(bounds(shades, quad)).toEqual([0, 0, 1, 1]);
  });
});

/** The head says where operations begin; the first is the linear gradient's. */
const PROGRAMS = shades.texels[4 * (shades.roots[0].quad - 2)];
const STOPS = PROGRAMS + shades.texels[4 * (shades.roots[0].quad - 2) + 1];
const kindAt = (/** @type {number} */ texel) => shades.texels[4 * texel + 3] >>> 29;
const place = (/** @type {number} */ kind) => 4 * [...Array(STOPS - PROGRAMS).keys()].map((k) => PROGRAMS + k).find((k) => kindAt(k) === kind);

/** @type {[string, RegExp, (texels: Uint32Array) => void][]} */
const BROKEN_PROGRAMS = [
  ['more operations than texels', /the programs of the map/, (words) => (words[4 * (shades.roots[0].quad - 2) + 1] = 0xfffffff0)],
  ['fewer operations', /they leave gaps/, (words) => words[4 * (shades.roots[0].quad - 2) + 1]--],
  ['another kind', /of the wrong length|half of an operation/, (words) => (words[place(2) + 3] &= 0x1fffffff)],
  ['half of a gradient', /half of an operation|of the wrong length/, (words) => (words[place(2) + 3] |= 0xe0000000)],
  ['a number that is not finite', /a number is not finite/, (words) => (words[place(2)] = 0x7f800000)],
  ['stops beyond the part', /stops elsewhere/, (words) => (words[place(2) + 3] |= 0x7ffff)],
  ['no stops', /stops elsewhere/, (words) => (words[place(2) + 3] &= ~(255 << 19))],
  ['no such spread', /no such spread/, (words) => (words[place(2) + 3] |= 3 << 27)],
  ['a group that is not begun', /too many groups in one another/, (words) => (words[place(5) + 3] = 6 << 29 >>> 0)],
  ['a group that is not ended', /a group is not ended|too many groups/, (words) => {
    words.set([0, 0, 0, 5 << 29 >>> 0], place(6));
  }],
  ['no blend mode', /no such group/, (words) => (words[place(6) + 1] = 17)],
  ['a mask by nothing', /no such group/, (words) => (words[place(6) + 1] = 32)],
  ['a colour above its opacity', /a colour above its opacity/, (words) => (words[place(1)] = 0xffff, words[place(1) + 1] = 0x7fff0000)],
  ['a stop beyond 1', /a stop that is not in 0..1|not in order/, (words) => (words[4 * STOPS + 4] = 0x40000000)],
  ['stops out of order', /stops that are not in order/, (words) => (words[4 * STOPS] = 0x3f800000, words[4 * STOPS + 4] = 0)],
  ['a focal circle of negative radius', /a focal circle/, (words) => (words[place(4) + 9] = 0x80000000)],
];

describe('untrusted programs', () => {
  test.each(BROKEN_PROGRAMS)('%s', async (_, message, change) => {
    await expectRefusal(readPacked(altered(shades, change)), /./, message);
  });
});

describe('untrusted maps', () => {
  test.each(BROKEN)('%s', async (_, message, change) => {
    await expectRefusal(readPacked(altered(example, change)), /./, message);
  });

  test('a root without a head', async () => {
    const roots = texts[TEXT_ROOTS].replace('"quad":2', '"quad":1');
    const whole = [[0, 0, 0, 0], [0, 0, 0, 0]];
    await expectRefusal(readPacked(ktx2(whole, { ...texts, [TEXT_ROOTS]: roots })), 'quad 1', /has no head before it/);
  });

  test('quads with a gap, and curves', async () => {
    const rows = Array.from({ length: 16 }, () => [0, 0, 0, 0]);
    rows[1] = [1, 9, 14, 13];
    rows[2] = [4, 0, 0x80, 0];
    await expectRefusal(readPacked(ktx2(rows, texts)), 'quad 2', /the quads of the map with root 2 are not consecutive/);
    rows[2] = [3, 6, 0x0880, 0];
    rows[3] = [0, 4, 0x08, 1];
    await expectRefusal(readPacked(ktx2(rows, texts)), 'quad 2', /the curves of the map with root 2 are not consecutive/);
    rows[2][1] = 5;
    expect((await readPacked(ktx2(rows, texts))).width).toBe(16);
  });

  test('a map that is a silhouette, too', async () => {
    const [root] = JSON.parse(texts[TEXT_ROOTS]);
    const both = JSON.stringify([root, { ...root, map: false }]);
    await expectRefusal(readPacked(ktx2(texels, { ...texts, [TEXT_ROOTS]: both })), /./);
  });
});
