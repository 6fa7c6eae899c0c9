// What a node of a shape reads, as nodes that follow what they stand for.
import { nodeObject, texture as textureNode, uniform, vec2 } from 'three/tsl';
import { gradientsAmong, mapsAmong, mapsOfGlyphs } from '../select-root.js';
import { ShapeNode } from './shape-node.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('three/webgpu').Node} Node */
/** @typedef {{ first: number, count: number }} Range */

/**
 * @typedef {object} Shape
 * @property {Node} uv
 * @property {Node | null} dx
 * @property {Node | null} dy
 * @property {Node | null} instance place of an instance's root
 * @property {string | null} [glyphs] mode of a mesh of glyphs, which shows either those in one colour, or those in their own
 * @property {() => Range} range of the shape or the drawing's layers in the texture's roots
 * @property {'none' | 'clamp' | 'repeat'} [wrap]
 * @property {boolean} [flat]
 * @property {boolean} [linear]
 * @property {import('../fold-texture.js').FoldTexture | null} [fold]
 * @property {() => number} time
 * @property {(builder: any) => void} [onBuild] called when a program is built, for an object and its geometry
 */

/**
 * A node of a texture of words, which follows whatever replaces it. WebGPU takes `internalFormat` for the name of a
 * format of its own.
 *
 * @param {() => import('three').DataTexture} current
 */
export function wordsNode(current) {
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
 * What makes the text of one shape differ from that of another.
 *
 * @param {VectorTexture} texture
 * @param {Pick<Shape, 'instance' | 'wrap' | 'flat' | 'linear' | 'fold' | 'glyphs'>} options
 * @param {Range} range
 * @returns {{ variant: import('./shader-text.js').NodeVariant, isSheets: boolean }}
 */
export function nodeVariant(texture, { instance, wrap = 'none', flat = false, linear = false, fold = null, glyphs = null }, range) {
  const isAlone = instance !== null || range.count === 1;
  const shown = instance ? texture.roots : texture.roots.slice(range.first, range.first + range.count);
  const maps = glyphs ? mapsOfGlyphs(glyphs) : mapsAmong(shown, isAlone);
  const colours = maps !== 'none';
  const variant = {
    colours,
    gradients: colours ? gradientsAmong(shown) : 0,
    linear: colours && isAlone && linear, // layers are composited in sRGB, as in browsers
    wrap,
    flat: flat && !fold,
    fold: fold !== null,
  };
  return { variant, isSheets: maps !== 'all' };
}

/**
 * A node of a shape, and what lets it follow other data of its texture.
 *
 * @param {'coverage' | 'colour'} what
 * @param {VectorTexture} texture
 * @param {Shape} shape
 * @returns {{ node: any, follow: () => void }}
 */
export function livingShapeNode(what, texture, shape) {
  const { uv, dx, dy, instance, range, fold = null, time, onBuild } = shape;
  const { variant, isSheets } = nodeVariant(texture, shape, range());
  const inputs = {
    texels: wordsNode(() => texture.textures.texels),
    paints: wordsNode(() => texture.textures.layers),
    instance,
    quad: uniformNode(() => texture.roots[range().first]?.quad ?? 0, 'uint'),
    first: uniformNode(() => range().first, 'int'),
    count: uniformNode(() => range().count, 'int'),
    uv: /** @type {any} */ (vec2(/** @type {any} */ (uv))).toVar(),
    dx,
    dy,
    fold: fold && {
      texels: wordsNode(() => fold.texture),
      time: uniformNode(() => fold.clock(time()), 'float'),
      cycle: uniformNode(() => fold.cycle, 'float'),
    },
  };
  const made = new ShapeNode(what, variant, isSheets, /** @type {any} */ (inputs), onBuild);
  const follow = () => {
    const now = nodeVariant(texture, shape, range());
    made.become(now.variant, now.isSheets);
  };
  return { node: /** @type {any} */ (nodeObject(made)).toVar(), follow };
}

/**
 * @param {'coverage' | 'colour'} what
 * @param {VectorTexture} texture
 * @param {Shape} shape
 * @returns {any}
 */
export function shapeNode(what, texture, shape) {
  return livingShapeNode(what, texture, shape).node;
}
