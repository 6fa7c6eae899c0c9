import { LoadingManager, Mesh, Raycaster, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { VectorTexturePlugin } from '../src/gltf/index.js';
import { vectorMaskOf } from '../src/vector-mask.js';
import { fixture } from './files.js';
import { modelOf } from './models.js';
import { expectRefusal } from './refused.js';
import { serve } from './server.js';

const duck = fixture('duck.ktx2');
const drawings = fixture('drawings.ktx2');
const inside = { bufferView: 3, mimeType: 'image/ktx2' };

/** @type {import('./server.js').Server} */
let server;
beforeAll(async () => {
  server = await serve({ '/models/duck%201.ktx2': duck, '/models/broken.ktx2': duck.slice(0, 99) });
});
afterAll(() => server.close());

/** @param {ArrayBuffer} model */
function load(model, path = `${server.url}/models/`, manager = new LoadingManager()) {
  const loader = new GLTFLoader(manager).register((parser) => new VectorTexturePlugin(parser));
  return loader.parseAsync(model, path);
}

/**
 * Materials of the meshes by name.
 *
 * @param {import('three').Object3D} scene
 */
function materialsOf(scene) {
  /** @type {Record<string, import('three').Material>} */
  const found = {};
  scene.traverse((object) => {
    if (object instanceof Mesh) found[object.material.name] = object.material;
  });
  return found;
}

describe('a model', () => {
  test('shows what its materials say', async () => {
    const transform = { offset: [0.5, 0], rotation: 0.25, scale: [2, 3] };
    const wall = { texture: 0, root: 'badge/2-#facc15', mode: 'mix', wrap: 'repeat', invert: true, color: [0.25, 0.5, 1], texCoord: 1, transform };
    const { scene, userData } = await load(modelOf({ texture: 0, root: 0, mode: 'paint', background: 'none', extras: 1 }, wall, [inside], drawings));
    const { Sign, Wall, Plain } = materialsOf(scene);
    const [sign, other] = [vectorMaskOf(Sign), vectorMaskOf(Wall)];
    expect(sign?.options).toMatchObject({ root: 0, mode: 'paint', background: 'none', wrap: 'none', channel: 0, threshold: 0.5 });
    expect(other?.options).toMatchObject({ root: 'badge/2-#facc15', mode: 'mix', wrap: 'repeat', invert: true, channel: 1 });
    expect(/** @type {import('three').Color} */ (other?.color).toArray()).toEqual([0.25, 0.5, 1]);
    expect(sign?.transform?.elements).toEqual([1, 0, 0, 0, -1, 0, 0, 1, 1]);
    expect(sign?.texture).toBe(other?.texture);
    expect([userData.vectorTextures, vectorMaskOf(Plain)]).toEqual([[sign?.texture], undefined]);
    expect([scene.userData.gltfExtensions, Sign.userData.gltfExtensions]).toEqual([undefined, undefined]);
  });

  test('is attached, and so are its clones', async () => {
    const { scene } = await load(modelOf({ texture: 0, mode: 'cut' }, null, [inside], duck));
    for (const model of [scene, scene.clone()]) {
      model.updateMatrixWorld(true);
      /** @type {Mesh[]} */
      const signs = [];
      model.traverse((object) => {
        if (object instanceof Mesh && object.material.name === 'Sign') signs.push(object);
      });
      expect(signs.map(({ customDepthMaterial }) => customDepthMaterial?.type)).toEqual(Array(2).fill('MeshDepthMaterial'));
      const hits = (/** @type {number} */ x, /** @type {number} */ y) => new Raycaster(new Vector3(x, y, 5), new Vector3(0, 0, -1)).intersectObjects(signs).length;
      const texture = vectorMaskOf(/** @type {import('three').Material} */ (signs[0].material))?.texture;
      for (const [u, v] of [[0.5, 0.5], [0.1, 0.9], [0.3, 0.72], [0.7, 0.3], [0.28, 0.3]]) { // y goes up
        expect(hits(2 * u - 1, 2 * v - 1) > 0).toBe(texture?.contains(u, v));
      }
    }
  });

  test('loads a texture once, from beside it, by its manager', async () => {
    const manager = new LoadingManager();
    /** @type {string[]} */
    const seen = [];
    manager.onProgress = (url) => seen.push(url);
    const model = modelOf({ texture: 1, mode: 'alpha' }, { texture: 1, mode: 'mix' }, [inside, { uri: 'duck%201.ktx2' }]);
    const { scene, userData } = await load(model, `${server.url}/models/`, manager);
    expect(seen).toEqual([`${server.url}/models/duck%201.ktx2`]);
    expect(userData.vectorTextures.map((/** @type {any} */ { name }) => name)).toEqual(['duck']);
    expect(vectorMaskOf(materialsOf(scene).Sign)?.texture).toBe(userData.vectorTextures[0]);
  });

  test.each(['image/ktx2', 'application/octet-stream'])('has its texture in an address of %s', async (type) => {
    const uri = `data:${type};base64,${Buffer.from(duck).toString('base64')}`;
    const { userData } = await load(modelOf({ texture: 0, mode: 'cut' }, null, [{ uri, name: 'one' }]));
    expect(userData.vectorTextures.length).toBe(1);
  });

  test('without the extension has nothing of it', async () => {
    const model = modelOf({}, null, undefined);
    const text = Buffer.from(model).toString('latin1').replaceAll('VEXTURE_vector_texture', 'ANOTHER_vector_texture');
    const { userData } = await load(new Uint8Array(Buffer.from(text, 'latin1')).buffer);
    expect(userData.vectorTextures).toEqual([]);
  });
});

const right = { texture: 0, mode: 'paint' };

describe('an invalid extension is an error in one line, and there is no model', () => {
  test.each(/** @type {[unknown, string, string][]} */ ([
    [7, '', 'it must be an object'],
    [[], '', 'it must be an object'],
    [{ mode: 'cut' }, '.texture', '0 to 0'],
    [{ ...right, texture: 1 }, '.texture', 'it must be a whole number, 0 to 0'],
    [{ ...right, texture: 0.5 }, '.texture', '0.5'],
    [{ ...right, texture: '0' }, '.texture', '"0"'],
    [{ texture: 0 }, '.mode', 'one of alpha, mix, cut, paint'],
    [{ ...right, mode: 'glow' }, '.mode', '"glow"; it must be one of alpha, mix, cut, paint'],
    [{ ...right, mode: 'constructor' }, '.mode', 'one of'],
    [{ ...right, wrap: 'mirror' }, '.wrap', 'one of none, clamp, repeat'],
    [{ ...right, root: -1 }, '.root', 'name or the place'],
    [{ ...right, root: ['a'] }, '.root', 'name or the place'],
    [{ ...right, invert: 1 }, '.invert', 'one of false, true'],
    [{ ...right, background: null }, '.background', 'one of own, none'],
    [{ ...right, threshold: 1.5 }, '.threshold', '0 to 1'],
    [{ ...right, color: [1, 1] }, '.color', '3 numbers, each 0 to 1'],
    [{ ...right, color: [1, 1, 2] }, '.color', '3 numbers, each 0 to 1'],
    [{ ...right, color: 'red' }, '.color', '3 numbers, each 0 to 1'],
    [{ ...right, texCoord: 2 }, '.texCoord', 'one of 0, 1'],
    [{ ...right, transform: [1] }, '.transform', 'it must be an object'],
    [{ ...right, transform: { scale: [1, null] } }, '.transform.scale', '2 finite numbers'],
    [{ ...right, transform: { rotation: '1' } }, '.transform.rotation', '1 finite numbers'],
    [{ ...right, transform: { offset: 1 } }, '.transform.offset', '2 finite numbers'],
  ]))('%j', async (sign, member, message) => {
    const reading = load(modelOf(/** @type {any} */ (sign), null, [inside], duck));
    await expectRefusal(reading, `material "Sign": VEXTURE_vector_texture${member}`, message);
  });

  test('what the texture does not have', async () => {
    await expectRefusal(load(modelOf({ ...right, root: 'cat' }, null, [inside], duck)), 'root', /^material "Sign": .*no root "cat"/);
    await expectRefusal(load(modelOf({ texture: 0, mode: 'cut' }, null, [inside], drawings)), 'root', 'choose one by root');
    await expectRefusal(load(modelOf({ ...right, invert: true }, null, [inside], duck)), 'invert', 'cannot be inverted');
  });

  test.each(/** @type {[unknown, string, string][]} */ ([
    [undefined, '', 'it must be a list'],
    [{}, '', 'it must be a list'],
    [[null], '[0]', 'it must be an object'],
    [[{}], '[0]', 'either uri or bufferView'],
    [[{ ...inside, uri: 'a.ktx2' }], '[0]', 'either uri or bufferView'],
    [[{ bufferView: 3 }], '[0].mimeType', 'it must be image/ktx2'],
    [[{ ...inside, bufferView: 9 }], '[0].bufferView', '0 to 3'],
    [[{ ...inside, bufferView: -1 }], '[0].bufferView', '0 to 3'],
    [[{ ...inside, name: 5 }], '[0].name', 'it must be a text'],
    [[{ uri: 5 }], '[0].uri', 'it must be a text'],
    [[{ uri: '' }], '[0].uri', '1 to 2048'],
    [[{ uri: 'a'.repeat(2049) }], '[0].uri', '1 to 2048'],
    [[{ uri: '%ff' }], '[0].uri', 'those of UTF-8'],
    [[{ uri: 'data:text/html,a' }], '[0].uri', 'it must begin with data:image/ktx2;base64,'],
    ...['http://a/b.ktx2', 'HTTPS:b.ktx2', 'javascript:1', 'file:///b', '//a/b.ktx2', '/b.ktx2', '../b.ktx2', 'a/../../b.ktx2',
      '%2e%2e/b.ktx2', 'a/%2E./b.ktx2', '..\\b.ktx2', '%5c%5ca/b', 'b.ktx2?c', 'b.ktx2#c', 'blob:a', 'a\nb'].map(
      (uri) => [[{ uri }], '[0].uri', 'it must be data: or the name of a file beside the model'],
    ),
  ]))('textures %j', async (textures, member, message) => {
    await expectRefusal(load(modelOf(right, null, textures, duck)), `VEXTURE_vector_texture.textures${member}`, message);
  });

  test('a file that is no texture', async () => {
    const where = /^VEXTURE_vector_texture\.textures\[0\]: /;
    await expectRefusal(load(modelOf(right, null, [inside], duck.slice(0, 99))), /./, where);
    await expectRefusal(load(modelOf(right, null, [{ uri: 'broken.ktx2' }])), /./, where);
    await expectRefusal(load(modelOf(right, null, [{ uri: 'missing.ktx2' }])), 'status 404', where);
    await expectRefusal(load(modelOf(right, null, [{ uri: 'data:image/ktx2;base64,***' }])), 'uri', where);
    await expectRefusal(load(modelOf(right, null, [{ uri: 'data:image/ktx2;base64,AAAA' }])), /./, where);
  });
});
