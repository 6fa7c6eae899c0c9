// The thesis's encoding in three.js: its textures and its loader.
import { FloatType, MeshBasicMaterial, NearestFilter } from 'three';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { FOLD_HEIGHT } from '../generated/thesis-shader.js';
import { ThesisLoader, ThesisTexture, readThesis } from '../src/thesis/index.js';
import { listTexture } from '../src/thesis/texture.js';
import { applyVectorMask } from '../src/vector-mask.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture } from './files.js';
import { expectRefusal } from './refused.js';
import { serve } from './server.js';

const [quads, curves] = ['quads', 'curves'].map((one) => fixture(`sixteen/duck.${one}.png`));
const pair = (/** @type {string} */ stem) => readThesis(fixture(`${stem}.quads.png`), fixture(`${stem}.curves.png`), 'pair');

describe('a texture', () => {
  test('the lists of a thesis texture as numbers in 0..1', async () => {
    const data = await pair('sixteen/duck');
    const { quads, curves, texels } = new ThesisTexture(data).textures;
    expect(texels).toBeUndefined();
    expect(quads).toMatchObject({ type: FloatType, internalFormat: 'RGBA32F', minFilter: NearestFilter });
    expect(quads?.image).toMatchObject({ width: 4, height: data.quadCount });
    expect(curves?.image).toMatchObject({ width: 2, height: data.curveCount });
    const at = 4 * (2 * 7 + 1); // row 7, second pixel
    const numbers = /** @type {Float32Array} */ (curves?.image.data).subarray(at, at + 4);
    const channels = data.curves.subarray(3 * (2 * 7 + 1), 3 * (2 * 7 + 1) + 3);
    expect([...numbers]).toEqual([...channels].map((channel) => Math.fround(channel / 65535)).concat(0));
  });

  test('a list longer than a texture is high goes on in the columns to its right', () => {
    const pixels = Uint8Array.from({ length: 5 * 2 * 3 }, (_, place) => place); // 5 rows of 2 pixels
    const { image } = listTexture(pixels, 2, 2);
    expect([image.width, image.height]).toEqual([6, 2]);
    const numbers = /** @type {Float32Array} */ (image.data);
    for (let list = 0; list < 5; list++) {
      for (let column = 0; column < 2; column++) {
        const texel = 6 * (list % 2) + 2 * Math.floor(list / 2) + column;
        const expected = [0, 1, 2].map((channel) => Math.fround((6 * list + 3 * column + channel) / 255));
        expect([...numbers.subarray(4 * texel, 4 * texel + 3)]).toEqual(expected);
      }
    }
    expect(FOLD_HEIGHT).toBe(16384);
  });

  test('has one shape and no layers', async () => {
    const texture = new ThesisTexture(await pair('eight/simple-small'));
    expect(texture).toBeInstanceOf(VectorTexture);
    expect(texture).toMatchObject({ encoding: 'thesis', name: 'pair', isVectorTexture: true });
    expect(texture.nbytes).toBe(16 * (4 * texture.data.quadCount + 2 * texture.data.curveCount));
    expect([texture.index(), texture.index('pair'), texture.contains(2, 2, 'pair')]).toEqual([0, 0, false]);
    expect(() => texture.contains(0.5, 0.5, 'duck')).toThrow('pair: no root "duck"');
    expect(() => texture.layersOf()).toThrow('has no layers');
  });

  test('dispose', async () => {
    const texture = new ThesisTexture(await pair('eight/simple-small'));
    let disposed = 0;
    for (const one of Object.values(texture.textures)) one.addEventListener('dispose', () => disposed++);
    texture.dispose();
    expect(disposed).toBe(2);
  });

  test('as the mask of a material, in every mode', async () => {
    const texture = new ThesisTexture(await pair('sixteen/duck'));
    for (const mode of /** @type {const} */ (['alpha', 'mix', 'cut', 'paint'])) {
      expect(applyVectorMask(new MeshBasicMaterial(), texture, { mode }).texture).toBe(texture);
    }
    expect(() => applyVectorMask(new MeshBasicMaterial(), texture, { wrap: 'repeat' })).toThrow(
      'pair: a thesis texture has one root, no wrap and no fold; convert the drawing to KTX2',
    );
  });
});

describe('the loader', () => {
  /** @type {import('./server.js').Server} */
  let server;
  beforeAll(async () => {
    server = await serve({
      '/pair/my%20duck.quads.png': quads,
      '/pair/my%20duck.curves.png': curves,
      '/half.quads.png': quads,
      '/damaged.quads.png': quads.subarray(0, 99),
      '/damaged.curves.png': curves,
    });
  });
  afterAll(() => server.close());

  test('a pair by its stem, either file, or both', async () => {
    const path = `${server.url}/pair/my%20duck`;
    /** @type {import('../src/thesis/loader.js').PairUrl[]} */
    const urls = [path, `${path}.quads.png`, `${path}.curves.png`, [`${path}.quads.png`, `${path}.curves.png`]];
    for (const url of urls) {
      let last;
      const texture = await new ThesisLoader().loadAsync(url, (event) => (last = event));
      expect(texture).toMatchObject({ name: 'my duck', encoding: 'thesis' });
      expect(last).toMatchObject({ loaded: quads.length + curves.length, total: quads.length + curves.length });
    }
  });

  test('addresses that hold their content', async () => {
    const both = /** @type {[string, string]} */ ([quads, curves].map((file) => URL.createObjectURL(new Blob([file]))));
    const loader = new ThesisLoader().setPath('/not/in/front/of/these/');
    expect(await loader.loadAsync(both)).toMatchObject({ encoding: 'thesis', name: 'texture' });
  });

  test('contents by parse', async () => {
    expect(await new ThesisLoader().parse([quads, curves], 'pair')).toMatchObject({ name: 'pair', encoding: 'thesis' });
  });

  test('pairs that are not there, or damaged', async () => {
    const load = (/** @type {string} */ path) => new ThesisLoader().loadAsync(server.url + path);
    await expectRefusal(load('/half'), 'status 404', `${server.url}/half.curves.png: HTTP 404`);
    await expectRefusal(load('/half.quads.png'), 'status 404', 'half.curves.png');
    await expectRefusal(load('/damaged'), 'IEND', 'damaged: quads: damaged PNG');
    for (const nothing of [undefined, null, 7, [undefined, 'b']]) {
      await expectRefusal(new ThesisLoader().loadAsync(/** @type {any} */ (nothing)), 'url', /the address is/);
    }
  });
});
