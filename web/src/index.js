export { VextureError } from './errors.js';
export { readPacked } from './packed.js';
export { VectorTexture } from './vector-texture.js';
export { bounds, cellAt, contains, counts } from './walk.js';
