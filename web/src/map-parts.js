// All that only planar maps need: a chunk of its own in a bundle. Other modules reach it through `mapParts` of maps.js.
export { planar } from '../generated/planar-shader.js';
export { checkMap, checkPaintsOf } from './check-map.js';
export { setPaints } from './restyle.js';
export { RowTexture } from './row-texture.js';
export { readStyle, topmost } from './style.js';
export { cellPaints, meanOfRoot, paintAt, paintedBox } from './walk-map.js';
