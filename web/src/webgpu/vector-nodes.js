import { attribute, nodeObject, texture as textureNode, uniform, uv as meshUv, varying, vec2 } from 'three/tsl';
import { VextureError } from '../errors.js';
import { ROOT_ATTRIBUTE } from '../root-attribute.js';
import { mapsAmong, shapeIndex } from '../select-root.js';
import { ShapeNode } from './shape-node.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('three/webgpu').Node} Node */

/**
 * @typedef {object} ShapeOptions
 * @property {string | number | Node | null} [root] name or place of the shape, or a node of a place, as `instancedRoot`
 * @property {Node} [uv] position in the unit square, by default the mesh's uv
 * @property {Node | null} [dx] step of the position to the next pixel; needed if the position jumps
 * @property {Node | null} [dy]
 * @property {'none' | 'clamp' | 'repeat'} [wrap] beyond the unit square: nothing, the value at its border, or the shape
 *   again
 * @property {boolean} [flat] for views straight at a plane, in which pixels are upright in the drawing and all alike: they
 *   cost less
 * @property {import('../fold-texture.js').FoldTexture | null} [fold] moves the shape with time
 * @property {() => number} [time] seconds of the fold, read in every frame
 *
 * @typedef {ShapeOptions & { linear?: boolean }} ColorOptions `linear`: average the colours of a pixel in linear light, as
 *   light mixes, or in sRGB, as browsers do
 */

/** The shape of each instance, from its attribute `vextureRoot` (see `rootAttribute`). */
export const instancedRoot = () => varying(/** @type {any} */ (attribute(ROOT_ATTRIBUTE, 'uint')));

/**
 * A node of a texture of words, which follows whatever replaces it. WebGPU takes `internalFormat` for the name of a
 * format of its own.
 *
 * @param {() => import('three').DataTexture} current
 */
function wordsNode(current) {
  const plain = () => {
    const texture = current();
    texture.internalFormat = null;
    return texture;
  };
  const node = /** @type {any} */ (textureNode(plain()));
  node.onRenderUpdate(() => {
    node.value = plain();
  });
  return node;
}

/**
 * A uniform that is read in every frame.
 *
 * @param {() => number} current
 * @param {'uint' | 'int' | 'float'} type
 */
function uniformNode(current, type) {
  const node = /** @type {any} */ (uniform)(current(), type);
  return node.onRenderUpdate(() => current());
}

/**
 * @param {'coverage' | 'colour'} what
 * @param {VectorTexture} texture
 * @param {ColorOptions} options
 */
function shapeNode(what, texture, options) {
  const { root = null, uv = meshUv(), dx = null, dy = null, wrap = 'none', flat = false, fold = null } = options;
  if (!texture?.isVectorTexture || texture.encoding !== 'packed') {
    throw new VextureError('the texture must be a VectorTexture; load one by VectorTextureLoader', 'texture');
  }
  const isNode = /** @type {any} */ (root)?.isNode === true;
  const chosen = /** @type {string | number | null} */ (isNode ? null : root);
  const found = () => {
    if (isNode) return { first: 0, count: 1 };
    return what === 'colour' ? texture.layersOf(chosen) : { first: shapeIndex(texture, chosen, ''), count: 1 };
  };
  const range = found();
  const isAlone = isNode || range.count === 1;
  const shown = isNode ? texture.roots : texture.roots.slice(range.first, range.first + range.count);
  const maps = mapsAmong(shown, isAlone);
  const colours = maps !== 'none';
  const variant = {
    colours,
    gradients: colours && shown.some(({ hasGradients }) => hasGradients),
    linear: colours && isAlone && options.linear === true,
    wrap,
    flat: flat && !fold,
    fold: fold !== null,
  };
  const inputs = {
    texels: wordsNode(() => texture.textures.texels),
    paints: wordsNode(() => texture.textures.layers),
    instance: isNode ? root : null,
    quad: uniformNode(() => texture.roots[found().first].quad, 'uint'),
    first: uniformNode(() => found().first, 'int'),
    count: uniformNode(() => found().count, 'int'),
    uv: vec2(/** @type {any} */ (uv)).toVar(),
    dx,
    dy,
    fold: fold && {
      texels: wordsNode(() => fold.texture),
      time: uniformNode(() => fold.clock(options.time?.() ?? 0), 'float'),
      cycle: uniformNode(() => fold.cycle, 'float'),
    },
  };
  const node = nodeObject(new ShapeNode(what, variant, maps !== 'all', /** @type {any} */ (inputs)));
  return /** @type {any} */ (node).toVar();
}

/**
 * Coverage of the pixel by a shape, 0..1, of a drawing in colours its opacity: a float node. As `opacityNode` it shows the
 * shape, `maskNode = coverage.greaterThan(0.5)` cuts a material, and `mix(a, b, coverage)` colours it.
 *
 * @param {VectorTexture} texture
 * @param {ShapeOptions} [options]
 * @returns {Node}
 * @throws {VextureError} if the root is unknown or ambiguous
 */
export function vectorCoverage(texture, options = {}) {
  return shapeNode('coverage', texture, options);
}

/**
 * Colour of a drawing in the pixel: a vec4 node, straight and linear, as three.js's colours are.
 *
 * @param {VectorTexture} texture
 * @param {ColorOptions} [options]
 * @returns {Node}
 * @throws {VextureError} if the root is unknown or ambiguous
 */
export function vectorColor(texture, options = {}) {
  return shapeNode('colour', texture, options);
}
