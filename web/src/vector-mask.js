import { Color } from 'three';
import { UV_ATTRIBUTES, warnOfMissing } from './attributes.js';
import { VextureError, givenOptions, unfit } from './errors.js';
import { check, insert, takePart } from './hooks.js';
import { MaskedMesh } from './mask-mesh.js';
import { NAMES, isTranslucent, withOptions } from './mask-options.js';
import { texts } from './mask-shader.js';
import { mapTransform, uniformValues } from './mask-uniforms.js';
import { variantOf } from './mask-variant.js';
import { takePartIn, warnOfJSON } from './methods.js';
import { MaskedMeshes } from './ray-mesh.js';
import { ShownShape, checkMesh, isOn } from './shown-shape.js';

/** @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture */
/** @typedef {import('./mask-shader.js').Variant} Variant */

/** @typedef {import('./mask-options.js').MaskOptions} MaskOptions */

/** @type {WeakMap<import('three').Material, VectorMask>} */
const MASKS = new WeakMap();

/** @type {new () => import('./mask-options.js').AllOptions} */
const WithOptions = withOptions(/** @type {any} */ (Object), NAMES, 'set');

/** WebGPURenderer copies a material to one of nodes, and builds that; what a mask does to a shader would be lost. */
function refuseWebGPU() {
  throw new VextureError(
    "a material with a mask of 'vexture' is drawn by WebGPURenderer; take VectorNodeMaterial or applyVectorMask of " +
      "'vexture/webgpu'",
    'renderer',
  );
}

/**
 * A shape as the mask of a material, made by `applyVectorMask`. Each option is also a property; changes take effect in
 * the next frame.
 */
export class VectorMask extends WithOptions {
  #material;
  #shown;
  #transparent;
  #takeBack;
  #inside = new Color();
  #isListening = false;
  /** Key of the program since the last refresh: three.js compiles nothing when it goes back to an earlier one. */
  #drawn = '';
  #meshes = new MaskedMeshes();
  /** @type {Record<string, { value: any }>} */
  #uniforms = { vextureMapTransform: mapTransform(() => this.#shown.options) };
  #onChange = () => this.#refresh();
  #onDispose = () => {
    this.#listen(false);
    this.#meshes.forEach((mesh) => mesh.dispose());
  };

  /**
   * @param {import('three').Material} material
   * @param {VectorTexture} texture
   * @param {MaskOptions} [options]
   */
  constructor(material, texture, options = {}) {
    super();
    if (!material?.isMaterial) throw unfit('material', material, 'give one, such as mesh.material');
    if ('isNodeMaterial' in material) {
      throw new VextureError(
        `${material.type} is a material of WebGPURenderer; take applyVectorMask of 'vexture/webgpu'`,
        'material',
      );
    }
    if (MASKS.has(material)) {
      throw new VextureError(
        `${material.name || material.type} has a vector mask already; change that one, or remove() it first`,
        'material',
      );
    }
    this.#material = material;
    this.#transparent = material.transparent;
    this.#shown = new ShownShape(texture, options, material.type);
    check(material, texts(this.#variant()));
    const variant = () => this.#variant();
    this.#takeBack = [
      takePart(material, () => JSON.stringify(variant()), (program) => this.#compile(program, variant())),
      takePartIn(material, 'clone', (clone) => this.#masked(clone())),
      takePartIn(material, 'toJSON', (toJSON, meta) => {
        warnOfJSON(material);
        return toJSON(meta);
      }),
      takePartIn(material, 'onBeforeRender', (own, renderer, scene, camera, geometry, object, group) => {
        own(renderer, scene, camera, geometry, object, group);
        warnOfMissing(object, geometry, this.#shown.options);
      }),
    ];
    Object.assign(material, { build: refuseWebGPU });
    MASKS.set(material, this);
    this.#refresh();
    this.#listen(true);
    material.addEventListener('dispose', this.#onDispose);
  }

  /**
   * A clone with a mask of its own: three.js copies nothing that it does not know.
   *
   * @param {import('three').Material} copy
   */
  #masked(copy) {
    if (MASKS.has(copy)) return copy; // a VectorMaterial copies its own
    this.restore(copy);
    new VectorMask(copy, this.texture, { ...this.options, transform: this.options.transform.clone() });
    return copy;
  }

  /** @returns {Variant} */
  #variant() {
    return variantOf(this.texture, this.#shown.options, this.#shown.range);
  }

  /** Update the uniforms from the texture and the options. */
  #refresh() {
    const { texture, options } = this.#shown;
    this.#shown.follow();
    const values = uniformValues(texture, options, this.#shown.range, this.#inside);
    for (const [name, value] of Object.entries(values)) (this.#uniforms[name] ??= { value }).value = value;
    this.#material.transparent = isTranslucent(options) || this.#transparent;
    const key = JSON.stringify(this.#variant());
    if (key !== this.#drawn) this.#material.needsUpdate = true;
    this.#drawn = key;
    this.#meshes.forEach((mesh) => mesh.update());
  }

  /**
   * @param {import('./hooks.js').Program} program
   * @param {Variant} variant
   */
  #compile(program, variant, type = this.#material.type) {
    this.#listen(true);
    insert(program, type, texts(variant));
    Object.assign(program.uniforms, this.#uniforms);
  }

  /** @param {boolean} wanted */
  #listen(wanted) {
    if (wanted === this.#isListening) return;
    this.#isListening = wanted;
    if (wanted) this.texture.addEventListener('change', this.#onChange);
    else this.texture.removeEventListener('change', this.#onChange);
  }

  /**
   * Change several options at once, such as a texture and its root. After an error nothing is changed.
   *
   * @param {MaskOptions & { texture?: VectorTexture }} changes
   * @throws {VextureError} if an option is out of range, options exclude each other, or the root is unknown or
   *   ambiguous
   */
  set(changes) {
    const before = /** @type {Record<string, unknown>} */ ({ ...this.#shown.given, texture: this.texture });
    const changed = Object.entries(givenOptions(changes, 'changes')).filter(([name, value]) => value !== before[name]);
    if (changed.every(([name, value]) => name === 'time' && Number.isFinite(value))) {
      for (const [, time] of changed) this.#setTime(/** @type {number} */ (time));
      return;
    }
    const shown = this.#shown.with(changes);
    this.#listen(false);
    this.#shown = shown;
    this.#listen(true);
    this.#refresh();
  }

  /** Cheap, as each frame of a fold has its time. @param {number} time */
  #setTime(time) {
    this.#shown.setTime(time);
    this.#uniforms.vextureTime.value = this.#shown.options.fold?.clock(time) ?? 0;
  }

  /** Options, as `applyVectorMask` takes them. */
  get options() {
    return { ...this.#shown.given };
  }

  /**
   * Restore in a copy of the material what the material was before, without the mask.
   *
   * @param {import('three').Material} copy
   */
  restore(copy) {
    copy.transparent = this.#transparent;
  }

  /** The masked material. */
  get material() {
    return this.#material;
  }

  /** The texture with the shape; it can be replaced by another one. */
  get texture() {
    return this.#shown.texture;
  }

  set texture(texture) {
    this.set({ texture });
  }

  /**
   * Return whether the masked surface covers a point of a mesh; false in a hole.
   *
   * @param {number} u
   * @param {number} v the mesh's uv
   * @param {number} [root] index of a shape other than the mask's
   * @returns {boolean}
   */
  hits(u, v, root) {
    return this.#shown.hits(u, v, root);
  }

  /**
   * Find the topmost element at a point of a mesh; null if there is none (see `vexture convert --restyle`).
   *
   * @param {number} u
   * @param {number} v the mesh's uv
   * @param {number} [root] index of a shape other than the mask's
   * @returns {import('./element-at.js').FoundElement | null}
   */
  elementAt(u, v, root) {
    return this.#shown.elementAt(u, v, root);
  }

  /**
   * Let rays and light pass through a mesh outside the shape, and let rays find the elements of the drawing. Clones of the
   * mesh with this material are attached, too.
   *
   * @param {import('./ray-mesh.js').Masked} mesh that has this material
   * @param {{ shadow?: boolean }} [options] by default with `shadow: true`; without `shadow` light does not pass: several materials share one shadow
   * @returns {this}
   */
  attach(mesh, options) {
    const { shadow = true } = givenOptions(options);
    if (this.#meshes.has(mesh)) return this;
    checkMesh(mesh, this.#material, this.#shown.options);
    /** @type {import('./mask-mesh.js').Cut} */
    const cut = {
      material: this.#material,
      cuts: () => this.#shown.cuts,
      hits: (u, v, instance) => this.hits(u, v, this.#shown.rootOf(mesh, instance)),
      elementAt: (u, v, instance) => this.elementAt(u, v, this.#shown.rootOf(mesh, instance)),
      uv: () => UV_ATTRIBUTES[this.#shown.options.channel],
      key: () => JSON.stringify({ ...this.#variant(), mode: 'cut' }),
      compile: (program, type) => this.#compile(program, { ...this.#variant(), mode: 'cut' }, type),
      attach: (copy) => {
        if (isOn(copy, this.#material)) this.attach(copy, { shadow });
      },
    };
    this.#meshes.add(mesh, new MaskedMesh(mesh, cut, shadow));
    return this;
  }

  /**
   * Undo `attach`.
   *
   * @param {import('./ray-mesh.js').Masked} mesh
   */
  detach(mesh) {
    this.#meshes.release(mesh);
  }

  /** Restore the material and all meshes. The texture is not disposed of, because others may use it. */
  remove() {
    this.#meshes.releaseAll();
    for (const takeBack of this.#takeBack) takeBack();
    this.#listen(false);
    this.#material.removeEventListener('dispose', this.#onDispose);
    this.#material.transparent = this.#transparent;
    delete (/** @type {{ build?: unknown }} */ (this.#material).build);
    if (MASKS.get(this.#material) === this) MASKS.delete(this.#material);
  }

  /** Same as `remove`, which frees the mask's own GPU memory. */
  dispose() {
    this.remove();
  }
}

/**
 * Mask a built-in mesh material or sprite material with a shape. `material.clone()` has a mask of its own with the same
 * options; `vectorMaskOf` finds it, to attach it to a mesh or change it.
 *
 * @param {import('three').Material} material its own `onBeforeCompile` runs first, even if it is set later
 * @param {VectorTexture} texture
 * @param {MaskOptions} [options]
 * @returns {VectorMask}
 * @throws {VextureError} if the material already has a mask or cannot be masked, or the root is unknown or
 *   ambiguous
 */
export function applyVectorMask(material, texture, options) {
  return new VectorMask(material, texture, options);
}

/**
 * Return the mask of a material or of a clone of a masked one; undefined if it has none.
 *
 * @param {import('three').Material} material
 * @returns {VectorMask | undefined}
 */
export function vectorMaskOf(material) {
  return MASKS.get(material);
}
