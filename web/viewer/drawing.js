// The drawings of a texture, and the one that is shown.
import { gradientsAmong, mapsAmong } from '../src/select-root.js';
import { drawingOf } from '../src/select-root.js';

/**
 * @typedef {object} ShownDrawing
 * @property {import('../src/vector-texture.js').VectorTexture} texture
 * @property {string} name
 * @property {number} first layer
 * @property {number} count of layers
 * @property {boolean} silhouette whether it is one black shape
 * @property {'none' | 'some' | 'all'} maps whether its layers are planar maps; `all`: it is one map
 * @property {0 | 1 | 2} gradients whether maps hold gradients (1) or pictures as well (2)
 */

/** @typedef {import('../src/data.js').Root} Root */

/**
 * @typedef {object} Range of layers
 * @property {string} name of their drawing
 * @property {number} first
 * @property {number} count
 */

/**
 * The drawings in a texture, in the order of their first layers.
 *
 * @param {{roots: Root[]}} texture
 * @returns {Range[]}
 */
export function drawingsIn({ roots }) {
  /** @type {Map<string, Range>} */
  const found = new Map();
  let before = '';
  roots.forEach((root, place) => {
    const name = drawingOf(root);
    const range = found.get(name);
    if (!range) found.set(name, { name, first: place, count: 1 });
    else if (name === before) range.count = place - range.first + 1;
    before = name;
  });
  return [...found.values()];
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
  const all = drawingsIn(texture);
  return drawingOfRange(texture, all.find((one) => one.name === name) ?? all[0]);
}

/**
 * @param {import('../src/vector-texture.js').VectorTexture} texture
 * @param {Range} range
 * @returns {ShownDrawing}
 */
export function drawingOfRange(texture, { name, first, count }) {
  const layers = texture.roots.slice(first, first + count);
  const silhouette = count === 1 && isBlack(layers[0]);
  return { texture, name, first, count, silhouette, maps: mapsAmong(layers, count === 1), gradients: gradientsAmong(layers) };
}
