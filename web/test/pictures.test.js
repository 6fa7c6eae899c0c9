// Pictures in planar maps: the texels are written here by the text of FORMAT.md, D.6, alone.
import { describe, expect, test } from 'vitest';
import { TEXTS, ktx2 } from './files.js';
import { expectRefusal } from './refused.js';
import { TEXT_ROOTS, TEXT_VERSION } from '../generated/layout.js';
import { readPacked } from '../src/index.js';
import { VectorTexture } from '../src/vector-texture.js';

const RED = 0xff0000ff;
const GREEN = 0xff00ff00;
const BLUE = 0xffff0000;
const HALF = 0x80808080;
const CLEAR = 0;
const OPERATION = 6;
const PIXELS = 9;

const bits = (/** @type {number[]} */ ...values) => [...new Uint32Array(new Float32Array(values).buffer)];

/**
 * A map whose only face, the whole square, shows a picture of 3 x 2 pixels.
 *
 * @param {{ sampling?: number, opacity?: number, change?: (texels: number[][]) => void, version?: string }} [options]
 */
function file({ sampling = 0, opacity = 65535, change = () => {}, version = '3' } = {}) {
  const texels = [
    [OPERATION, 3, 0, 4],
    [2, 3, 5, 5],
    [0, 0, 0x04040404, 0], // four leaves of one paint, which is a program
    [0x01010101, 0, 0, 0],
    [0, 0, 0, 0],
    [0, 0, OPERATION, 3],
    [opacity, 3 | (2 << 16), PIXELS - OPERATION, sampling],
    [...bits(3, 0, 0), 0xe0000000],
    [...bits(0, -2, 2), 0xe0000000],
    [RED, GREEN, HALF, CLEAR],
    [BLUE, 0, RED, 0],
    [0, 0, 0, 0],
    [0, 0, 0, 0],
    ...Array.from({ length: 3 }, () => [0, 0, 0, 0]),
  ];
  change(texels);
  return mapFile(texels, version);
}

/**
 * @param {number[][]} texels
 * @param {string} [version]
 */
function mapFile(texels, version = '3') {
  const root = { name: 'picture', quad: 2, transform: [1, 0, 0, 0, 1, 0], tolerance: 0, map: true };
  return ktx2(texels, { ...TEXTS, [TEXT_VERSION]: version, [TEXT_ROOTS]: JSON.stringify([root]) });
}

const load = async (/** @type {Parameters<typeof file>[0]} */ options) => new VectorTexture(await readPacked(file(options)));

describe('pictures', () => {
  test('are known to be in a file', async () => {
    expect((await readPacked(file())).roots[0]).toMatchObject({ hasGradients: true, hasPictures: true });
  });

  test('have the colour of a pixel in all of it, the first one at the top left', async () => {
    const texture = await load({});
    const at = (/** @type {number} */ u, /** @type {number} */ v) => texture.colorAt(u, v);
    expect(at(0.01, 0.99)).toEqual({ color: [1, 0, 0], opacity: 1 });
    expect(at(0.5, 0.51)).toEqual({ color: [0, 1, 0], opacity: 1 });
    expect(at(0.7, 0.9)).toEqual({ color: [0, 0, 1], opacity: 1 });
    expect(at(0.1, 0.4).opacity).toBeCloseTo(128 / 255, 9);
    expect(at(0.5, 0.1).opacity).toBe(0);
  });

  test('are interpolated between the centres of pixels, and go on beyond the last ones', async () => {
    const texture = await load({ sampling: 1 });
    const { color: [red, green], opacity } = texture.colorAt(1 / 3, 0.99);
    expect([red, green, opacity].map((part) => Math.round(100 * part))).toEqual([50, 50, 100]);
    expect(texture.colorAt(0.01, 0.99)).toEqual({ color: [1, 0, 0], opacity: 1 });
    expect(texture.colorAt(0.5, 0.5).opacity).toBeCloseTo(0.5, 6);
  });

  test('have the opacity of their operation', async () => {
    const { color, opacity } = (await load({ opacity: 13107 })).colorAt(0.5, 0.9);
    expect(opacity).toBeCloseTo(0.2, 9);
    expect(color[1]).toBeCloseTo(1, 6);
  });
});

/** @type {[string, RegExp, (texels: number[][]) => void][]} */
const BROKEN = [
  ['no columns', /a picture of no such size/, (texels) => (texels[OPERATION][1] = 2 << 16)],
  ['too many rows', /a picture of no such size/, (texels) => (texels[OPERATION][1] = 3 | (16385 << 16))],
  ['more pixels than there are', /pixels elsewhere/, (texels) => (texels[OPERATION][1] = 5 | (2 << 16))],
  ['pixels before the part', /pixels elsewhere/, (texels) => (texels[OPERATION][2] = 2)],
  ['pixels far away', /pixels elsewhere/, (texels) => (texels[OPERATION][2] = 0xffffffff)],
  ['no such sampling', /no such picture/, (texels) => (texels[OPERATION][3] = 5)],
  ['an opacity above 1', /no such picture/, (texels) => (texels[OPERATION][0] = 65536)],
  ['a map that is not finite', /a number is not finite/, (texels) => (texels[OPERATION + 1][0] = 0x7f800000)],
  ['pictures that overlap', /pictures that overlap/, (texels) => {
    texels.splice(PIXELS, 0, [65535, 1 | (1 << 16), 4, 0], texels[OPERATION + 1], texels[OPERATION + 2]);
    texels[0][1] = 6;
    texels[5][3] = 6;
    texels[OPERATION][2] = 6;
    texels.length = 16;
  }],
  ['half of an operation', /of the wrong length/, (texels) => (texels[OPERATION + 2][3] = 0)],
  ['a pixel above its opacity', /a pixel above its opacity/, (texels) => (texels[PIXELS][3] = 0x000000ff)],
  ['more pixels than texels', /the programs of the map/, (texels) => (texels[0][3] = 100)],
];

describe('untrusted pictures', () => {
  test.each(BROKEN)('%s', async (_, message, change) => {
    await expectRefusal(readPacked(file({ change })), /./, message);
  });

  test('in a file of an earlier version', async () => {
    await expectRefusal(readPacked(file({ version: '2' })), TEXT_VERSION, /with pictures it is "3", without "2"/);
  });
});

const [COLUMNS, ROWS] = [6, 5];
const COLOR = [255, 153, 51];
/** Coefficients of a spline of opacities: a block with several, two of one value, one of which two pixels exist. */
const COEFFICIENTS = [
  [0, 10, 20, 30, 40, 40],
  [50, 60, 70, 80, 40, 40],
  [90, 100, 110, 120, 40, 40],
  [130, 140, 150, 255, 40, 40],
  [90, 90, 90, 90, 200, 100],
];

/**
 * A map whose only face, the whole square, shows these coefficients in one colour.
 *
 * @param {{ sampling?: number, opacity?: number, change?: (texels: number[][]) => void }} [options]
 */
function softFile({ sampling = 3, opacity = 65535, change = () => {} } = {}) {
  const rowOf = (/** @type {number[]} */ values) => values.reduce((word, value, k) => word + value * 256 ** k, 0);
  const texels = [
    [OPERATION, 3, 0, 4],
    [2, 3, 5, 5],
    [0, 0, 0x04040404, 0],
    [0x01010101, 0, 0, 0],
    [0, 0, 0, 0],
    [0, 0, OPERATION, 3],
    [opacity, COLUMNS | (ROWS << 16), PIXELS - OPERATION, sampling],
    [...bits(COLUMNS, 0, 0), 0xe0000000 + rowOf(COLOR)],
    [...bits(0, -ROWS, ROWS), 0xe0000000],
    [256 + (40 << 16), 90 + (257 << 16), 258 + (70 << 16), 72],
    COEFFICIENTS.slice(0, 4).map((row) => rowOf(row.slice(0, 4))),
    [rowOf([200, 100]), 0, 0, 0],
    [rowOf([30, 50, 40]), rowOf([115, 159, 40]), rowOf([90, 90, 150]), 0],
    ...Array.from({ length: 3 }, () => [0, 0, 0, 0]),
  ];
  change(texels);
  return mapFile(texels);
}

/** The basis of FORMAT.md. */
function basis(/** @type {number} */ s) {
  const a = Math.abs(s);
  if (a < 1) return 2 / 3 - a ** 2 + a ** 3 / 2;
  return a < 2 ? (2 - a) ** 3 / 6 : 0;
}

/**
 * Value of a spline at a point of the unit square, from all its coefficients and more beyond them.
 *
 * @param {number[][]} coefficients
 * @param {number} x
 * @param {number} y
 */
function splineAt(coefficients, x, y) {
  const [rows, columns] = [coefficients.length, coefficients[0].length];
  let value = 0;
  for (let j = -4; j < rows + 4; j++) {
    for (let i = -4; i < columns + 4; i++) {
      const one = coefficients[Math.min(Math.max(j, 0), rows - 1)][Math.min(Math.max(i, 0), columns - 1)];
      value += one * basis(columns * x - i - 0.5) * basis(rows * (1 - y) - j - 0.5);
    }
  }
  return value / 255;
}

const POINTS = [0.001, 0.1, 0.37, 0.5, 0.55, 0.8, 0.999].flatMap((x) => [0.001, 0.2, 0.43, 0.7, 0.999].map((y) => [x, y]));

describe('splines', () => {
  test('of opacities paint one colour', async () => {
    const texture = new VectorTexture(await readPacked(softFile({ opacity: 52428 })));
    for (const [x, y] of POINTS) {
      const { color, opacity } = texture.colorAt(x, y);
      expect(opacity).toBeCloseTo(0.8 * splineAt(COEFFICIENTS, x, y), 9);
      color.forEach((part, k) => expect(part).toBeCloseTo(COLOR[k] / 255, 6));
    }
  });

  test('may paint it where they are not', async () => {
    const texture = new VectorTexture(await readPacked(softFile({ sampling: 4 })));
    for (const [x, y] of POINTS) expect(texture.colorAt(x, y).opacity).toBeCloseTo(1 - splineAt(COEFFICIENTS, x, y), 9);
  });

  test('have four components', async () => {
    const texture = await load({ sampling: 2 });
    const pixels = [[RED, GREEN, BLUE], [HALF, CLEAR, RED]];
    for (const [x, y] of POINTS) {
      const of = (/** @type {number} */ k) => splineAt(pixels.map((row) => row.map((word) => (word >>> (8 * k)) & 255)), x, y);
      const { color, opacity } = texture.colorAt(x, y);
      expect(opacity).toBeCloseTo(of(3), 9);
      color.forEach((part, k) => expect(part * opacity).toBeCloseTo(of(k), 6));
    }
  });

  test('may share their pixels', async () => {
    const change = (/** @type {number[][]} */ texels) => {
      texels.splice(PIXELS, 0, [65535, COLUMNS | (ROWS << 16), 3, 4], texels[OPERATION + 1], texels[OPERATION + 2]);
      texels[0][1] = 6;
      texels[5][3] = 6;
      texels[OPERATION][2] = 6;
      texels.length = 16;
    };
    const texture = new VectorTexture(await readPacked(softFile({ change })));
    const value = splineAt(COEFFICIENTS, 0.4, 0.6);
    expect(texture.colorAt(0.4, 0.6).opacity).toBeCloseTo(1 - (1 - value) * value, 9);
  });
});

/** @type {[string, RegExp, (texels: number[][]) => void][]} */
const BROKEN_SPLINES = [
  ['a block beyond the pixels', /pixels elsewhere/, (texels) => (texels[PIXELS][0] = 259)],
  ['an index beyond the pixels', /pixels elsewhere/, (texels) => (texels[OPERATION][1] = 60 | (50 << 16))],
  ['an index with a rest', /an index of blocks/, (texels) => (texels[PIXELS][3] += 65536)],
  ['a colour with more bits', /a word that is not 0/, (texels) => (texels[OPERATION + 1][3] += 1 << 24)],
  ['a colour elsewhere', /a word that is not 0/, (texels) => (texels[OPERATION + 2][3] += 1)],
  ['a colour of a spline that has its own', /a word that is not 0/, (texels) => (texels[OPERATION][3] = 2)],
  ['opacities that are pixels, too', /pictures that overlap/, (texels) => {
    const follows = [texels[OPERATION + 1], texels[OPERATION + 2]].map((words) => [...words.slice(0, 3), 0xe0000000]);
    texels.splice(PIXELS, 0, [65535, 1 | (1 << 16), 3, 1], ...follows);
    texels[0][1] = 6;
    texels[5][3] = 6;
    texels[OPERATION][2] = 6;
    texels.length = 16;
  }],
];

describe('untrusted splines', () => {
  test.each(BROKEN_SPLINES)('%s', async (_, message, change) => {
    await expectRefusal(readPacked(softFile({ change })), /./, message);
  });
});
