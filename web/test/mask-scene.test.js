import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { BoxGeometry, Group, LineBasicMaterial, Line, Matrix3, Mesh, MeshBasicMaterial, MeshStandardMaterial, PlaneGeometry, Raycaster, ShaderMaterial, SkinnedMesh, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { VextureError } from '../src/errors.js';
import { gltfTransform } from '../src/gltf-transform.js';
import { applyVectorMaskToScene } from '../src/mask-scene.js';
import { readPacked } from '../src/packed.js';
import { applyVectorMask, vectorMaskOf } from '../src/vector-mask.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture } from './files.js';

const read = async (/** @type {string} */ name) => new VectorTexture(await readPacked(fixture(`${name}.ktx2`), name));
const [duck, drawings] = await Promise.all([read('duck'), read('drawings')]);

/** A sign of one material, twice; a box of two; a figure with bones; a line, which no mask is for. */
function made() {
  const [sign, wall, skin] = ['Sign', 'Wall', 'Skin'].map((name) => new MeshStandardMaterial({ name }));
  const scene = new Group();
  const plane = new PlaneGeometry(2, 2);
  const meshes = [new Mesh(plane, sign), new Mesh(plane, sign), new Mesh(new BoxGeometry(), Array.from({ length: 6 }, (_, i) => (i % 2 ? sign : wall)))];
  const figure = new SkinnedMesh(plane, skin);
  meshes[0].add(meshes[1]);
  scene.add(meshes[0], meshes[2], figure, new Line(plane, new LineBasicMaterial({ name: 'Wire' })));
  return { scene, sign, wall, skin, meshes, figure };
}

/** @param {import('three').Object3D} object */
function meets(object, x = 0, y = 0) {
  object.updateMatrixWorld(true);
  return new Raycaster(new Vector3(x, y, 5), new Vector3(0, 0, -1)).intersectObject(object, false).length > 0;
}

describe('all materials of a scene', () => {
  test('are masked once each, and their meshes attached', () => {
    const { scene, sign, wall, skin, meshes, figure } = made();
    const all = applyVectorMaskToScene(scene, duck, { mode: 'cut' });
    expect(all.masks.map(({ material }) => material)).toEqual([sign, wall, skin]);
    expect([sign, wall, skin].map((material) => vectorMaskOf(material))).toEqual(all.masks);
    expect([meshes[0], meshes[1], figure].map((mesh) => mesh.customDepthMaterial?.type)).toEqual(Array(3).fill('MeshDepthMaterial'));
    expect([meets(meshes[0]), meets(meshes[0], 0.98, 0.98)]).toEqual([true, false]);
    expect(meshes[2].customDepthMaterial).toBeUndefined(); // several materials share one shadow
    expect(Object.hasOwn(meshes[2], 'raycast')).toBe(true);
    all.remove();
    all.remove();
    for (const mesh of [...meshes, figure]) {
      expect([Object.hasOwn(mesh, 'raycast'), Object.hasOwn(mesh, 'clone'), mesh.customDepthMaterial]).toEqual([false, false, undefined]);
    }
    expect(vectorMaskOf(sign)).toBeUndefined();
    applyVectorMaskToScene(scene, duck).remove();
  });

  test('share their options, and change all together or not at all', () => {
    const { scene } = made();
    const transform = new Matrix3();
    const all = applyVectorMaskToScene(scene, duck, { transform });
    expect(all.masks.every((mask) => mask.transform === transform)).toBe(true);
    all.set({ texture: drawings, root: 1, wrap: 'repeat' });
    expect(all.masks.map(({ texture, root, wrap }) => [texture, root, wrap])).toEqual(Array(3).fill([drawings, 1, 'repeat']));
    const last = all.masks[2];
    const { set } = last;
    last.set = () => { throw new VextureError('no', 'root'); };
    expect(() => all.set({ root: 0 })).toThrow('no');
    last.set = set;
    expect(all.masks.map(({ root }) => root)).toEqual([1, 1, 1]);
  });
});

describe('some materials', () => {
  test('by a name, by names, by a function', () => {
    for (const [materials, expected] of /** @type {[any, string[]][]} */ ([
      ['Sign', ['Sign']],
      [Object.freeze(['Skin', 'Sign']), ['Sign', 'Skin']],
      [({ name }, mesh) => name !== 'Sign' && !('isSkinnedMesh' in mesh), ['Wall']],
    ])) {
      const { masks } = applyVectorMaskToScene(made().scene, duck, { materials });
      expect(masks.map(({ material }) => material.name)).toEqual(expected);
    }
  });

  test.each([
    ['Sing', 'no material "Sing"; there are "Sign", "Wall", "Skin"'],
    [['Sign', 'Wire'], 'no material "Wire"; there are "Sign", "Wall", "Skin"'],
    [() => false, 'no material is chosen of 3; there are "Sign", "Wall", "Skin"'],
    [[], 'no material is chosen of 3; there are "Sign", "Wall", "Skin"'],
  ])('%o is refused', (materials, message) => {
    expect(() => applyVectorMaskToScene(made().scene, duck, { materials })).toThrow(message);
  });

  test('of a scene without names', () => {
    const scene = new Group().add(new Mesh(new PlaneGeometry(), new MeshBasicMaterial()));
    expect(() => applyVectorMaskToScene(scene, duck, { materials: '' })).toThrow('none has a name; choose by a function');
    expect(applyVectorMaskToScene(scene, duck).masks.length).toBe(1);
    expect(() => applyVectorMaskToScene(new Group(), duck)).toThrow('no material is chosen of 0');
  });
});

test('a material that cannot be masked leaves all as they were', () => {
  const { scene, sign, meshes } = made();
  scene.add(new Mesh(new PlaneGeometry(), new ShaderMaterial({ name: 'Own' })));
  expect(() => applyVectorMaskToScene(scene, duck)).toThrow(VextureError);
  expect([vectorMaskOf(sign), Object.hasOwn(meshes[0], 'raycast')]).toEqual([undefined, false]);
  expect(() => applyVectorMaskToScene(scene, duck, { materials: 'Sign', mode: /** @type {any} */ ('glow') })).toThrow('mode');
  expect(() => applyVectorMaskToScene(scene, duck, { materials: 'Sign', instanced: true })).toThrow('vextureRoot');
  expect([vectorMaskOf(sign), Object.hasOwn(meshes[0], 'raycast')]).toEqual([undefined, false]);
});

describe('a clone of a model', () => {
  test('is attached to the masks that it shares', () => {
    const { scene, sign } = made();
    const all = applyVectorMaskToScene(scene, duck, { mode: 'cut' });
    const copy = scene.clone();
    const mesh = /** @type {Mesh} */ (copy.children[0].children[0]);
    expect([mesh.material, mesh.customDepthMaterial?.type]).toEqual([sign, 'MeshDepthMaterial']);
    expect([meets(mesh), meets(mesh, 0.98, 0.98)]).toEqual([true, false]);
    const again = mesh.clone();
    all.set({ mode: 'mix' });
    expect([mesh.customDepthMaterial, meets(again, 0.98, 0.98)]).toEqual([undefined, true]);
    const other = new Mesh(mesh.geometry, sign);
    other.clone = () => /** @type {any} */ (new Mesh(mesh.geometry, new MeshBasicMaterial()));
    all.masks[0].attach(other);
    expect(Object.hasOwn(other.clone(), 'raycast')).toBe(false);
    all.remove();
    expect([Object.hasOwn(mesh, 'clone'), Object.hasOwn(again, 'raycast')]).toEqual([false, false]);
  });

  test('is not kept alive by its mask', async () => {
    const { scene } = made();
    const all = applyVectorMaskToScene(scene, duck, { mode: 'cut' });
    const copy = new WeakRef(scene.clone());
    const kept = scene.clone();
    await new Promise((resolve) => setTimeout(resolve)); // what is looked at lives until its task ends
    setFlagsFromString('--expose_gc');
    runInNewContext('gc')();
    expect(copy.deref()).toBeUndefined();
    all.set({ mode: 'mix' });
    expect(/** @type {Mesh} */ (kept.children[0]).customDepthMaterial).toBeUndefined();
  });

  test('a mesh of several masks gives them back in any order', () => {
    const [one, two] = [new MeshBasicMaterial(), new MeshBasicMaterial()];
    const mesh = new Mesh(new BoxGeometry(), [one, two, one, two, one, two]);
    const masks = [one, two].map((material) => applyVectorMask(material, duck));
    expect(() => masks[0].attach(mesh)).toThrow('share one shadow');
    for (const mask of masks) mask.attach(mesh, { shadow: false });
    expect([meets(mesh), meets(mesh, 0.49, 0.49)]).toEqual([true, false]);
    masks[0].set({ mode: 'cut' });
    masks[0].remove();
    masks[1].remove();
    expect([Object.hasOwn(mesh, 'raycast') && meets(mesh, 0.49, 0.49), mesh.clone() instanceof Mesh]).toEqual([true, true]);
  });
});

test('the second set of texture coordinates is what rays look up', () => {
  const geometry = new PlaneGeometry(2, 2);
  geometry.setAttribute('uv1', geometry.getAttribute('uv').clone());
  geometry.getAttribute('uv').array.fill(-1);
  const mesh = new Mesh(geometry, new MeshBasicMaterial());
  const mask = applyVectorMask(mesh.material, duck, { channel: 1 }).attach(mesh);
  expect([meets(mesh), meets(mesh, 0.98, 0.98)]).toEqual([true, false]);
  mask.channel = 0;
  expect(meets(mesh)).toBe(false);
  expect(() => (mask.channel = /** @type {any} */ (2))).toThrow('channel is 2; it must be one of 0, 1');
});

test('texture coordinates of glTF are scaled, turned, moved and turned over', () => {
  const at = (/** @type {any} */ transform, /** @type {number} */ u, /** @type {number} */ v) => {
    const { x, y } = new Vector3(u, v, 1).applyMatrix3(gltfTransform(transform));
    return [x, y].map((one) => Math.round(1e6 * one) / 1e6 + 0);
  };
  expect([at({}, 0.25, 0), at(undefined, 0.25, 1)]).toEqual([[0.25, 1], [0.25, 0]]);
  const corner = { offset: [0, 1], rotation: Math.PI / 2, scale: [0.5, 0.5] }; // that of Khronos: the lower left quarter
  expect([at(corner, 0, 0), at(corner, 1, 0), at(corner, 0, 1)]).toEqual([[0, 0], [0, 0.5], [0.5, 0]]);
  expect(at({ scale: [2, 3], offset: [0.1, 0.2] }, 0.5, 0.25)).toEqual([1.1, 0.05]);
  expect(() => at({ scale: 5 }, 0, 0)).toThrow('"scale":5}; offset and scale must be two numbers each, rotation one');
});
