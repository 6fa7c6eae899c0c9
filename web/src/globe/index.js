/**
 * Maps of `vexture tiles`, or one texture of the world, on a sphere of three.js.
 *
 * @module
 */
export { VextureError } from '../errors.js';
export { openTiles } from '../tiles/source.js';
export { textureSource } from './texture-source.js';
export { VectorGlobe } from './vector-globe.js';

/** @typedef {import('./vector-globe.js').VectorGlobeOptions} VectorGlobeOptions */
/** @typedef {import('../tiles/feature-colors.js').FeatureId} FeatureId */
/** @typedef {import('../tiles/feature-colors.js').FeaturePaint} FeaturePaint */
/** @typedef {import('../tiles/feature-colors.js').FeaturePaints} FeaturePaints */
/** @typedef {import('../tiles/feature-colors.js').PaintFunction} PaintFunction */
/** @typedef {import('../tiles/feature-colors.js').TimeTable} TimeTable */
/** @typedef {import('../tiles/grid.js').TileId} TileId */
/** @typedef {import('../tiles/pyramid.js').Feature} Feature */
/** @typedef {import('../tiles/source.js').TileArchive} TileArchive */
/** @typedef {import('../tiles/source.js').TileSource} TileSource */
/** @typedef {import('../tiles/choose.js').Quad} Quad */
