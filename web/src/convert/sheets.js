// The sheets of a drawing in its colours: planar maps, which are drawn over one another if one would need too many texels.
import { isVaried } from './paints.js';
import { isColoured, hexOf, layersOf } from './split.js';
import { silhouetteOf } from './silhouette.js';
import { mapOf } from './planar-map.js';

/** @import { Bounds, Sheet } from './conversion.js' */
/** @import { Drawing, Path } from './drawing.js' */
/** @import { KernelModules } from './kernel-modules.js' */
/** @import { Kernels } from './kernels.js' */

/** Texels that any drawing may have; a coat of arms in a flag needs half of them, and is exact only as one sheet. */
const LEAST_BUDGET = 1 << 17;

/** Texels of all sheets for each cubic and path, about twice as many as the drawing's layers need. */
const BUDGET = 2;

/** A sheet may leave 1/8 of its texels unused, because finding the most layers that fit would take twice as long. */
const SPARED = 8;

/** Numbers of layers that are tried between one number and its double. */
const STEPS = 4;

/**
 * Make the sheets of a drawing, the lowest first: one, unless its map needs too many texels.
 *
 * A precision does not affect the cutting: the texels that it adds grow with the length of outlines, as those of layers do,
 * not with their crossings.
 *
 * @param {KernelModules} modules
 * @param {Drawing} drawing
 * @param {{ usual: Bounds, precise: Bounds | null }} bounds without and with the precision of the options
 * @param {boolean} restyle
 * @returns {Promise<Sheet[]>}
 */
export async function sheetsOf(modules, drawing, { usual, precise }, restyle) {
  const maps = await modules.load('maps');
  const whole = isColoured(drawing) || restyle ? wholeMap(maps, drawing, usual, restyle) : null;
  if (whole && !precise) return [whole];
  const silhouettes = await modules.load('silhouettes');
  const sheets = whole ? [whole] : withinBudget({ maps, silhouettes }, drawing, usual, restyle);
  if (!precise) return sheets;
  let first = 0;
  return sheets.map((sheet) => {
    const rebuilt = sheet.isMap
      ? /** @type {Sheet} */ (mapOf(maps, sheet.drawing, precise, { restyle, first, mostTexels: Infinity }))
      : { ...sheet, texels: silhouetteOf(silhouettes, sheet.drawing, precise, first) };
    first += rebuilt.texels.length / 4;
    return rebuilt;
  });
}

/** @param {Drawing} drawing @returns {number} texels that it may have */
function budgetOf({ paths }) {
  const segments = paths.reduce((sum, { contours }) => sum + contours.reduce((more, { length }) => more + length / 8, 0), 0);
  return Math.max(BUDGET * (segments + paths.length), LEAST_BUDGET);
}

/**
 * The map of a whole drawing; null if it needs too many texels.
 *
 * @param {Kernels} maps
 * @param {Drawing} drawing
 * @param {Bounds} bounds
 * @param {boolean} restyle
 */
const wholeMap = (maps, drawing, bounds, restyle) => mapOf(maps, drawing, bounds, { restyle, first: 0, mostTexels: budgetOf(drawing) });

/**
 * Sheets of a drawing of which one map would need too many texels, or which may be one layer of one colour.
 *
 * @param {{ maps: Kernels, silhouettes: Kernels }} kernels
 * @param {Drawing} drawing
 * @param {Bounds} bounds
 * @param {boolean} restyle
 * @returns {Sheet[]}
 */
function withinBudget({ maps, silhouettes }, drawing, bounds, restyle) {
  if (!restyle && !isColoured(drawing)) {
    const layers = layersOf(drawing);
    if (layers.length === 1) return [{ drawing: layers[0], texels: silhouetteOf(silhouettes, layers[0], bounds, 0), isMap: false }];
    const whole = wholeMap(maps, drawing, bounds, restyle);
    if (whole) return [whole];
  }
  const budget = budgetOf(drawing);
  const items = itemsOf(drawing);
  const attempt = (/** @type {number} */ start, /** @type {number} */ end, /** @type {number} */ first) => {
    const part = items.length === end - start ? drawing : { ...drawing, paths: items.slice(start, end).flat() };
    const [path] = part.paths;
    const isLayer = end === start + 1 && part.paths.length === 1 && path.group < 0 && !isVaried(path.paint);
    if (isLayer && !restyle) return { drawing: part, texels: silhouetteOf(silhouettes, part, bounds, first), isMap: false };
    const share = end > start + 1 ? Math.floor((budget * (end - start)) / items.length) : Infinity;
    return mapOf(maps, part, bounds, { restyle, first, mostTexels: share });
  };
  return greedy(items.length, budget / items.length, attempt).map((sheet, k) => named(sheet, drawing.name, k + 1));
}

/**
 * A sheet with a name like those of a drawing's layers.
 *
 * @param {Sheet} sheet
 * @param {string} name
 * @param {number} number
 * @returns {Sheet}
 */
function named(sheet, name, number) {
  const kind = sheet.isMap ? 'faces' : hexOf(sheet.drawing.paths[0].paint);
  return { ...sheet, drawing: { ...sheet.drawing, name: `${name}/${number}-${kind}` } };
}

/**
 * Sheets of `count` items, each with about as many items as fit.
 *
 * The search begins at the number of items in the sheet below, with steps that double until they pass the goal, and then
 * halve.
 *
 * @param {number} count
 * @param {number} share texels for one item
 * @param {(start: number, end: number, first: number) => Sheet | null} attempt makes a sheet of some items whose first texel is
 *   `first`; null if they need too many texels, never for a single item
 * @returns {Sheet[]}
 */
function greedy(count, share, attempt) {
  /** @type {Sheet[]} */
  const sheets = [];
  let [start, below, first] = [0, 0, 0];
  while (start < count) {
    const sizes = sizesUpTo(count - start);
    let [fitting, failing, at, step] = [-1, sizes.length, Math.min(below, sizes.length - 1), 1];
    /** @type {Sheet | null} */
    let best = null;
    while (failing - fitting > 1) {
      const sheet = attempt(start, start + sizes[at], first);
      if (sheet) [best, fitting] = [sheet, at];
      else failing = at;
      if (sheet && SPARED * (sheet.size ?? sheet.texels.length / 4) >= (SPARED - 1) * share * sizes[at]) break;
      if (fitting >= 0 && failing < sizes.length) at = (fitting + failing) >> 1;
      else {
        at = Math.min(Math.max(at + (sheet ? step : -step), 0), sizes.length - 1);
        step *= 2;
      }
    }
    const made = /** @type {Sheet} */ (best);
    sheets.push(made);
    [start, below, first] = [start + sizes[fitting], fitting, first + made.texels.length / 4];
  }
  return sheets;
}

/**
 * Numbers of items that are tried: 1 to 7, 8, 10, 12, 14, 16, 20 and so on, and the most.
 *
 * @param {number} most
 */
function sizesUpTo(most) {
  const sizes = [1, 2, 3, 4, 5, 6, 7];
  for (let step = 2; sizes[sizes.length - 1] < most; step *= 2) for (let k = 0; k < STEPS; k++) sizes.push(step * (STEPS + k));
  return [...sizes.filter((size) => size < most), most];
}

/**
 * Paths of a drawing in runs that cannot be cut: an outermost group, and all paths below if it blends with them.
 *
 * @param {Drawing} drawing
 * @returns {Path[][]}
 */
function itemsOf({ paths, groups }) {
  /** @type {Path[][]} */
  let items = [];
  let before = -1;
  for (const path of paths) {
    let outermost = path.group;
    while (outermost >= 0 && groups[outermost].outer >= 0) outermost = groups[outermost].outer;
    if (outermost >= 0 && outermost === before) items[items.length - 1].push(path);
    else if (outermost >= 0 && groups[outermost].blend) items = [[...items.flat(), path]];
    else items.push([path]);
    before = outermost;
  }
  return items;
}
