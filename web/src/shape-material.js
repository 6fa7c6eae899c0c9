// What the unlit materials of all renderers have in common: options that are properties, and a mask once there is a texture.
import { Color } from 'three';
import { VextureError, line, givenOptions, unfit } from './errors.js';
import { NAMES, checkOptions, complete, withOptions } from './mask-options.js';

/** @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture */
/** @typedef {import('./mask-options.js').AllOptions} AllOptions */

/**
 * @typedef {object} ShapeParameters What an unlit material shows.
 * @property {VectorTexture | null} [texture] null or omitted: none yet
 * @property {'alpha' | 'paint' | 'cut' | null} [mode] the shape in `color`, the drawing in its own colours, or the shape in
 *   `color` without blending. By default null: the drawing's colours if it has any, or `alpha` if `color` is given
 *
 * @typedef {import('three').MeshBasicMaterialParameters & Omit<import('./mask-options.js').MaskOptions,
 *   'mode' | 'color' | 'map'> & ShapeParameters} VectorMaterialParameters
 *   the options of an unlit material with a shape: those of `MeshBasicMaterial`, and those of a mask
 *
 * @typedef {Omit<AllOptions, 'mode' | 'color' | 'map'> & { mode: 'alpha' | 'paint' | 'cut' | null }} ShapeOptions
 */

/**
 * @template Mask
 * @typedef {object} Shaped Members of such a material beyond those of its base class.
 * @property {Mask | null} mask null without a texture; `mask.attach(mesh)` applies it to shadows and raycasting
 * @property {AllOptions} options as the constructor takes them
 * @property {VectorTexture | null} texture with null the material is a plain one
 * @property {true} isVectorMaterial always true: identifies a material with a shape
 * @property {(values?: VectorMaterialParameters) => void} setValues changes several values at once, such as a texture and its
 *   root, as the constructor takes them; undefined is the default. After an error the options are as they were
 */

/**
 * @typedef {object} MaskLike What such a material asks of its mask.
 * @property {AllOptions} options
 * @property {any} texture
 * @property {(changes: any) => void} set
 * @property {() => void} remove
 * @property {(copy: any) => void} restore
 */

/** What a basic material has by the same name is its own. */
const OPTIONS = Object.freeze(NAMES.filter((name) => name !== 'color' && name !== 'map'));

/** What is not the default of `applyVectorMask`. @type {Record<string, unknown>} */
const OWN_DEFAULTS = Object.freeze({ background: 'none', mode: null });

/** Colour of a basic material to which none is given. */
export const WHITE = new Color(0xffffff);

/**
 * A basic material with a mask of a renderer.
 *
 * @template {import('three').MeshBasicMaterial} Base
 * @template {MaskLike} Mask
 * @param {new () => Base} base
 * @param {new (material: Base, texture: any, options: any) => Mask} MaskOf
 * @param {string} name of the class, in messages
 * @returns {new (parameters?: VectorMaterialParameters) => Base & ShapeOptions & Shaped<Mask>}
 */
export function shapeMaterial(base, MaskOf, name) {
  class ShapeMaterial extends withOptions(/** @type {any} */ (base), OPTIONS, 'setValues') {
    /** @type {Mask | null} */
    #mask = null;
    #options = complete(OWN_DEFAULTS, 'MeshBasicMaterial');
    /** Node materials copy all properties, one after another. */
    #isCopying = false;

    /** @param {VectorMaterialParameters} [parameters] */
    constructor(parameters = {}) {
      super();
      this.setValues(parameters);
    }

    get isVectorMaterial() {
      return true;
    }

    get mask() {
      return this.#mask;
    }

    get options() {
      return this.#mask?.options ?? this.#options;
    }

    get texture() {
      return this.#mask?.texture ?? null;
    }

    set texture(texture) {
      this.setValues({ texture });
    }

    /** Its `color` may have been changed by itself since the last frame. */
    onBeforeRender() {
      if (!this.color.equals(WHITE) && this.options.mode === null) this.setValues({ mode: 'alpha' });
    }

    /** @param {VectorMaterialParameters} [values] */
    setValues(values) {
      if (values === undefined) return; // three.js's constructor calls it, before there are fields
      givenOptions(values, 'values');
      if (this.#isCopying) return;
      const own = /** @type {Record<string, unknown>} */ ({});
      const basic = /** @type {Record<string, unknown>} */ ({});
      for (const [key, value] of Object.entries(values)) {
        if (OPTIONS.includes(key)) own[key] = value === undefined ? OWN_DEFAULTS[key] : value;
        else if (key !== 'texture') basic[key] = value;
        if (!(key in own) && /** @type {any} */ (this)[key] === undefined) {
          throw new VextureError(`${name} has no option ${line(key)}; correct its name`, key);
        }
      }
      checkMap(values.map);
      if (values.color !== undefined && (own.mode ?? this.options.mode) === null) own.mode = 'alpha';
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
      else if (texture) this.#mask = new MaskOf(/** @type {any} */ (this), texture, { ...this.#options, ...changes });
      else {
        const options = complete({ ...this.options, ...changes }, 'MeshBasicMaterial');
        checkOptions(options, 'MeshBasicMaterial');
        this.#mask?.remove();
        [this.#mask, this.#options] = [null, options];
      }
    }

    /** @param {any} source */
    copy(source) {
      this.#isCopying = true;
      super.copy(source);
      this.#isCopying = false;
      if (source.isVectorMaterial) {
        this.#change(null, { ...source.options, transform: source.options.transform.clone() });
        source.mask?.restore(this);
        this.texture = source.texture;
      }
      return this;
    }
  }
  return /** @type {any} */ (ShapeMaterial);
}

/**
 * @param {any} map a texture of ours says what to do when three.js reads it
 * @throws {VextureError} if it is none of three.js
 */
function checkMap(map) {
  if (map && !map.isTexture && !map.isVectorTexture) throw unfit('map', map, 'give a Texture of three.js or null, and the shape as texture');
}
