import { MeshBasicMaterial } from 'three';
import { VextureError, line } from './errors.js';
import { NAMES, checkOptions, complete, withOptions } from './mask-options.js';
import { VectorMask } from './vector-mask.js';

/** @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture */
/** @typedef {import('./mask-options.js').AllOptions} AllOptions */

/**
 * @typedef {object} ShapeParameters
 * @property {VectorTexture | null} [texture] null or omitted: none yet
 * @property {'alpha' | 'paint' | 'cut'} [mode] the shape in `color`, the drawing in its own colours, or the shape in
 *   `color` without blending
 *
 * @typedef {import('three').MeshBasicMaterialParameters & Omit<import('./mask-options.js').MaskOptions,
 *   'mode' | 'color' | 'map'> & ShapeParameters} VectorMaterialParameters
 *
 * @typedef {Omit<AllOptions, 'mode' | 'color' | 'map'> & { mode: 'alpha' | 'paint' | 'cut' }} ShapeOptions
 */

/** What `MeshBasicMaterial` has by the same name is its own. */
const OPTIONS = Object.freeze(NAMES.filter((name) => name !== 'color' && name !== 'map'));

/** What is not the default of `applyVectorMask`. @type {Record<string, unknown>} */
const OWN_DEFAULTS = Object.freeze({ background: 'none' });

/** @type {new () => MeshBasicMaterial & ShapeOptions} */
const WithOptions = withOptions(/** @type {any} */ (MeshBasicMaterial), OPTIONS, 'setValues');

/**
 * An unlit material that shows a shape in one colour, or a drawing in its own colours. Fog, tone mapping, colour space,
 * logarithmic depth, clipping and skinning are those of `MeshBasicMaterial`. Each option is a property, which can be set
 * at any time, also before there is a texture. `applyVectorMask` masks other materials.
 */
export class VectorMaterial extends WithOptions {
  /** @type {VectorMask | null} */
  #mask = null;
  #options = complete(OWN_DEFAULTS, this.type);

  /**
   * @param {VectorMaterialParameters} [parameters]
   * @throws {VextureError} if an option is unknown or out of range, or the texture is undefined
   */
  constructor(parameters = {}) {
    super();
    this.setValues(parameters);
  }

  get isVectorMaterial() {
    return true;
  }

  /** The mask; null without a texture. `mask.attach(mesh)` applies it to shadows and raycasting. */
  get mask() {
    return this.#mask;
  }

  /** The options, as the constructor takes them. */
  get options() {
    return this.#mask?.options ?? this.#options;
  }

  /** @returns {VectorTexture | null} */
  get texture() {
    return this.#mask?.texture ?? null;
  }

  /** The texture; with null the material is a plain `MeshBasicMaterial`. */
  set texture(texture) {
    this.setValues({ texture });
  }

  /**
   * Change several values at once, such as a texture and its root, as the constructor takes them; undefined is the
   * default. After an error the options are as they were.
   *
   * @param {VectorMaterialParameters} [values]
   * @throws {VextureError} if an option is unknown or out of range, or the texture is undefined
   */
  setValues(values) {
    if (values === undefined) return; // three.js's constructor calls it, before there are fields
    const own = /** @type {Record<string, unknown>} */ ({});
    const basic = /** @type {Record<string, unknown>} */ ({});
    for (const [name, value] of Object.entries(values)) {
      if (OPTIONS.includes(name)) own[name] = value === undefined ? OWN_DEFAULTS[name] : value;
      else if (name !== 'texture') basic[name] = value;
      if (!(name in own) && /** @type {any} */ (this)[name] === undefined) {
        throw new VextureError(`VectorMaterial has no option ${line(name)}; correct its name`, name);
      }
    }
    const { texture = 'texture' in values ? undefined : this.texture } = values;
    if (texture === undefined) {
      throw new VextureError('texture is undefined; load one by VectorTextureLoader, or give null for none', 'texture');
    }
    super.setValues(basic);
    this.#change(texture, own);
  }

  /**
   * @param {VectorTexture | null} texture
   * @param {Partial<AllOptions>} changes
   */
  #change(texture, changes) {
    if (texture && this.#mask) this.#mask.set({ texture, ...changes });
    else if (texture) this.#mask = new VectorMask(this, texture, { ...this.#options, ...changes });
    else {
      const options = complete({ ...this.options, ...changes }, this.type);
      checkOptions(options, this.type);
      this.#mask?.remove();
      [this.#mask, this.#options] = [null, options];
    }
  }

  /**
   * @param {MeshBasicMaterial} source
   * @returns {this}
   */
  copy(source) {
    super.copy(source);
    if (source instanceof VectorMaterial) {
      this.#change(null, { ...source.options, transform: source.options.transform.clone() });
      this.transparent = source.#mask ? source.#mask.ownTransparent : source.transparent;
      this.texture = source.texture;
    }
    return this;
  }
}
