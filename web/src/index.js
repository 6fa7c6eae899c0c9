export { VextureError } from './errors.js';
export { FoldLoader } from './fold-loader.js';
export { FoldTexture } from './fold-texture.js';
export { LiveVectorTexture } from './live-vector-texture.js';
export { readPacked } from './packed.js';
export { VectorTextureLoader } from './vector-texture-loader.js';
export { VectorTexture } from './vector-texture.js';
export { bounds, cellAt, contains, counts } from './walk.js';
export { paintAt } from './walk-map.js';
export { gltfTransform } from './gltf-transform.js';
export { SceneMask, applyVectorMaskToScene } from './mask-scene.js';
export { rootAttribute } from './attributes.js';
export { VectorMask, applyVectorMask, vectorMaskOf } from './vector-mask.js';
export { VectorMaterial } from './vector-material.js';

/** @typedef {import('./base-loader.js').Bytes} Bytes */
/** @typedef {import('./base-loader.js').OnProgress} OnProgress */
/** @typedef {import('./data.js').PackedData} PackedData */
/** @typedef {import('./data.js').Root} Root */
/** @typedef {import('./data.js').RootPaint} RootPaint */
/** @typedef {import('./data.js').TextureData} TextureData */
/** @typedef {import('./element-at.js').FoundElement} FoundElement */
/** @typedef {import('./live-vector-texture.js').LiveOptions} LiveOptions */
/** @typedef {import('./ray-mesh.js').Masked} Masked */
/** @typedef {import('./ray-mesh.js').MaskedIntersection} MaskedIntersection */
/** @typedef {import('./mask-options.js').MaskOptions} MaskOptions */
/** @typedef {import('./paints.js').Paint} Paint */
/** @typedef {import('./paints.js').PaintList} PaintList */
/** @typedef {import('./select-root.js').RootChoice} RootChoice */
/** @typedef {import('./vector-material.js').VectorMaterialParameters} VectorMaterialParameters */
/** @typedef {import('./vector-texture.js').AnyVectorTexture} AnyVectorTexture */
/** @typedef {import('./vector-texture.js').VectorTextureEvents} VectorTextureEvents */
