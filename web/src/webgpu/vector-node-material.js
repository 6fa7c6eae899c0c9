import { MeshBasicNodeMaterial } from 'three/webgpu';
import { shapeMaterial } from '../shape-material.js';
import { VectorNodeMask } from './vector-node-mask.js';

/** @typedef {import('../shape-material.js').VectorMaterialParameters} VectorMaterialParameters */

const Base = /** @type {new () => import('three').MeshBasicMaterial} */ (/** @type {unknown} */ (MeshBasicNodeMaterial));

/**
 * An unlit material of WebGPURenderer that shows a shape in one colour, or a drawing in its own colours: what
 * `VectorMaterial` is for WebGLRenderer, with the same options. `applyVectorMask` masks other node materials.
 */
export class VectorNodeMaterial extends shapeMaterial(Base, VectorNodeMask, 'VectorNodeMaterial') {
  static get type() {
    return 'VectorNodeMaterial';
  }
}
