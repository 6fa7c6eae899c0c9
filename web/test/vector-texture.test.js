import { DataTexture, NearestFilter, NoColorSpace, RGBAIntegerFormat, UnsignedIntType } from 'three';
import { describe, expect, test } from 'vitest';
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture } from './files.js';

const read = (/** @type {string} */ name) => readPacked(fixture(`${name}.ktx2`), name);

/** Words of a row of the layers. */
const row = (/** @type {VectorTexture} */ texture, /** @type {number} */ place) =>
  [...(texture.textures.layers?.image.data?.subarray(8 * place, 8 * place + 8) ?? [])];

describe('what the GPU gets', () => {
  test('texels as they are, unfiltered', async () => {
    const data = await read('duck');
    const { texels, layers } = new VectorTexture(data).textures;
    for (const texture of [texels, layers]) {
      expect(texture).toBeInstanceOf(DataTexture);
      expect(texture).toMatchObject({
        format: RGBAIntegerFormat,
        type: UnsignedIntType,
        internalFormat: 'RGBA32UI',
        minFilter: NearestFilter,
        magFilter: NearestFilter,
        generateMipmaps: false,
        colorSpace: NoColorSpace,
        flipY: false,
      });
      expect(texture?.version).toBeGreaterThan(0); // is uploaded
    }
    expect(texels?.image).toMatchObject({ data: data.texels, width: 64, height: 1 });
  });

  test('layers: quad, paint and bounds of each root', async () => {
    const texture = new VectorTexture(await read('drawings'));
    expect(texture.textures.layers?.image).toMatchObject({ width: 2, height: 6 });
    const [quad, redGreen, blueAlpha, zero, ...box] = row(texture, 2);
    expect([quad, zero]).toEqual([texture.roots[2].quad, 0]);
    expect([redGreen & 0xffff, redGreen >>> 16]).toEqual([0xb9 * 257, 0x1c * 257]);
    expect([blueAlpha & 0xffff, blueAlpha >>> 16]).toEqual([0x1c * 257, 32768]);
    const [x0, y0, x1, y1] = box.map((at) => at / 65536);
    // a circle of radius 5 in a drawing of 64, around (32, 34), y down; the unit square may have a margin
    expect(x1 - x0).toBeGreaterThanOrEqual(10 / 64);
    expect(y1 - y0).toBeGreaterThanOrEqual(10 / 64);
    expect([x0 < 0.5, x1 > 0.5, y0 < 0.5, y1 > 0.5]).toEqual([true, true, true, true]);
    expect(x1 - x0).toBeLessThan(0.5);
  });

  test('a silhouette is black', async () => {
    const texture = new VectorTexture(await read('duck'));
    expect(row(texture, 0).slice(1, 4)).toEqual([0, 0xffff0000, 0]);
  });
});

describe('shapes by name', () => {
  test('index', async () => {
    const texture = new VectorTexture(await read('drawings'));
    expect(texture.index('flag/2-#ffffff')).toBe(4);
    expect(texture.index(5)).toBe(5);
    expect(() => texture.index('flag/2-#fffff')).toThrow(
      /^drawings: no root "flag\/2-#fffff"; near names are "flag\/2-#ffffff", .*; there are 6$/,
    );
    for (const wrong of [6, -1, 0.5]) expect(() => texture.index(wrong)).toThrow('numbered 0 to 5');
  });

  test('layers of drawings', async () => {
    const texture = new VectorTexture(await read('drawings'));
    expect(texture.layersOf('badge')).toEqual({ first: 0, count: 3 });
    expect(texture.layersOf('flag')).toEqual({ first: 3, count: 3 });
    expect(texture.layersOf('flag/2-#ffffff')).toEqual({ first: 4, count: 1 });
    expect(texture.layersOf(1)).toEqual({ first: 1, count: 1 });
    expect(() => texture.layersOf('fla')).toThrow('no root "fla"');
  });

  test('without a choice: the only shape, the only drawing', async () => {
    const [duck, badge] = [new VectorTexture(await read('duck')), new VectorTexture(await read('badge'))];
    expect([duck.index(), duck.contains(0.5, 0.5), duck.contains(0.5, 0.5, null)]).toEqual([0, true, true]);
    expect(duck.layersOf()).toEqual({ first: 0, count: 1 });
    expect(badge.layersOf()).toEqual({ first: 0, count: 3 });
    const names = badge.roots.map(({ name }) => name).join(', ');
    const message = `badge holds 3 shapes (${names}); choose one by root`;
    for (const choose of [() => badge.index(), () => badge.contains(0.5, 0.5), () => badge.contains(0.5, 0.5, null)]) {
      expect(choose).toThrow(message);
    }
  });

  test('without a choice several drawings are ambiguous', async () => {
    const texture = new VectorTexture(await read('drawings'));
    expect(() => texture.layersOf()).toThrow('drawings holds 2 drawings (badge, flag); choose one by root');
    expect(() => texture.index()).toThrow(/^drawings holds 6 shapes \((\S+, ){5}\S+\); choose one by root$/);
    const data = await read('duck');
    const roots = Array.from({ length: 9 }, (_, place) => ({ ...data.roots[0], name: place ? `${place}` : 'a\nb' }));
    expect(() => new VectorTexture({ ...data, roots }).layersOf()).toThrow(
      'duck holds 9 drawings (a b, 1, 2, 3, 4, 5 and 3 more); choose one by root',
    );
  });

  test('only as many layers as a texture has rows', async () => {
    const duck = await read('duck');
    const roots = Array.from({ length: 16385 }, (_, place) => ({ ...duck.roots[0], name: `${place}` }));
    const texture = new VectorTexture({ ...duck, roots });
    expect(texture.textures.layers?.image.height).toBe(16384);
    expect(texture.layersOf(16383)).toEqual({ first: 16383, count: 1 });
    expect(() => texture.layersOf(16384)).toThrow('only the first 16384');
    expect(texture.index('16384')).toBe(16384);
  });
});

describe('a texture in use', () => {
  test('sizes and names', async () => {
    const texture = new VectorTexture(await read('drawings'));
    expect(texture).toMatchObject({ encoding: 'packed', name: 'drawings', nbytes: 64 * 16, isVectorTexture: true });
  });

  test('another shape takes its place in one go', async () => {
    const texture = new VectorTexture(await read('duck'));
    const before = texture.textures;
    /** @type {string[]} */
    const events = [];
    before.texels?.addEventListener('dispose', () => events.push('disposed texels'));
    before.layers?.addEventListener('dispose', () => events.push('disposed layers'));
    texture.addEventListener('change', () => {
      events.push(`change to ${texture.name}, ${texture.textures.texels?.image.data === texture.data.texels}`);
    });
    texture.replace(await read('badge'));
    expect(events).toEqual(['change to badge, true', 'disposed texels', 'disposed layers']);
    expect(texture.textures.texels).not.toBe(before.texels);
    expect(texture.roots).toHaveLength(3);
  });

  test('a listener that fails does not keep the old textures', async () => {
    const texture = new VectorTexture(await read('duck'));
    let disposed = false;
    texture.textures.texels?.addEventListener('dispose', () => (disposed = true));
    texture.addEventListener('change', () => {
      throw new Error('a listener');
    });
    const badge = await read('badge');
    expect(() => texture.replace(badge)).toThrow('a listener');
    expect([disposed, texture.name]).toEqual([true, 'badge']);
  });

  test('dispose', async () => {
    const texture = new VectorTexture(await read('duck'));
    let disposed = 0;
    for (const one of Object.values(texture.textures)) one.addEventListener('dispose', () => disposed++);
    texture.dispose();
    expect(disposed).toBe(2);
  });
});
