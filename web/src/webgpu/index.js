export { VextureError } from '../errors.js';
export { FoldTexture } from '../fold-texture.js';
export { LiveVectorTexture } from '../live-vector-texture.js';
export { readPacked } from '../packed.js';
export { rootAttribute } from '../root-attribute.js';
export { VectorTextureLoader } from '../vector-texture-loader.js';
export { VectorTexture } from '../vector-texture.js';
export { instancedRoot, vectorColor, vectorCoverage } from './vector-nodes.js';
