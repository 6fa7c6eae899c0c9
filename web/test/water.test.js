import { Matrix3, PlaneGeometry, BufferGeometry, ShaderMaterial } from 'three';
import { Water } from 'three/addons/objects/Water.js';
import { describe, expect, test } from 'vitest';
import { VextureError } from '../src/errors.js';
import { insert } from '../src/hooks.js';
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';
import { SimpleWater, VectorWater, waterNormals } from '../src/water/index.js';
import { WATER_TEXTS } from '../src/water/shader.js';
import { fixture } from './files.js';

const read = async (/** @type {string} */ name) => new VectorTexture(await readPacked(fixture(`${name}.ktx2`), name));
const [duck, drawings, maps] = await Promise.all([read('duck'), read('drawings'), read('maps')]);
const plane = new PlaneGeometry();
const uniforms = (/** @type {VectorWater | SimpleWater} */ water) => water.material.uniforms;

describe("three.js' Water", () => {
  test('has every place that is needed, each once', () => {
    const { vertexShader, fragmentShader } = /** @type {ShaderMaterial} */ (new Water(plane, {}).material);
    const shader = { vertexShader, fragmentShader };
    insert(shader, 'Water', WATER_TEXTS);
    for (const text of Object.values(WATER_TEXTS)) {
      expect(shader.vertexShader.split(text).length + shader.fragmentShader.split(text).length).toBe(3);
    }
    expect(fragmentShader.indexOf('gl_FragColor =')).toBeLessThan(fragmentShader.indexOf('#include <tonemapping_fragment>'));
    expect(fragmentShader).toMatch(/uniform float time;[^]*uniform sampler2D normalSampler;[^]*#include <common>/);
  });

  test.each(['tonemapping_fragment', 'fog_fragment', 'common', 'logdepthbuf_vertex'])('without %s is refused', (name) => {
    const { vertexShader, fragmentShader } = /** @type {ShaderMaterial} */ (new Water(plane, {}).material);
    const shader = { vertexShader, fragmentShader };
    const stage = name.endsWith('vertex') ? 'vertexShader' : 'fragmentShader';
    shader[stage] = shader[stage].replace(`#include <${name}>`, '');
    expect(() => insert(shader, 'Water', WATER_TEXTS)).toThrow(`lacks '#include <${name}>'`);
    expect(() => insert(shader, 'Water', WATER_TEXTS)).toThrow(VextureError);
  });
});

describe.each([VectorWater, SimpleWater])('%o', (Kind) => {
  test('refuses a planar map in one line', () => {
    expect(() => new Kind(plane, maps, { root: 'flag' })).toThrow(/^maps: "flag" is a planar map, and water needs a shore/);
    expect(() => new Kind(plane, maps, { root: 2 })).not.toThrow();
  });

  test('reads one shape, or two while one turns into the other', () => {
    const water = new Kind(plane, duck, { root: 0 });
    const { vextureTexels, vextureShapes, vextureShares, vextureRows, vextureQuads } = uniforms(water);
    expect([vextureTexels.value, vextureShapes.value]).toEqual([duck.textures.texels, 1]);
    water.fadeTo(drawings);
    const both = vextureTexels.value;
    expect(vextureShapes.value).toBe(1);
    water.fade = 0.25;
    expect([vextureTexels.value, vextureShapes.value]).toEqual([both, 2]);
    expect(vextureShares.value.toArray()).toEqual([0.75, 0.25]);
    const below = vextureRows.value.y;
    expect(vextureQuads.value.y).toBe(drawings.roots[0].quad);
    const { data } = drawings;
    const at = 4 * below * both.image.width;
    expect([...both.image.data.subarray(at, at + 8)]).toEqual([...data.texels.subarray(0, 8)]);
    water.fade = 1;
    expect([vextureShapes.value, vextureRows.value.x]).toEqual([1, below]);
    water.texture = drawings;
    expect([vextureTexels.value, vextureShapes.value, water.fade]).toEqual([drawings.textures.texels, 1, 0]);
  });

  test('is nothing without a texture, and can appear', () => {
    const water = new Kind(plane, null);
    expect([water.texture, water.material.visible]).toEqual([null, false]);
    water.fadeTo(duck);
    water.fade = 0.5;
    expect([water.material.visible, uniforms(water).vextureShapes.value]).toEqual([true, 1]);
    expect(uniforms(water).vextureShares.value.x).toBe(0.5);
    water.texture = null;
    expect(water.material.visible).toBe(false);
  });

  test('follows its texture until it is disposed of', async () => {
    const live = await read('duck');
    const water = new Kind(plane, live, { root: 0 });
    live.replace(drawings.data);
    expect(uniforms(water).vextureTexels.value).toBe(live.textures.texels);
    water.dispose();
    live.replace(duck.data);
    expect(uniforms(water).vextureTexels.value).not.toBe(live.textures.texels);
  });

  test('is told its looks at any time', () => {
    const water = new Kind(plane, duck, { foam: { width: 0.02 }, transform: new Matrix3(), time: 4 });
    expect([water.time, water.foam.width, water.flat, water.shallow]).toEqual([4, 0.02, null, null]);
    water.flat = 0xff0000;
    water.shallow = 0x00ff00;
    water.time = 5;
    expect([water.flat?.getHex(), water.shallow?.getHex(), uniforms(water).time.value]).toEqual([0xff0000, 0x00ff00, 5]);
  });

  /** @type {[unknown, unknown, Record<string, unknown>, string][]} */
  const wrong = [
    [new BufferGeometry(), duck, {}, 'geometry'],
    [plane, {}, {}, 'texture'],
    [plane, duck, { transform: [1] }, 'transform'],
    [plane, duck, { foam: { width: -1 } }, 'foam.width'],
    [plane, duck, { root: 'nobody' }, 'root'],
    [plane, drawings, {}, 'root'],
    [plane, duck, { fold: {} }, 'fold'],
  ];
  test.each(wrong)('refuses what cannot be (%#)', (geometry, texture, options, field) => {
    const error = (() => {
      try {
        return new Kind(/** @type {any} */ (geometry), /** @type {any} */ (texture), /** @type {any} */ (options));
      } catch (refused) {
        return refused;
      }
    })();
    expect(error).toBeInstanceOf(VextureError);
    expect(error).toMatchObject({ field });
    expect(/** @type {Error} */ (error).message).not.toContain('\n');
  });
});

describe('waves', () => {
  test('repeat, are level on the whole, and are others for another seed', () => {
    const { data, width, height } = waterNormals(64, 3).image;
    if (!data) throw new Error('no image');
    expect([width, height]).toEqual([64, 64]);
    const at = (/** @type {number} */ x, /** @type {number} */ y) => data[4 * ((y % 64) * 64 + (x % 64))];
    let [inside, across, sum] = [0, 0, 0];
    for (let i = 0; i < 64; i++) {
      inside = Math.max(inside, ...Array.from({ length: 63 }, (_, x) => Math.abs(at(x + 1, i) - at(x, i))));
      across = Math.max(across, Math.abs(at(64, i) - at(63, i)), Math.abs(at(i, 64) - at(i, 63)));
      for (let x = 0; x < 64; x++) sum += at(x, i);
    }
    expect(across).toBeLessThanOrEqual(1.2 * inside);
    expect(Math.abs(sum / 64 ** 2 - 127)).toBeLessThan(3);
    expect([...(waterNormals(64, 4).image.data ?? [])]).not.toEqual([...data]);
    expect(() => waterNormals(3)).toThrow(/size/);
  });

  test('are calm from far away, more than their mean', () => {
    const levels = /** @type {{ data: Uint8Array, width: number }[]} */ (waterNormals(256).mipmaps);
    expect(levels.map(({ width }) => width)).toEqual([256, 128, 64, 32, 16, 8, 4, 2, 1]);
    const steepness = levels.map(({ data }) => {
      const slopes = data.filter((_, i) => i % 4 === 0).reduce((sum, x) => sum + (x - 127.5) ** 2, 0);
      return Math.sqrt(slopes / (data.length / 4));
    });
    for (let i = 1; i < 4; i++) expect(steepness[i] / steepness[i - 1]).toBeLessThan(0.7);
  });
});
