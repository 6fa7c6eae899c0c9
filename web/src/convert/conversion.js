// Conversion of a drawing into the texels of a texture, by the kernels; runs in a worker, in a page and in Node.js.
import { LATTICE, MAP_HEAD, MOST_CURVES, MOST_DEPTH, MOST_ROWS, ROW_BITS } from '../../generated/layout.js';
import { VextureError, line } from '../errors.js';
import { KernelModules } from './kernel-modules.js';
import { MAX_SECONDS, checkSeconds } from './pace.js';
import { sheetsOf } from './sheets.js';
import { silhouetteOf } from './silhouette.js';
import { layersOf, splitOf, withoutGradients, withoutMasks } from './split.js';

/** @import { Root } from '../data.js' */
/** @import { Drawing, Note } from './drawing.js' */
/** @import { Kernels } from './kernels.js' */
/** @import { Split } from './split.js' */

/**
 * @typedef {object} ConversionOptions Options of a conversion of a drawing; see `ConvertOptions`.
 * @property {Split} [split] how the drawing becomes shapes
 * @property {number} [tolerance] largest distance between the outlines, in unit-square units
 * @property {number} [maxDepth] depth at which cells are not divided
 * @property {number} [capacity] most pieces in a leaf
 * @property {number} [precision] largest shift by rounding, in unit-square units
 * @property {boolean} [restyle] keep elements apart
 * @property {number} [maxSeconds] time limit
 *
 * @typedef {object} Converted A texture, as a worker sends it.
 * @property {string} name of the texture
 * @property {number} width texels in a row
 * @property {number} height rows
 * @property {Uint32Array} texels four words each, row by row
 * @property {Root[]} roots its shapes
 * @property {Note[]} notes what was left out, simplified or chosen
 *
 * @typedef {object} Bounds Limits of a tree, as `vexture.tree.bounds` in Python.
 * @property {number | undefined} capacity
 * @property {number} tolerance
 * @property {number} near
 * @property {number} leastDepth
 * @property {number} maxDepth
 * @property {number} maxSeconds
 *
 * @typedef {object} Sheet A shape of the texture: its part of the drawing, and its texels.
 * @property {Drawing} drawing
 * @property {Uint32Array} texels
 * @property {number} [size] of a map, its texels as Python estimates them, which decides where drawings are cut
 * @property {boolean} isMap
 * @property {number} [flattened] paints of a map that are mean colours, because no program can hold their gradients
 * @property {import('../style.js').Style | null} [style]
 */

/** Lattice units by which a curve may move, because its points are rounded when it is cut, and again in its leaf. */
const DISPLACEMENT = 2;

/** Share of the largest shift within which the pieces of a crowded cell count as one. */
const COINCIDENT = 0.25;

/** Notes on maps. */
const FLATTENED = 'gradients by their mean colours: too many on one another, or in more than 3 groups in one another';
const several = (/** @type {number} */ count) =>
  `so many crossing shapes are ${count} maps on one another; what is below shows through where they touch`;

/** The conversions by one set of kernels. */
export class Conversion {
  /** @param {import('./kernel-modules.js').KernelSources} [sources] of the kernels */
  constructor(sources) {
    this.modules = new KernelModules(sources);
  }

  /**
   * Convert a drawing.
   *
   * @param {Drawing} drawing
   * @param {ConversionOptions} [options]
   * @returns {Promise<Converted>}
   * @throws {VextureError} if an option is out of range, or the drawing exceeds a limit
   */
  async convert(drawing, { split = 'auto', restyle = false, ...limits } = {}) {
    const way = splitOf(drawing, split, restyle);
    const shown = restyle ? withoutGradients(drawing) : way ? drawing : withoutMasks(drawing);
    const layers = way === 'paint' ? layersOf(drawing) : [];
    const isMap = way === 'faces' && drawing.paths.length > 0;
    const kernels = await this.modules.load(isMap ? 'maps' : 'silhouettes');
    const bounds = boundsOf(kernels, limits);
    checkSides(shown, bounds);
    checkLayers(drawing.name, layers.length);
    const { tolerance } = bounds;
    const usual = boundsOf(kernels, { ...limits, precision: undefined, tolerance });
    const sheets = isMap
      ? await sheetsOf(this.modules, shown, { usual, precise: limits.precision === undefined ? null : bounds }, restyle)
      : silhouettesOf(kernels, layers.length ? layers : [shown], bounds);
    const count = sheets.reduce((sum, { texels }) => sum + texels.length / 4, 0);
    if (count > MOST_ROWS << ROW_BITS) {
      throw new VextureError(`${drawing.name}: ${count} texels; the limit is ${MOST_ROWS << ROW_BITS}; use a larger \`tolerance\``, 'texels');
    }
    const roots = rootsOf(sheets, tolerance, split !== null);
    return { name: drawing.name, ...inRows(sheets, count), roots, notes: [...(layers[0] ?? shown).notes, ...notesOf(sheets, restyle)] };
  }
}

/**
 * @param {Kernels} kernels
 * @param {Drawing[]} drawings
 * @param {Bounds} bounds
 * @returns {Sheet[]}
 */
function silhouettesOf(kernels, drawings, bounds) {
  let first = 0;
  return drawings.map((drawing) => {
    const texels = silhouetteOf(kernels, drawing, bounds, first);
    first += texels.length / 4;
    return { drawing, texels, isMap: false };
  });
}

/**
 * Refuse a drawing so narrow that rounding would leave nothing of it, or another width.
 *
 * @param {Drawing} drawing
 * @param {Bounds} bounds
 * @throws {VextureError} if its shorter side is less than the largest shift by rounding
 */
function checkSides({ name, sides = [1, 1], paths }, { leastDepth }) {
  const side = Math.min(...sides);
  const shift = DISPLACEMENT * 0.5 ** leastDepth / LATTICE;
  if (side >= shift || !paths.length) return;
  const [part, most, precision] = [side, shift, side / 10].map((value) => value.toExponential(1));
  throw new VextureError(
    `${name}: its shorter side is ${part} of the longer one; rounding shifts by up to ${most} of it; give a \`precision\` of ${precision}, or a wider view box`,
    'precision',
  );
}

/** @param {string} name @param {number} count of layers @throws {VextureError} if no material can show so many */
function checkLayers(name, count) {
  if (count <= MOST_ROWS) return;
  const [layers, most] = [count, MOST_ROWS].map((value) => value.toLocaleString('en-US'));
  throw new VextureError(`${name}: ${layers} layers; a material shows ${most} at most; give \`split: 'faces'\`, or divide the drawing`, 'split');
}

/** @param {unknown} value @returns {value is number} texts compare like numbers, but are none */
const isNumber = (value) => typeof value === 'number';

/**
 * Limits of a tree from the options.
 *
 * @param {Kernels} kernels
 * @param {Pick<ConversionOptions, 'tolerance' | 'maxDepth' | 'capacity' | 'precision' | 'maxSeconds'>} options
 * @returns {Bounds}
 * @throws {VextureError} if one is out of range
 */
function boundsOf({ constants }, { precision, tolerance, maxDepth = constants.MAX_DEPTH, capacity, maxSeconds = MAX_SECONDS }) {
  const allowed = tolerance ?? (precision === undefined ? constants.TOLERANCE : 0);
  const whole = (/** @type {string} */ name, /** @type {number} */ value, /** @type {number} */ most) => {
    if (Number.isInteger(value) && value >= 1 && value <= most) return;
    throw new VextureError(`\`${name}\` ${line(value)} is no whole number in 1..${most}; leave it out`, name);
  };
  whole('maxDepth', maxDepth, MOST_DEPTH);
  if (capacity !== undefined) whole('capacity', capacity, MOST_CURVES);
  const finest = DISPLACEMENT * 0.5 ** maxDepth / LATTICE;
  if (precision !== undefined && !(isNumber(precision) && precision >= finest && precision <= 1)) {
    throw new VextureError(`\`precision\` ${line(precision)} is no number in ${finest}..1 (unit-square units); leave it out`, 'precision');
  }
  if (!(isNumber(allowed) && allowed >= 0 && allowed < 1)) {
    throw new VextureError(`\`tolerance\` ${line(allowed)} is no number from 0 to below 1 (unit-square units); 0 keeps every piece`, 'tolerance');
  }
  const leastDepth = precision === undefined ? 1 : Math.max(Math.ceil(Math.log2(DISPLACEMENT / (precision * LATTICE))), 1);
  const near = COINCIDENT * (precision ?? (0.5 * DISPLACEMENT) / LATTICE);
  checkSeconds(maxSeconds);
  return { capacity, tolerance: allowed, near, leastDepth, maxDepth, maxSeconds };
}

/**
 * @param {Sheet[]} sheets
 * @param {number} tolerance
 * @param {boolean} isColoured whether layers keep their colours
 * @returns {Root[]}
 */
function rootsOf(sheets, tolerance, isColoured) {
  let first = 0;
  return sheets.map(({ drawing, texels, isMap, style = null }) => {
    const [a, b, c, d, e, f] = drawing.toSource;
    const quad = first + (isMap ? MAP_HEAD : 0);
    first += texels.length / 4;
    const flat = !isMap && isColoured && drawing.paths.length ? drawing.paths[0].paint : null;
    return {
      name: drawing.name, quad, transform: [a, c, e, b, d, f], tolerance, crs: drawing.crs ?? null,
      paint: flat && { color: flat.color, opacity: flat.opacity }, isMap, hasGradients: false, hasPictures: false, style,
    };
  });
}

/**
 * The texels in rows of an image; the last row is filled with zeros.
 *
 * @param {Sheet[]} sheets
 * @param {number} count of texels
 */
function inRows(sheets, count) {
  const width = Math.min(1 << Math.ceil(Math.log2(count)), 1 << ROW_BITS);
  const height = Math.ceil(count / width);
  const texels = new Uint32Array(4 * width * height);
  let first = 0;
  for (const sheet of sheets) {
    texels.set(sheet.texels, first);
    first += sheet.texels.length;
  }
  return { width, height, texels };
}

/**
 * @param {Sheet[]} sheets
 * @param {boolean} restyle
 * @returns {Note[]}
 */
function notesOf(sheets, restyle) {
  const flattened = sheets.reduce((sum, sheet) => sum + (sheet.flattened ?? 0), 0);
  /** @type {Note[]} */
  const notes = flattened ? [{ kind: 'simplified', message: FLATTENED, count: flattened }] : [];
  const maps = sheets.filter(({ isMap }) => isMap);
  if (maps.length && sheets.length > 1) notes.push({ kind: 'simplified', message: several(sheets.length), count: 1 });
  if (restyle && !sheets.some(({ drawing }) => drawing.paths.some(({ element }) => element))) {
    notes.push({ kind: 'remark', message: 'no element has a name, so none can get another colour', count: 1 });
  }
  return notes;
}
