import { expect, test } from 'vitest';
import { describeWithKernels } from './built-kernels.js';
import { Converter, convertData, fromContours } from '../src/convert/index.js';
import { layersOf } from '../src/layers.js';
import { paintColor } from '../src/walk-map.js';
import { VectorTexture } from '../src/vector-texture.js';

const thin = (width, height) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}">
  <rect width="${width}" height="${height}" fill="#f00"/><rect width="${width / 2}" height="${height}" fill="#00f"/></svg>`;

/** Triangles of as many colours. */
const triangles = (count) => fromContours(Array.from({ length: count }, (_, k) => {
  const [x, y] = [k % 200, Math.floor(k / 200)];
  const ends = [[x, y], [x + 1, y], [x, y + 1], [x, y]];
  const contour = [0, 1, 2].flatMap((side) => [ends[side], ends[side], ends[side + 1], ends[side + 1]].flat());
  return { contours: [contour], color: [(k % 256) / 255, (k >> 8) / 255, 0] };
}));

describeWithKernels('drawings at the limits', () => {
  test.each([[200_000, 1], [1, 200_000], [40_000, 1]])('%s x %s is refused, not empty', async (width, height) => {
    await expect(convertData(thin(width, height), { name: 'thin' })).rejects.toThrow(
      /^thin: its shorter side is \S+ of the longer one; rounding shifts by up to 3.1e-5 of it; give a `precision` of \S+, or a wider view box$/,
    );
  });

  test('is right with the precision that the refusal names', async () => {
    const message = await convertData(thin(200_000, 1)).catch((error) => error.message);
    const texture = new VectorTexture(await convertData(thin(200_000, 1), { precision: Number(/of (\S+), or/.exec(message)[1]) }));
    const at = (u) => texture.colorAt(u, 0.5).color;
    expect([at(0.25), at(0.75)]).toEqual([[0, 0, 1], [1, 0, 0]]);
  });

  test('layers are as many as a material shows', async () => {
    const most = await convertData(triangles(16_384), { split: 'paint', maxDepth: 4 });
    expect(layersOf(most, undefined).count).toBe(16_384);
    await expect(convertData(triangles(16_385), { split: 'paint', name: 'many' })).rejects.toThrow(
      "many: 16,385 layers; a material shows 16,384 at most; give `split: 'faces'`, or divide the drawing",
    );
  });
});

test('a module of kernels that there is not is refused', () => {
  expect(() => new Converter({ kernels: { map: 'maps.wasm' } })).toThrow('`kernels` have no "map"; there are silhouettes, maps, strokes');
  expect(() => new Converter({ kernels: 'maps.wasm' })).toThrow('the kernels are "maps.wasm"; give an object');
  expect(() => new Converter({ kernels: { maps: 'maps.wasm' } })).not.toThrow();
});
