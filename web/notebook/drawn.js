/** What of a texture a stage draws, and what is at a point of it. Plain data. */
import { gradientsAmong, mapsAmong } from '../src/select-root.js';

/**
 * @typedef {{ first: number, count: number }} Range of roots
 * @typedef {'paint' | 'silhouette'} Mode
 * @typedef {import('../src/vector-texture.js').VectorTexture} VectorTexture
 * @typedef {{ root: string, element: string | null }} Found
 */

/**
 * @param {VectorTexture} texture
 * @param {Range} range
 * @param {Mode} mode
 * @returns {import('../viewer/drawing.js').ShownDrawing}
 */
export function drawnOf(texture, { first, count }, mode) {
  const layers = texture.roots.slice(first, first + count);
  const gradients = gradientsAmong(layers);
  const maps = mapsAmong(layers, count === 1);
  return { texture, name: layers[0].name, first, count, silhouette: mode === 'silhouette', maps, gradients };
}

/**
 * The topmost shape at a point of the unit square, and its topmost element if that has a name; null where nothing is.
 *
 * @param {VectorTexture} texture
 * @param {Range} range
 * @param {number} u
 * @param {number} v upwards
 * @returns {Found | null}
 */
export function foundAt(texture, { first, count }, u, v) {
  for (let place = first + count - 1; place >= first; place--) {
    if (!texture.contains(u, v, place)) continue;
    const { name, style } = texture.roots[place];
    return { root: name, element: (style && texture.elementAt(u, v, place)?.name) || null };
  }
  return null;
}
