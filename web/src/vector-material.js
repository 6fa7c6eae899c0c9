import { MeshBasicMaterial } from 'three';
import { VextureError, line } from './errors.js';
import { VectorMask } from './vector-mask.js';

/** @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture */

/**
 * @typedef {object} ShapeParameters
 * @property {VectorTexture | null} [texture] null or omitted: none yet
 * @property {'alpha' | 'paint' | 'cut'} [mode] the shape in `color`, the drawing in its own colours, or the shape in
 *   `color` without blending
 *
 * @typedef {import('three').MeshBasicMaterialParameters & Omit<import('./mask-options.js').MaskOptions,
 *   'mode' | 'color' | 'map'> & ShapeParameters} VectorMaterialParameters
 */

/**
 * An unlit material that shows a shape in one colour, or a drawing in its own colours. Fog, tone mapping, colour space,
 * logarithmic depth, clipping and skinning are those of `MeshBasicMaterial`. `applyVectorMask` masks other materials.
 */
export class VectorMaterial extends MeshBasicMaterial {
  /** @type {VectorMask | null} */
  #mask = null;
  /** @type {import('./mask-options.js').MaskOptions} */
  #options = {};

  /**
   * @param {VectorMaterialParameters} [parameters]
   * @throws {VextureError} if an option is unknown or out of range, or the texture is undefined
   */
  constructor(parameters = {}) {
    const { texture, root, transform, mode, wrap, flat, invert, threshold, background, instanced, ...others } =
      parameters;
    const { fold, time, linear, ...basic } = others;
    super();
    for (const name of Object.keys(basic)) {
      if (/** @type {any} */ (this)[name] !== undefined) continue;
      throw new VextureError(`VectorMaterial has no option ${line(name)}; correct its name`, name);
    }
    if ('texture' in parameters && texture === undefined) {
      throw new VextureError('texture is undefined; load one by VectorTextureLoader, or give null for none', 'texture');
    }
    this.setValues(basic);
    this.#options = { root, transform, mode, wrap, flat, invert, threshold, instanced, fold, time, linear };
    this.#options.background = background ?? 'none';
    if (texture) this.texture = texture;
  }

  get isVectorMaterial() {
    return true;
  }

  /** The mask with all options; null without a texture. `mask.attach(mesh)` applies it to shadows and raycasting. */
  get mask() {
    return this.#mask;
  }

  /** @returns {VectorTexture | null} */
  get texture() {
    return this.#mask?.texture ?? null;
  }

  /** The texture; with null the material is a plain `MeshBasicMaterial`. */
  set texture(texture) {
    if (texture === null) {
      if (this.#mask) this.#options = this.#mask.options;
      this.#mask?.remove();
      this.#mask = null;
    } else if (this.#mask) {
      this.#mask.texture = texture;
    } else {
      this.#mask = new VectorMask(this, texture, this.#options);
    }
  }

  /** @returns {string | number | null | undefined} */
  get root() {
    return this.#mask ? this.#mask.root : this.#options.root;
  }

  set root(root) {
    if (this.#mask) this.#mask.root = root;
    else this.#options.root = root;
  }

  /**
   * @param {MeshBasicMaterial} source
   * @returns {this}
   */
  copy(source) {
    super.copy(source);
    if (source instanceof VectorMaterial) {
      this.texture = null;
      this.#options = source.#mask ? source.#mask.options : { ...source.#options };
      this.#options.transform = this.#options.transform?.clone();
      this.transparent = source.#mask ? source.#mask.ownTransparent : source.transparent;
      this.texture = source.texture;
    }
    return this;
  }
}
