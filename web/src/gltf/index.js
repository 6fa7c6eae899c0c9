// The package's entry `vexture/gltf`: vector textures in models of glTF.
export { VectorTexturePlugin } from './plugin.js';
export { gltfTransform } from '../gltf-transform.js';
