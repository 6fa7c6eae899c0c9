import { describe, expect, test } from 'vitest';
import { readPacked } from '../src/packed.js';
import { cellAt, counts } from '../src/walk.js';
import { median } from '../viewer/median.js';
import { RAMPS, css, depthRamp, paintCss } from '../viewer/overlay-palette.js';
import { coordinateAt, filledStrip, nearestCurve, solutionsAt } from '../viewer/solutions.js';
import { BASES, CURVE, HEAD, MEANS, OTHER, PAINTS, QUAD, SIDES, TexelMap, UNUSED, folded } from '../viewer/texel-map.js';
import { TINTS, brightness } from '../viewer/texel-image.js';
import { fixture } from './files.js';

const duck = await readPacked(fixture('duck.ktx2'));
const drawings = await readPacked(fixture('drawings.ktx2'));
const maps = await readPacked(fixture('maps.ktx2'));

/** Lightness as the eye has it, CIE L*. @param {number[]} color */
function lightness(color) {
  const linear = color.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
  const luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  return 116 * Math.cbrt(luminance) - 16;
}

describe('colours', () => {
  test.each([2, 5, 20])('%i depths are in the order of their lightness, in like steps', (deepest) => {
    const ramp = depthRamp(deepest);
    expect(ramp).toHaveLength(deepest + 1);
    const steps = ramp.slice(2).map((color, i) => lightness(color) - lightness(ramp[i + 1]));
    const mean = steps.reduce((sum, step) => sum + step, 0) / steps.length;
    for (const step of steps) expect(Math.abs(step / mean - 1)).toBeLessThan(0.35);
    expect(mean * steps.length).toBeGreaterThan(55);
    expect(ramp.flat().every((part) => part >= 0 && part <= 1)).toBe(true);
  });

  test('an empty cell is as light or dark as the paper, a full one the contrary', () => {
    for (const name of /** @type {const} */ (['coverage', 'stored'])) {
      const [light, dark] = [RAMPS.light[name].map(lightness), RAMPS.dark[name].map(lightness)];
      expect(light[0] - light[1]).toBeGreaterThan(40);
      expect(dark[1] - dark[0]).toBeGreaterThan(40);
    }
    expect(css([1, 0.5, 0])).toBe('rgb(255 128 0)');
    expect([[1, 0.5, 0, 1], [0.25, 0, 0, 0.5], [0, 0, 0, 0]].map(paintCss)).toEqual(['#ff8000', '#80000080', 'transparent']);
  });
});

describe('solutions', () => {
  const bow = [0, 0.25, 0.25, 0.5, 0.75, 0.5, 1, 1];

  test('are where the curve has the x of the point', () => {
    for (const u of [0, 0.01, 0.3, 0.5, 0.77, 1]) {
      const [{ t, height, filledAbove }] = solutionsAt({ curves: [bow] }, u);
      expect(coordinateAt(bow, 0, t)).toBeCloseTo(u, 12);
      expect(height).toBe(coordinateAt(bow, 1, t));
      expect(filledAbove).toBe(true); // on its left, going to the right
    }
  });

  test('there are none beside a curve, and none on an upright one', () => {
    expect(solutionsAt({ curves: [[0.5, 0, 0.5, 0.3, 0.5, 0.6, 0.5, 1], bow] }, 1.5)).toEqual([]);
    expect(solutionsAt({ curves: [[0.5, 0, 0.5, 0.3, 0.5, 0.6, 0.5, 1]] }, 0.5)).toEqual([]);
  });

  test('the lowest comes first, with the number of its curve', () => {
    const back = [1, 0.1, 0.7, 0.1, 0.3, 0.1, 0, 0.1];
    expect(solutionsAt({ curves: [bow, back] }, 0.5).map(({ curve, filledAbove }) => [curve, filledAbove])).toEqual(
      [[1, false], [0, true]],
    );
  });

  test('the nearest curve', () => {
    const back = [1, 0.1, 0.7, 0.1, 0.3, 0.1, 0, 0.1];
    expect(nearestCurve([bow, back], [0.5, 0])).toBe(1);
    expect(nearestCurve([bow, back], [0.5, 0.6])).toBe(0);
    expect(nearestCurve([], [0.5, 0.6])).toBe(-1);
  });

  test('the strip lies on the left hand, which is above on a screen for a way to the right', () => {
    const strip = filledStrip([[0, 50], [30, 50], [60, 50], [90, 50]], 7, 2);
    expect(strip.map(([, y]) => y)).toEqual([50, 50, 50, 43, 43, 43]);
  });
});

describe('texels', () => {
  test('each quad and curve of a shape is met where it stands', () => {
    const { quad } = duck.roots[0];
    const map = new TexelMap(duck, quad);
    const { quads, curves } = counts(duck, quad);
    expect([...map.kinds].filter((kind) => kind === QUAD)).toHaveLength(quads);
    expect([...map.kinds].filter((kind) => kind === CURVE)).toHaveLength(curves);
    map.kinds.forEach((kind, index) => {
      if (kind !== CURVE) return;
      const place = /** @type {NonNullable<import('../viewer/texel-map.js').Place>} */ (map.places.get(index));
      const cell = cellAt(duck, quad, place.x + place.size / 2, place.y + place.size / 2);
      expect(cell).toMatchObject(place);
      const starts = cell?.curves.map(([x, y]) => [(x - place.x) / place.size, (y - place.y) / place.size]) ?? [];
      const said = /^P0 \((.*), (.*)\) of the cell$/.exec(map.texel(index).words[0]) ?? [];
      const [x, y] = [Number(said[1]), Number(said[2])];
      expect(starts.some(([u, v]) => Math.abs(u - x) < 1e-4 && Math.abs(v - y) < 1e-4)).toBe(true);
    });
  });

  test('of a texture with several shapes the others are told apart', () => {
    const map = new TexelMap(drawings, drawings.roots[1].quad);
    expect(map.kinds[drawings.roots[0].quad]).toBe(OTHER);
    expect(map.kinds[drawings.roots[1].quad]).toBe(QUAD);
    const unused = map.kinds.indexOf(UNUSED);
    if (unused >= 0) expect(map.texel(unused).words).toEqual(['00000000', '00000000', '00000000', '00000000']);
    expect(map.texel(drawings.roots[0].quad)).toMatchObject({ kind: 'other', place: null });
  });

  test('of many texels a row from the root on is looked at', () => {
    const { quad } = drawings.roots[1];
    const [all, part] = [new TexelMap(drawings, quad), new TexelMap(drawings, quad, 4)];
    expect([part.first, part.count]).toEqual([quad, 4]);
    expect([...part.places]).toEqual([...all.places].filter(([index]) => index >= quad && index < quad + 4));
    expect(part.kinds.slice(quad, quad + 4)).toEqual(all.kinds.slice(quad, quad + 4));
  });

  test('a quad says what its cells are', () => {
    const root = new TexelMap(duck, duck.roots[0].quad).texel(duck.roots[0].quad);
    expect(root).toMatchObject({ kind: 'quad', place: { depth: 0, size: 1 } });
    expect(root.words[0]).toBe(`first quad below: ${duck.texels[4 * duck.roots[0].quad]}`);
    expect(root.words[2].split('; ')).toHaveLength(4);
    expect(root.words[3]).toMatch(/^coverage (\d\.\d{3}(, )?){4}$/);
  });

  test('every texel of a planar map has its part', () => {
    const { quad } = maps.roots[1];
    const map = new TexelMap(maps, quad);
    const { quads, curves } = counts(maps, quad);
    const pairs = [...map.pairs].flatMap((index) => map.texel(index).words);
    const paired = pairs.filter((word) => /^curve [12]: P0 \(\d\.\d{4}, \d\.\d{4}\) of the cell$/.test(word)).length;
    expect(paired).toBeGreaterThan(0);
    const found = (/** @type {number} */ kind) => [...map.kinds].filter((one) => one === kind).length;
    expect([HEAD, QUAD, CURVE, MEANS, BASES].map(found)).toEqual([2, quads, curves - paired + map.pairs.size, quads, Math.ceil(quads / 4)]);
    expect(found(PAINTS)).toBe(Math.ceil(maps.texels[4 * quad - 4] / 2));
    expect(map.texel(quad - 1)).toMatchObject({ kind: 'head', words: expect.arrayContaining([expect.stringMatching(/^\d+ paints$/)]) });
    expect(map.texel(quad).words.slice(2)).toEqual([expect.stringMatching(/straight curve/), 'number of the first curve: 0']);
    const words = (/** @type {number} */ kind) =>
      [...map.kinds.keys()].filter((index) => map.kinds[index] === kind).flatMap((index) => map.texel(index).words);
    expect(words(SIDES).flatMap((word) => word.split('; ')).filter((word) => /^curve \d+: paint \d+ \| \d+$/.test(word))).toHaveLength(curves);
    expect(words(PAINTS).join()).toMatch(/paint 0, transparent: red and green.*#dc2626/);
    expect(words(MEANS).every((word) => / mean (#|transparent)/.test(word))).toBe(true);
    const bases = words(BASES).filter((word) => /^quad \d+: base paints \d+, \d+, \d+, \d+$/.test(word));
    expect(bases).toHaveLength(quads);
    expect(map.texel(maps.roots[0].quad).kind).toBe('other');
  });

  test('lighter words are larger ones, and kinds have colours of their own', () => {
    expect(brightness(QUAD, 0, 0, 100)).toBe(0);
    expect(brightness(QUAD, 0, 50, 100)).toBe(0.5);
    expect(brightness(QUAD, 3, 0xffffffff, 100)).toBe(1);
    expect(brightness(CURVE, 0, 0xffffffff, 100)).toBe(1);
    expect(brightness(CURVE, 0, 0, 100)).toBe(0);
    expect(new Set([QUAD, CURVE, OTHER].map((kind) => String(TINTS[kind]))).size).toBe(3);
  });

  test('rows that are too wide go on below', () => {
    expect(folded(64, 16)).toEqual({ columns: 16, rows: 4 });
    expect(folded(5, 16)).toEqual({ columns: 5, rows: 1 });
    expect(folded(2048 * 3, 256)).toEqual({ columns: 256, rows: 24 });
  });
});

test('median', () => {
  expect(median([3, 1, 2])).toBe(2);
  expect(median([4, 1, 2, 3])).toBe(2.5);
});
