/**
 * Which layers of a texture are seen.
 *
 * @typedef {object} ShownDrawing
 * @property {import('../src/vector-texture.js').VectorTexture} texture a packed one
 * @property {string} name
 * @property {number} first layer
 * @property {number} count of layers
 * @property {boolean} silhouette whether it is drawn in the theme's ink
 */

/** @typedef {import('../src/data.js').Root} Root */

/**
 * Name of the drawing that a root is, or is a layer of.
 *
 * @param {Root} root
 */
function owner(root) {
  const end = root.paint ? root.name.lastIndexOf('/') : -1;
  return end > 0 ? root.name.slice(0, end) : root.name;
}

/**
 * Names of the drawings in a texture, in the order of their first layers.
 *
 * @param {{roots: Root[]}} texture
 */
export function drawingNames(texture) {
  return [...new Set(texture.roots.map(owner))];
}

/** @param {Root} root */
const isBlack = (root) => !root.paint || (root.paint.opacity === 1 && root.paint.color.every((part) => part === 0));

/**
 * The drawing of a name, or the first one if there is none of it.
 *
 * @param {import('../src/vector-texture.js').VectorTexture} texture
 * @param {string} name
 * @returns {ShownDrawing}
 */
export function shownDrawing(texture, name) {
  const names = drawingNames(texture);
  const wanted = names.includes(name) ? name : names[0];
  const first = texture.roots.findIndex((root) => owner(root) === wanted);
  let end = first + 1;
  while (end < texture.roots.length && owner(texture.roots[end]) === wanted) end++;
  const count = end - first;
  return { texture, name: wanted, first, count, silhouette: count === 1 && isBlack(texture.roots[first]) };
}
