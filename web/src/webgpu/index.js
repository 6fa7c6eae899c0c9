/**
 * Nodes, masks and a material for three.js's WebGPURenderer, on WebGPU and on its WebGL 2 fallback; three.js 0.187 or newer.
 *
 * @module
 */
export { VextureError } from '../errors.js';
export { rootAttribute } from '../attributes.js';
export { FoldLoader } from '../fold-loader.js';
export { FoldTexture } from '../fold-texture.js';
export { LiveVectorTexture } from '../live-vector-texture.js';
export { readPacked } from '../packed.js';
export { loadMaps } from '../maps.js';
export { VectorTextureLoader } from '../vector-texture-loader.js';
export { VectorTexture } from '../vector-texture.js';
export { BatchedText, Text } from './texts.js';
export { VectorNodeMask, applyVectorMask, vectorMaskOf } from './vector-node-mask.js';
export { VectorNodeMaterial } from './vector-node-material.js';
export { instancedRoot, vectorColor, vectorCoverage } from './vector-nodes.js';

/** @typedef {import('../mask-options.js').MaskOptions} MaskOptions */
/** @typedef {import('../shape-material.js').VectorMaterialParameters} VectorMaterialParameters */
/** @typedef {import('./vector-nodes.js').ShapeOptions} ShapeOptions */
/** @typedef {import('./vector-nodes.js').ColorOptions} ColorOptions */
