// The texels of a silhouette, by the kernel `silhouette_texels`.
import { VextureError } from '../errors.js';
import { overtime as lateness } from './pace.js';

/** @import { Bounds } from './conversion.js' */
/** @import { Drawing, Path } from './drawing.js' */
/** @import { Kernels } from './kernels.js' */

/** Work that a kernel does in a second, in the units of its limit, on a slow machine. */
const WORK = 1e6;

/**
 * Make the texels of a drawing's silhouette.
 *
 * @param {Kernels} kernels
 * @param {Drawing} drawing
 * @param {Bounds} bounds
 * @param {number} first index of its first texel
 * @returns {Uint32Array}
 * @throws {VextureError} if it leaves the unit square, or its tree is too large
 */
export function silhouetteOf(kernels, drawing, bounds, first) {
  const { cubics, lengths, path, rules } = outlinesOf(drawing.paths);
  const { constants } = kernels;
  const limits = limitsOf(bounds, constants.CAPACITY, constants);
  const { texels, outside, quads } = kernels.call('silhouette_texels', [cubics, lengths, path, rules, limits, first, workOf(bounds)]);
  checkOutcome(drawing.name, outside, quads, constants);
  if (!texels.length) throw overtime(drawing.name, bounds);
  return texels;
}

/**
 * The outlines of paths as arrays.
 *
 * @param {readonly Path[]} paths
 */
export function outlinesOf(paths) {
  const contours = paths.flatMap((path) => path.contours);
  const cubics = new Float64Array(contours.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const contour of contours) {
    cubics.set(contour, at);
    at += contour.length;
  }
  return {
    cubics,
    lengths: contours.map(({ length }) => length / 8),
    path: paths.flatMap(({ contours: own }, k) => own.map(() => k)),
    rules: paths.map(({ fillRule }) => fillRule),
  };
}

/** @typedef {Kernels['constants']} Constants */

/**
 * The limits in the order of Python's `Bounds`.
 *
 * @param {Bounds} bounds
 * @param {number} usual capacity
 * @param {Constants} constants
 */
export function limitsOf({ capacity, tolerance, near, leastDepth, maxDepth }, usual, { MOST_QUADS }) {
  return [capacity ?? usual, tolerance, near, leastDepth, maxDepth, MOST_QUADS];
}

/**
 * The limit of work of a kernel, which has no clock.
 *
 * @param {Bounds} bounds
 */
export const workOf = ({ maxSeconds }) => Math.ceil(Math.min(WORK * maxSeconds, Number.MAX_SAFE_INTEGER));

/**
 * The error of a kernel that has reached its limit of work.
 *
 * @param {string} name
 * @param {Pick<Bounds, 'maxSeconds'>} bounds
 */
export function overtime(name, { maxSeconds }) {
  return lateness('converting', maxSeconds).in(name);
}

/**
 * @param {string} name
 * @param {number} outside distance
 * @param {number} quads
 * @param {Constants} constants
 * @throws {VextureError} if a kernel has given up
 */
export function checkOutcome(name, outside, quads, { CLOSED, MOST_QUADS }) {
  if (!(outside <= CLOSED)) { // NaN counts as outside
    throw new VextureError(`${name}: a curve leaves the unit square by ${outside}; clip or scale it first`, 'contours');
  }
  if (quads > MOST_QUADS) {
    throw new VextureError(
      `${name}: ${quads} quads at least; the limit is ${MOST_QUADS}; use a smaller \`maxDepth\`, a larger \`tolerance\` or a ` +
        'larger `precision`',
      'quads',
    );
  }
}
