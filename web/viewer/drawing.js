// The drawings of a texture, and the one that is shown.
import { mapsAmong } from '../src/select-root.js';
import { drawingOf } from '../src/select-root.js';

/**
 * @typedef {object} ShownDrawing
 * @property {import('../src/vector-texture.js').VectorTexture} texture
 * @property {string} name
 * @property {number} first layer
 * @property {number} count of layers
 * @property {boolean} silhouette whether it is drawn in the theme's ink
 * @property {'none' | 'some' | 'all'} maps whether its layers are planar maps; `all`: it is one map
 * @property {boolean} gradients whether a map holds gradients
 */

/** @typedef {import('../src/data.js').Root} Root */

/**
 * Names of the drawings in a texture, in the order of their first layers.
 *
 * @param {{roots: Root[]}} texture
 */
export function drawingNames(texture) {
  return [...new Set(texture.roots.map(drawingOf))];
}

/** @param {Root} root */
const isBlack = (root) => !root.isMap && (!root.paint || (root.paint.opacity === 1 && root.paint.color.every((part) => part === 0)));

/**
 * The drawing of a name, or the first one if there is no such drawing.
 *
 * @param {import('../src/vector-texture.js').VectorTexture} texture
 * @param {string} name
 * @returns {ShownDrawing}
 */
export function shownDrawing(texture, name) {
  const names = drawingNames(texture);
  const wanted = names.includes(name) ? name : names[0];
  const first = texture.roots.findIndex((root) => drawingOf(root) === wanted);
  let end = first + 1;
  while (end < texture.roots.length && drawingOf(texture.roots[end]) === wanted) end++;
  const count = end - first;
  const layers = texture.roots.slice(first, end);
  const silhouette = count === 1 && isBlack(layers[0]);
  const gradients = layers.some(({ hasGradients }) => hasGradients);
  return { texture, name: wanted, first, count, silhouette, maps: mapsAmong(layers, count === 1), gradients };
}
