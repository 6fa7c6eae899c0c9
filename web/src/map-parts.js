// All that only planar maps need: a chunk of its own in a bundle. Other modules reach it through `mapParts` of maps.js. None
// of it imports three.js: in a bundle of one file, bundlers wrap what is loaded later, with all that it imports.
export { checkMap, checkPaintsOf } from './check-map.js';
export { recolored, setPaints } from './restyle.js';
export { prepareRows } from './rows.js';
export { readStyle, topmostAt } from './style.js';
export { cellPaints, meanOfRoot, paintAt, paintedBox } from './walk-map.js';
