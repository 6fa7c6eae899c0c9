// Drawings of contours: the form of every source, the same as Python's `vexture.drawing.drawing.Drawing`.
import { VextureError, line } from '../errors.js';
import { boundsOf, loopOf } from './contours.js';
import { atOnce } from './pace.js';
import { BLACK } from './paints.js';
import { inUnitSquare } from './unit-square.js';

/**
 * @typedef {import('./painter.js').Path} Path
 * @typedef {import('./veils.js').Group} Group
 * @typedef {import('./notes.js').Note} Note
 * @typedef {import('./affine.js').Affine} Affine
 * @typedef {import('./paints.js').Paint} Paint
 */

/**
 * @typedef {object} Drawing Painted paths in the unit square, y up, in painting order.
 * @property {string} name of the shape
 * @property {Path[]} paths each with one paint
 * @property {Group[]} groups each after the group around it
 * @property {Affine} toSource from the unit square to the units of the source
 * @property {[number, number]} sides width and height of the box, which is centred; the longer side is 1
 * @property {Note[]} notes everything left out, simplified or invalid
 * @property {string | null} [crs] coordinate reference system of the source's units
 *
 * @typedef {readonly [number, number, number, number]} Box least x and y, width and height
 *
 * @typedef {object} Shape A shape in the units of its source, y down.
 * @property {readonly ArrayLike<number>[]} contours each 8 numbers for each cubic: x and y of P0 to P3
 * @property {'nonzero' | 'evenodd'} [fillRule] `nonzero` by default
 * @property {[number, number, number]} [color] sRGB components, 0..1; black by default
 * @property {number} [opacity] 0..1; 1 by default
 * @property {string} [element] its name, for `setPaints` and `elementAt`
 */

export const NONZERO = 0;
export const EVENODD = 1;

/**
 * Make a drawing of shapes: outlines of a font, of a chart, or of any other source.
 *
 * @param {readonly Shape[]} shapes in painting order
 * @param {{ name?: string, box?: Box }} [options] `box` is the part that is shown; by default the bounding box
 * @returns {Drawing}
 * @throws {VextureError} if a contour has a coordinate that is not finite, or there is nothing to show
 */
export function fromContours(shapes, { name = 'drawing', box } = {}) {
  const paths = shapes.map(({ contours, fillRule = 'nonzero', color = BLACK.color, opacity = 1, element = '' }) => ({
    contours: contours.map(closed),
    fillRule: fillRule === 'evenodd' ? EVENODD : NONZERO,
    paint: { color, opacity, gradient: null },
    group: -1,
    element,
  }));
  const all = paths.flatMap(({ contours }) => contours);
  if (!all.length) throw new VextureError(`${name}: no contours; give at least one`, 'contours');
  return fromSource(paths, box ?? boxOf(all), name);
}

/**
 * Bring the paths of a source into the normal form.
 *
 * @param {Path[]} paths in the units of the source, y down
 * @param {Box} box the part that is shown
 * @param {string} name
 * @returns {Drawing}
 */
export const fromSource = (paths, box, name) => atOnce(fitSource(paths, box, name));

/**
 * Bring the paths of a source into the normal form, in steps.
 *
 * @param {Path[]} paths
 * @param {Box} box
 * @param {string} name
 * @param {import('./pace.js').Pace} [pace]
 * @returns {import('./pace.js').Steps<Drawing>}
 */
export function* fitSource(paths, [x, y, width, height], name, pace) {
  const moved = [];
  for (const path of paths) {
    if (pace?.isDue()) yield;
    moved.push({ ...path, contours: path.contours.map((contour) => contour.map((value, k) => value - (k % 2 ? y : x))) });
  }
  const { paths: normal, toSource: [a, b, c, d, e, f], sides } = yield* inUnitSquare(moved, [width, height], pace);
  return { name, paths: normal, groups: [], toSource: [a, b, c, d, x + e, y + f], sides, notes: [], crs: null };
}

/** @param {readonly Float64Array[]} contours @returns {Box} */
export function boxOf(contours) {
  const [left, top, right, bottom] = boundsOf(contours);
  return [left, top, right - left, bottom - top];
}

/** @param {ArrayLike<number>} cubics */
function closed(cubics) {
  const contour = Float64Array.from(cubics);
  if (!contour.length || contour.length % 8 || !contour.every(Number.isFinite)) {
    throw new VextureError(`a contour of ${line(contour.length)} numbers; it must be 8 finite numbers for each cubic, one or more`, 'contours');
  }
  for (let k = 8; k < contour.length; k += 8) {
    if (contour[k] !== contour[k - 2] || contour[k + 1] !== contour[k - 1]) {
      throw new VextureError(`cubic ${k / 8} of a contour does not start where the one before it ends; close the gap`, 'contours');
    }
  }
  return loopOf({ cubics: contour, closed: true });
}
