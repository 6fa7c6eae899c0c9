// Finds the topmost element of a drawing at a point. Plain data, without three.js.
import { mapParts } from './maps.js';

/**
 * @typedef {object} FoundElement An element of a drawing at a point.
 * @property {string} name of the element; it may be empty
 * @property {number} element its index in the `style` of its root
 * @property {number} root index of the root
 */

/**
 * Find the topmost element of layers and maps at a point of the unit square; null if there is none.
 *
 * @param {import('./data.js').PackedData} data
 * @param {number} first root
 * @param {number} count of roots, in painting order
 * @param {number} u
 * @param {number} v upwards
 * @returns {FoundElement | null}
 */
export function elementAt(data, first, count, u, v) {
  for (let root = first + count - 1; root >= first; root--) {
    const element = data.roots[root].style && mapParts().topmostAt(data, data.roots[root], u, v);
    if (element) return { ...element, root };
  }
  return null;
}
