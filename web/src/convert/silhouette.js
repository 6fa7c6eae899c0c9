// The texels of a silhouette, by the kernel `silhouette_texels`.
import { VextureError } from '../errors.js';

/** @import { Bounds } from './conversion.js' */
/** @import { Drawing, Path } from './drawing.js' */
/** @import { Kernels } from './kernels.js' */

/** Most quads of a tree, and a limit of work that no drawing within that reaches. */
const MOST_QUADS = 2_000_000;
const UNLIMITED = 2 ** 52;

/** Pieces in a leaf. */
const DEFAULT_CAPACITY = 8;

/** Distance outside the unit square that is mere rounding. */
const CLOSED = 1e-9;

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
  const limits = limitsOf(bounds, DEFAULT_CAPACITY);
  const { texels, outside, quads } = kernels.call('silhouette_texels', [cubics, lengths, path, rules, limits, first, UNLIMITED]);
  checkOutcome(drawing.name, outside, quads);
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

/**
 * The limits in the order of Python's `Bounds`.
 *
 * @param {Bounds} bounds
 * @param {number} usual capacity
 */
export function limitsOf({ capacity, tolerance, near, leastDepth, maxDepth }, usual) {
  return [capacity ?? usual, tolerance, near, leastDepth, maxDepth, MOST_QUADS];
}

/**
 * @param {string} name
 * @param {number} outside distance
 * @param {number} quads
 * @throws {VextureError} if a kernel has given up
 */
export function checkOutcome(name, outside, quads) {
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
