// What a mask shows: a shape or a drawing of a texture, and what of it lies at a point.
import { elementAt } from './element-at.js';
import { VextureError, givenOptions, unfit } from './errors.js';
import { lookedUp } from './mask-lookup.js';
import { checkOptions, checkTexture, complete, isTranslucent } from './mask-options.js';
import { ROOT_ATTRIBUTE } from './attributes.js';
import { shapeIndex } from './select-root.js';

/** @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture */
/** @typedef {import('./mask-options.js').MaskOptions} MaskOptions */
/** @typedef {import('./mask-options.js').AllOptions} AllOptions */

/** @param {AllOptions} options */
const hasNoRoot = ({ instanced, root }) => instanced && (root ?? null) === null;

/**
 * The options with a mode: without one a drawing is shown in its colours, if it has any.
 *
 * @param {VectorTexture} texture
 * @param {AllOptions} options
 * @returns {import('./mask-options.js').ShownOptions}
 */
function withMode(texture, options) {
  const { mode, root, instanced, invert } = options;
  if (mode !== null) return /** @type {any} */ (options);
  const isWhole = instanced || (root ?? null) === null || texture.encoding !== 'packed';
  const { first, count } = isWhole ? { first: 0, count: texture.roots.length } : texture.layersOf(root);
  const hasColors = texture.roots.slice(first, first + count).some(({ paint, isMap }) => paint || isMap);
  return { ...options, mode: hasColors && !invert ? 'paint' : 'alpha' };
}

/**
 * Place of the shape, or the drawing's layers, in a texture.
 *
 * @param {VectorTexture} texture
 * @param {AllOptions} options
 * @returns {{ first: number, count: number }}
 */
function rangeOf(texture, options) {
  const { root, mode } = options;
  if (hasNoRoot(options)) return { first: 0, count: 1 }; // the shader does not read it
  if (mode === 'paint' && texture.encoding === 'packed') return texture.layersOf(root);
  const isPainted = texture.roots.some(({ paint }) => paint);
  return { first: shapeIndex(texture, root, isPainted ? ", or use mode: 'paint'" : ''), count: 1 };
}

/** A texture with the options of a mask, checked. */
export class ShownShape {
  /**
   * @param {VectorTexture} texture
   * @param {MaskOptions} options
   * @param {string} type of the material
   * @throws {VextureError} if an option is out of range, options exclude each other, or the root is unknown or ambiguous
   */
  constructor(texture, options, type) {
    this.texture = texture;
    this.given = complete(givenOptions(options), type);
    this.type = type;
    checkOptions(this.given, type);
    checkTexture(texture, this.given);
    this.options = withMode(texture, this.given);
    this.range = rangeOf(texture, this.options);
  }

  /** @param {number} time */
  setTime(time) {
    this.given.time = time;
    this.options.time = time;
  }

  /** Find the root again in new data; where they lack it, the first shape is shown, with a note. */
  follow() {
    try {
      this.options = withMode(this.texture, this.given);
      this.range = rangeOf(this.texture, this.options);
    } catch (error) {
      if (!(error instanceof VextureError)) throw error;
      this.range = { first: 0, count: 1 };
      this.texture.dispatchEvent({ type: 'note', message: error.message });
    }
  }

  /**
   * The same with other options.
   *
   * @param {MaskOptions & { texture?: VectorTexture }} given
   */
  with(given) {
    const { texture = this.texture, ...changes } = givenOptions(given, 'changes');
    return new ShownShape(texture, { ...this.given, ...changes }, this.type);
  }

  /** Whether light and rays pass outside the shape. */
  get cuts() {
    return this.options.mode === 'cut' || isTranslucent(this.options);
  }

  /**
   * Place of an instance's root; undefined where instances have none of their own.
   *
   * @param {import('./ray-mesh.js').Masked} mesh
   * @param {number} [instance]
   */
  rootOf(mesh, instance = 0) {
    return this.options.instanced ? mesh.geometry.getAttribute(ROOT_ATTRIBUTE)?.getX(instance) : undefined;
  }

  /**
   * @param {number} u
   * @param {number} v
   * @param {number} [root]
   * @returns {boolean}
   */
  hits(u, v, root) {
    const { mode, background, invert } = this.options;
    if (mode === 'mix' || (mode === 'paint' && background === 'own')) return true;
    const own = hasNoRoot(this.options) && root === undefined ? this.texture.index() : root;
    const { x, y } = lookedUp(u, v, this.options);
    const first = own ?? this.range.first;
    const end = own === undefined ? first + this.range.count : own + 1;
    for (let shape = first; shape < end; shape++) {
      if (this.texture.contains(x, y, shape)) return !invert;
    }
    return invert;
  }

  /**
   * @param {number} u
   * @param {number} v
   * @param {number} [root]
   * @returns {import('./element-at.js').FoundElement | null}
   */
  elementAt(u, v, root) {
    const { data } = this.texture;
    if (data.encoding !== 'packed' || (hasNoRoot(this.options) && root === undefined)) return null;
    const { first, count } = root === undefined ? this.range : { first: root, count: 1 };
    const { x, y } = lookedUp(u, v, this.options);
    return elementAt(/** @type {import('./data.js').PackedData} */ (data), first, count, x, y);
  }
}

/**
 * @param {import('./ray-mesh.js').Masked} mesh
 * @param {import('three').Material} material
 */
export const isOn = (mesh, material) => [mesh.material].flat().includes(material);

/**
 * @param {import('./ray-mesh.js').Masked} mesh
 * @param {import('three').Material} material
 * @param {AllOptions} options
 * @throws {VextureError} if a mesh cannot be attached to the mask of a material
 */
export function checkMesh(mesh, material, { instanced }) {
  if (!mesh?.isObject3D) throw unfit('mesh', mesh, 'give the mesh that has this material');
  if (!isOn(mesh, material)) {
    throw new VextureError(`${mesh.name || mesh.type} has another material; give it this one first`, 'mesh');
  }
  if (instanced && !mesh.geometry.getAttribute(ROOT_ATTRIBUTE)) {
    throw new VextureError(
      `${mesh.name || mesh.type} has no attribute ${ROOT_ATTRIBUTE}; make it by rootAttribute(texture, names)`,
      ROOT_ATTRIBUTE,
    );
  }
}
