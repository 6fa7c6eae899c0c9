// Models of glTF of one plane and three materials, made here.
import { EXTENSION } from '../src/gltf/extension.js';

const PLACES = Float32Array.from([-1, 1, 0, 1, 1, 0, 1, -1, 0, -1, -1, 0]);
const COORDINATES = Float32Array.from([0, 0, 1, 0, 1, 1, 0, 1]);
const TRIANGLES = Uint16Array.from([0, 2, 1, 0, 3, 2]);

/**
 * A model whose meshes have the materials Sign, Wall and Plain; the first two show what is given.
 *
 * @param {Record<string, unknown>} sign
 * @param {Record<string, unknown> | null} wall
 * @param {unknown} textures
 * @param {Uint8Array} [file] in the last buffer view
 */
export function modelOf(sign, wall, textures, file = new Uint8Array()) {
  const parts = [PLACES, COORDINATES, TRIANGLES, file].map((part) => new Uint8Array(part.buffer, part.byteOffset, part.byteLength));
  let byteOffset = 0;
  const bufferViews = parts.map(({ byteLength }) => {
    const view = { buffer: 0, byteOffset, byteLength };
    byteOffset += byteLength;
    return view;
  });
  const primitive = (/** @type {number} */ material, mode = 4) => ({ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material, mode });
  const document = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0, 1, 2, 3] }],
    nodes: [{ mesh: 0 }, { mesh: 0 }, { mesh: 1 }, { mesh: 2 }],
    meshes: [{ primitives: [primitive(0), primitive(0, 1)] }, { primitives: [primitive(1)] }, { primitives: [primitive(2)] }],
    materials: [
      { name: 'Sign', extensions: { [EXTENSION]: sign } },
      { name: 'Wall', ...(wall ? { extensions: { [EXTENSION]: wall } } : {}) },
      { name: 'Plain' },
    ],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] },
      { bufferView: 1, componentType: 5126, count: 4, type: 'VEC2' },
      { bufferView: 2, componentType: 5123, count: 6, type: 'SCALAR' },
    ],
    bufferViews,
    buffers: [{ byteLength: byteOffset }],
    extensionsUsed: [EXTENSION],
    extensions: { [EXTENSION]: { textures } },
  };
  return glb(document, Buffer.concat(parts));
}

/**
 * Contents of a .glb.
 *
 * @param {object} document
 * @param {Uint8Array} binary
 */
function glb(document, binary) {
  const text = Buffer.from(JSON.stringify(document));
  const chunks = [[0x4e4f534a, Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')])], [0x004e4942, Buffer.concat([binary, Buffer.alloc(-binary.length & 3)])]];
  const parts = chunks.flatMap(([kind, content]) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(/** @type {Buffer} */ (content).length, 0);
    head.writeUInt32LE(/** @type {number} */ (kind), 4);
    return [head, /** @type {Buffer} */ (content)];
  });
  const head = Buffer.alloc(12);
  head.write('glTF');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + parts.reduce((sum, { length }) => sum + length, 0), 8);
  return new Uint8Array(Buffer.concat([head, ...parts])).buffer;
}
