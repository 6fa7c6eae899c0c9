/**
 * Maps of `vexture tiles` in MapLibre GL JS 5.7 or newer, flat and on its globe, without three.js.
 *
 * @module
 */
export { VextureError } from '../errors.js';
export { openTiles } from '../tiles/source.js';
export { VectorTileLayer } from './vector-tile-layer.js';

/** @typedef {import('./vector-tile-layer.js').VectorTileLayerOptions} VectorTileLayerOptions */
/** @typedef {import('./vector-tile-layer.js').FeatureEvent} FeatureEvent */
/** @typedef {import('./vector-tile-layer.js').LayerEvents} LayerEvents */
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
