// What is given where something else is needed, undefined above all: a message names the parameter and what it has to be.
import { Mesh, MeshBasicMaterial, PlaneGeometry } from 'three';
import { describe, expect, test } from 'vitest';
import * as gltf from '../src/gltf/index.js';
import * as globe from '../src/globe/index.js';
import * as main from '../src/index.js';
import * as maplibre from '../src/maplibre/index.js';
import * as thesis from '../src/thesis/index.js';
import vexture from '../src/vite/index.js';
import * as water from '../src/water/index.js';
import { fixture } from './files.js';

const duck = fixture('duck.ktx2');
const data = await main.readPacked(duck);
const texture = new main.VectorTexture(data);

const meshOf = (material = new MeshBasicMaterial()) => new Mesh(new PlaneGeometry(), material);

/** A mask, and the mesh that it is of. */
function masked() {
  const mesh = meshOf();
  return { mesh, mask: main.applyVectorMask(mesh.material, texture) };
}

const WRONG = [undefined, null, 7, 'logo.ktx2', {}, []];
const NO_OBJECT = [7, 'logo.ktx2', []];

/** Each public function, what it is given and what its message begins with. @type {[string, (given: any) => unknown, RegExp, any[]?][]} */
const CALLS = [
  ['VectorTexture', (given) => new main.VectorTexture(given), /^the data is .*; give what readPacked returns/],
  ['VectorTexture.replace', (given) => texture.replace(given), /^the data is /],
  ['ThesisTexture', (given) => new thesis.ThesisTexture(given), /^the data is /],
  ['readPacked', (given) => main.readPacked(given), /contents are .*; give a file's bytes$/],
  ['readThesis', (given) => thesis.readThesis(given, given), /contents are .*; give a file's bytes$/],
  ['ThesisLoader.parse', (given) => new thesis.ThesisLoader().parse(given), /^contents are .*; give the bytes of both files/, WRONG.slice(0, -1)],
  ['FoldTexture.parse', (given) => main.FoldTexture.parse(given), /contents are /],
  ['VectorTextureLoader.parse', (given) => new main.VectorTextureLoader().parse(given), /contents are /],
  ['bounds', (given) => main.bounds(given, 0), /^the data is /],
  ['cellAt', (given) => main.cellAt(given, 0, 0.5, 0.5), /^the data is /],
  ['contains', (given) => main.contains(given, 0, 0.5, 0.5), /^the data is /],
  ['counts', (given) => main.counts(given, 0), /^the data is /],
  ['paintAt', (given) => main.paintAt(given, 0, 0.5, 0.5), /^the data is /],
  ['rootAttribute', (given) => main.rootAttribute(given, [0]), /^the texture is .*; load one by VectorTextureLoader$/],
  ['rootAttribute, roots', (given) => main.rootAttribute(texture, given), /^roots is .*; give an array of names$/, WRONG.slice(0, -1)],
  ['applyVectorMask', (given) => main.applyVectorMask(given, texture), /^the material is .*; give one, such as mesh\.material$/],
  ['applyVectorMask, texture', (given) => main.applyVectorMask(new MeshBasicMaterial(), given), /^the texture is .*; load one by VectorTextureLoader$/],
  ['applyVectorMask, options', (given) => main.applyVectorMask(new MeshBasicMaterial(), texture, given), /^the options are .*; give an object/, NO_OBJECT],
  ['applyVectorMaskToScene', (given) => main.applyVectorMaskToScene(given, texture), /^the scene is .*; give a scene, a group or a mesh, such as gltf\.scene$/],
  ['applyVectorMaskToScene, texture', (given) => main.applyVectorMaskToScene(meshOf(), given), /^the texture is /],
  ['applyVectorMaskToScene, materials', (given) => main.applyVectorMaskToScene(meshOf(), texture, { materials: given }), /^materials is .*; give a name/, [7, {}]],
  ['VectorMask.attach', (given) => masked().mask.attach(given), /^the mesh is .*; give the mesh that has this material$/],
  ['VectorMask.attach, options', (given) => { const { mesh, mask } = masked(); mask.attach(mesh, given); }, /^the options are /, NO_OBJECT],
  ['VectorMask.set', (given) => masked().mask.set(given), /^the changes are .*; give an object/, NO_OBJECT],
  ['VectorMaterial', (given) => new main.VectorMaterial(given), /^the values are .*; give an object/, NO_OBJECT],
  ['VectorMaterial, texture', (given) => new main.VectorMaterial({ texture: given }), /texture is .*; load one by VectorTextureLoader/, [undefined, 7, 'logo.ktx2', {}, []]],
  ['VectorMaterial, map', (given) => new main.VectorMaterial({ map: given }), /^the map is .*; give a Texture of three\.js or null, and the shape as texture$/, [7, 'logo.png', {}, []]],
  ['gltfTransform', (given) => main.gltfTransform(given), /^the parts of the transform are .*; give an object/, NO_OBJECT],
  ['LiveVectorTexture.connect', (given) => main.LiveVectorTexture.connect(given), /^the address is .*; give that of a file/, [undefined, null, 7, {}, []]],
  ['LiveVectorTexture.connect, options', (given) => main.LiveVectorTexture.connect('http://127.0.0.1/duck', given), /^the options are /, NO_OBJECT],
  ['VectorTexturePlugin', (given) => new gltf.VectorTexturePlugin(given), /^the parser is .*; hand it on: register/],
  ['VectorTileLayer', (given) => new maplibre.VectorTileLayer(given), /^the layer's id is undefined; give a text$/],
  ['VectorTileLayer, source', (given) => new maplibre.VectorTileLayer({ id: 'map', source: given }), /^the source is .*; give the address/, [undefined, null, 7, '', {}, []]],
  ['VectorGlobe', (given) => new globe.VectorGlobe(given), /^the source is undefined; give the address/],
  ['openTiles', (given) => globe.openTiles(given), /^the source is .*; give the address/, [undefined, null, 7, '', {}, []]],
  ['textureSource', (given) => globe.textureSource(given), /^the texture is .*; give the contents of its file/],
  ['VectorWater', (given) => new water.VectorWater(given), /^the water's geometry is .*; use a PlaneGeometry$/],
  ['VectorWater, texture', (given) => new water.VectorWater(new PlaneGeometry(), given), /^the texture is .*; load one by VectorTextureLoader$/, [undefined, 7, {}, []]],
  ['the plugin of Vite', (given) => vexture(given), /^the options are /, NO_OBJECT],
];

describe.each(CALLS)('%s', (_, call, message, wrong = WRONG) => {
  test('refuses what is of another kind', async () => {
    for (const given of wrong) {
      const error = await Promise.resolve().then(() => call(given)).then(() => null, (reason) => reason);
      expect(error, String(given)).toBeInstanceOf(main.VextureError);
      expect(error.message).toMatch(message);
      expect(error.field).toMatch(/^\S/);
    }
  });
});

test('null is no options', () => {
  const { mask, mesh } = masked();
  expect(mask.attach(mesh, null)).toBe(mask);
  expect(main.gltfTransform(null)).toEqual(main.gltfTransform());
  expect(main.applyVectorMask(new MeshBasicMaterial(), texture, null).options.mode).toBe('alpha');
});
