export { VextureError } from './errors.js';
export { FoldTexture } from './fold-texture.js';
export { LiveVectorTexture } from './live-vector-texture.js';
export { readPacked } from './packed.js';
export { VectorTextureLoader } from './vector-texture-loader.js';
export { VectorTexture } from './vector-texture.js';
export { bounds, cellAt, contains, counts } from './walk.js';
export { paintAt } from './walk-map.js';
export { rootAttribute } from './root-attribute.js';
export { VectorMask, applyVectorMask, vectorMaskOf } from './vector-mask.js';
export { VectorMaterial } from './vector-material.js';

/** @typedef {import('./mask-mesh.js').MaskedIntersection} MaskedIntersection */
/** @typedef {import('./element-at.js').FoundElement} FoundElement */
