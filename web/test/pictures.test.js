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
  ['no such sampling', /no such picture/, (texels) => (texels[OPERATION][3] = 2)],
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
