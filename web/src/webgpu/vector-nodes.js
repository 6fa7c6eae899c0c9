import { attribute, uv as meshUv, varying } from 'three/tsl';
import { ROOT_ATTRIBUTE } from '../attributes.js';
import { givenOptions, unfit } from '../errors.js';
import { checkNodeOptions } from '../mask-options.js';
import { shapeIndex } from '../select-root.js';
import { livingShapeNode } from './shape-inputs.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */

/**
 * @typedef {object} ShapeOptions What a node shows of a texture, and where.
 * @property {string | number | import('three/webgpu').Node | null} [root] name or place of the shape, or a node of a place, as `instancedRoot`
 * @property {import('three/webgpu').Node} [uv] position in the unit square, by default the mesh's uv
 * @property {import('three/webgpu').Node | null} [dx] step of the position to the next pixel; needed if the position jumps
 * @property {import('three/webgpu').Node | null} [dy] step to the next row of pixels
 * @property {'none' | 'clamp' | 'repeat'} [wrap] beyond the unit square: nothing, the value at its border, or the shape
 *   again
 * @property {boolean} [flat] for views straight at a plane, in which pixels are upright in the drawing and all alike: they
 *   cost less
 * @property {import('../fold-texture.js').FoldTexture | null} [fold] moves the shape with time
 * @property {() => number} [time] seconds of the fold, read in every frame
 *
 * @typedef {ShapeOptions & { linear?: boolean }} ColorOptions `linear`: average the colours of a pixel in linear light, as
 *   light mixes, and not in sRGB, as browsers do
 */

/** @type {readonly string[]} */
const OPTIONS = Object.freeze(['root', 'uv', 'dx', 'dy', 'wrap', 'flat', 'fold', 'time', 'linear']);

/** The shape of each instance, from its attribute `vextureRoot` (see `rootAttribute`), as a node. */
export const instancedRoot = () => varying(/** @type {any} */ (attribute(ROOT_ATTRIBUTE, 'uint')));

/**
 * @param {'coverage' | 'colour'} what
 * @param {VectorTexture} texture
 * @param {ColorOptions} [options]
 */
function nodeOf(what, texture, options) {
  const given = givenOptions(options);
  checkNodeOptions(given, OPTIONS);
  const { root = null, uv = meshUv(), time = () => 0, ...others } = given;
  if (!texture?.isVectorTexture || texture.encoding !== 'packed') throw unfit('texture', texture, 'load one by VectorTextureLoader');
  const isNode = /** @type {any} */ (root)?.isNode === true;
  const chosen = /** @type {string | number | null} */ (root);
  const find = () => {
    if (isNode) return { first: 0, count: 1 };
    return what === 'colour' ? texture.layersOf(chosen) : { first: shapeIndex(texture, chosen, ''), count: 1 };
  };
  let range = find();
  const follow = () => {
    try {
      range = find();
    } catch (error) { // new data lack the root: what has its place is shown, with a note
      texture.dispatchEvent({ type: 'note', message: String(/** @type {Error} */ (error).message) });
      range = { first: 0, count: 1 };
    }
    made.follow();
  };
  const instance = isNode ? /** @type {import('three/webgpu').Node} */ (root) : null;
  const made = livingShapeNode(what, texture, { dx: null, dy: null, ...others, uv, time, instance, range: () => range });
  texture.addEventListener('change', follow);
  return made.node;
}

/**
 * Coverage of the pixel by a shape, 0..1, of a drawing in colours its opacity: a float node. As `opacityNode` it shows the
 * shape, `maskNode = coverage.greaterThan(0.5)` cuts a material, and `mix(a, b, coverage)` colours it.
 *
 * @param {VectorTexture} texture
 * @param {ShapeOptions} [options]
 * @returns {any} a node, of whose methods three.js's types know few
 * @throws {VextureError} if an option is out of range, or the root is unknown or ambiguous
 */
export function vectorCoverage(texture, options) {
  return nodeOf('coverage', texture, options);
}

/**
 * Colour of a drawing in the pixel: a vec4 node, straight and linear, as three.js's colours are.
 *
 * @param {VectorTexture} texture
 * @param {ColorOptions} [options]
 * @returns {any} a node, of whose methods three.js's types know few
 * @throws {VextureError} if an option is out of range, or the root is unknown or ambiguous
 */
export function vectorColor(texture, options) {
  return nodeOf('colour', texture, options);
}
