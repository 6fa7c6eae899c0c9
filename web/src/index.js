/**
 * Vector textures for three.js's `WebGLRenderer`: load them, mask materials with them, recolour their elements, query
 * points, and follow a server.
 *
 * @module
 */
export { VextureError } from './errors.js';
export { FoldLoader } from './fold-loader.js';
export { FoldTexture } from './fold-texture.js';
export { LiveVectorTexture } from './live-vector-texture.js';
export { loadMaps } from './maps.js';
export { readPacked } from './packed.js';
export { VectorTextureLoader } from './vector-texture-loader.js';
export { VectorTexture } from './vector-texture.js';
export { bounds, cellAt, contains, counts, paintAt } from './walk.js';
export { gltfTransform } from './gltf-transform.js';
export { SceneMask, applyVectorMaskToScene } from './mask-scene.js';
export { rootAttribute } from './attributes.js';
export { VectorMask, applyVectorMask, vectorMaskOf } from './vector-mask.js';
export { VectorMaterial } from './vector-material.js';

/** @typedef {import('./base-loader.js').Bytes} Bytes */
/** @typedef {import('./base-loader.js').OnProgress} OnProgress */
/** @typedef {import('./gltf-transform.js').GLTFTransform} GLTFTransform */
/** @typedef {import('./live-source.js').Manifest} Manifest */
/** @typedef {import('./mask-options.js').AllOptions} AllOptions */
/** @typedef {import('./mask-scene.js').SceneMaskOptions} SceneMaskOptions */
/** @typedef {import('./shape-material.js').ShapeParameters} ShapeParameters */
/** @typedef {import('./style.js').Style} Style */
/** @typedef {import('./style.js').StyleElement} StyleElement */
/** @typedef {import('./style.js').StyleGroup} StyleGroup */
/** @typedef {import('./vector-texture.js').TextureMap} TextureMap */
/** @typedef {import('./walk.js').Cell} Cell */
/** @typedef {import('./walk.js').CellPaints} CellPaints */
/** @typedef {import('./walk-map.js').Painted} Painted */
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
