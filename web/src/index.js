export { VextureError } from './errors.js';
export { FoldTexture } from './fold-texture.js';
export { LiveVectorTexture } from './live-vector-texture.js';
export { loadMaps } from './maps.js';
export { readPacked } from './packed.js';
export { VectorTextureLoader } from './vector-texture-loader.js';
export { VectorTexture } from './vector-texture.js';
export { bounds, cellAt, contains, counts, paintAt } from './walk.js';
export { VectorMask, applyVectorMask, rootAttribute, vectorMaskOf } from './vector-mask.js';
export { VectorMaterial } from './vector-material.js';

/** @typedef {import('./mask-mesh.js').MaskedIntersection} MaskedIntersection */
/** @typedef {import('./element-at.js').FoundElement} FoundElement */
