/**
 * Vector textures in models of glTF: a plugin of three.js's `GLTFLoader`.
 *
 * @module
 */
export { VectorTexturePlugin } from './plugin.js';
export { gltfTransform } from '../gltf-transform.js';
