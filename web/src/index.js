export { VectorMask, applyVectorMask, rootAttribute } from './vector-mask.js';
export { VectorMaterial } from './vector-material.js';
export { VectorTexture } from './vector-texture.js';
export { VextureError } from './errors.js';
export { readPacked } from './packed.js';
