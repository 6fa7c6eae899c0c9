export { VextureError } from './errors.js';
export { FoldTexture } from './fold-texture.js';
export { LiveVectorTexture } from './live-vector-texture.js';
export { readPacked } from './packed.js';
export { VectorTextureLoader } from './vector-texture-loader.js';
export { VectorTexture } from './vector-texture.js';
export { bounds, cellAt, contains, counts } from './walk.js';
export { paintAt } from './walk-map.js';
export { SceneMask, applyVectorMaskToScene } from './mask-scene.js';
export { gltfTransform } from './gltf-transform.js';
export { VectorMask, applyVectorMask, rootAttribute, vectorMaskOf } from './vector-mask.js';
export { VectorMaterial } from './vector-material.js';

/** @typedef {import('./mask-mesh.js').MaskedIntersection} MaskedIntersection */
/** @typedef {import('./mask-scene.js').SceneMaskOptions} SceneMaskOptions */
/** @typedef {import('./element-at.js').FoundElement} FoundElement */
