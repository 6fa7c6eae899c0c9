import { Color, InstancedBufferAttribute } from 'three';
import { MOST_ROWS } from '../generated/layout.js';
import { elementAt } from './element-at.js';
import { VextureError } from './errors.js';
import { check, insert, takePart } from './hooks.js';
import { MaskedMesh, MaskedMeshes } from './mask-mesh.js';
import { lookedUp } from './mask-lookup.js';
import { checkOptions, complete, isTranslucent } from './mask-options.js';
import { ROOT_ATTRIBUTE, texts } from './mask-shader.js';
import { mapTransform, uniformValues } from './mask-uniforms.js';
import { UV_ATTRIBUTES, variantOf } from './mask-variant.js';
import { shapeIndex } from './select-root.js';

/** @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture */
/** @typedef {import('./mask-shader.js').Variant} Variant */

/** @typedef {import('./mask-options.js').MaskOptions} MaskOptions */

/** @type {WeakMap<import('three').Material, VectorMask>} */
const MASKS = new WeakMap();

/** A shape as the mask of a material, made by `applyVectorMask`. Changes take effect in the next frame. */
export class VectorMask {
  #material;
  #texture;
  #options;
  #transparent;
  #takeBack;
  #clone;
  /** three.js copies nothing that it does not know to a clone. */
  #cloned = () => {
    const copy = this.#clone.call(this.#material);
    if (MASKS.get(this.#material) === this && !MASKS.has(copy)) { // a VectorMaterial copies its own
      copy.transparent = this.#transparent;
      new VectorMask(copy, this.#texture, { ...this.#options, transform: this.#options.transform?.clone() });
    }
    return copy;
  };
  #inside = new Color();
  #isListening = false;
  /** Key of the program since the last refresh: three.js compiles nothing when it goes back to an earlier one. */
  #drawn = '';
  #meshes = new MaskedMeshes();
  /** @type {Record<string, { value: any }>} */
  #uniforms = { vextureMapTransform: mapTransform(() => this.#options) };
  #range = { first: 0, count: 1 };
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
    if (MASKS.has(material)) {
      throw new VextureError(
        `${material.name || material.type} has a vector mask already; change that one, or remove() it first`,
        'material',
      );
    }
    this.#material = material;
    this.#texture = texture;
    this.#transparent = material.transparent;
    this.#options = complete(options, material.type);
    this.#check();
    this.#resolve();
    check(material, texts(this.#variant()));
    this.#takeBack = takePart(
      material,
      () => JSON.stringify(this.#variant()),
      (program) => this.#compile(program, this.#variant()),
    );
    this.#clone = material.clone;
    material.clone = this.#cloned;
    MASKS.set(material, this);
    this.#refresh();
    this.#listen(true);
    material.addEventListener('dispose', this.#onDispose);
  }

  #check() {
    checkOptions(this.#options, this.#material.type, this.#texture);
  }

  /** @returns {Variant} */
  #variant() {
    return variantOf(this.#texture, this.#options, this.#range);
  }

  /** Whether only the instances have roots. */
  get #isRootless() {
    return this.#options.instanced && (this.#options.root ?? null) === null;
  }

  /** Find the shape or the drawing's layers in the texture. */
  #resolve() {
    const { root, mode } = this.#options;
    const inLayers = mode === 'paint' && this.#texture.encoding === 'packed';
    if (this.#isRootless) this.#range = { first: 0, count: 1 }; // the shader does not read it
    else if (inLayers) this.#range = this.#texture.layersOf(root);
    else {
      const isPainted = this.#texture.roots.some(({ paint }) => paint);
      this.#range = { first: shapeIndex(this.#texture, root, isPainted ? ", or use mode: 'paint'" : ''), count: 1 };
    }
  }

  /** Update the uniforms from the texture and the options. */
  #refresh() {
    try {
      this.#resolve();
    } catch (error) {
      if (!(error instanceof VextureError)) throw error; // new data lack the root: show the first shape, with a note
      this.#range = { first: 0, count: 1 };
      this.#texture.dispatchEvent({ type: 'note', message: error.message });
    }
    const values = uniformValues(this.#texture, this.#options, this.#range, this.#inside);
    for (const [name, value] of Object.entries(values)) (this.#uniforms[name] ??= { value }).value = value;
    this.#material.transparent = isTranslucent(this.#options) || this.#transparent;
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
    if (wanted) this.#texture.addEventListener('change', this.#onChange);
    else this.#texture.removeEventListener('change', this.#onChange);
  }

  /**
   * Change several options at once, such as a texture and its root. After an error nothing is changed.
   *
   * @param {MaskOptions & { texture?: VectorTexture }} changes
   * @throws {VextureError} if an option is out of range, options exclude each other, or the root is unknown or
   *   ambiguous
   */
  set({ texture = this.#texture, ...changes }) {
    const [texturedBefore, before] = [this.#texture, this.#options];
    this.#listen(false);
    this.#texture = texture;
    try {
      this.#options = complete({ ...before, ...changes }, this.#material.type);
      this.#check();
      this.#resolve();
    } catch (error) {
      [this.#texture, this.#options] = [texturedBefore, before];
      throw error;
    } finally {
      this.#listen(true);
      this.#refresh();
    }
  }

  /** The options, as `applyVectorMask` takes them. */
  get options() {
    return { ...this.#options };
  }

  /** Whether the material was transparent before. */
  get ownTransparent() {
    return this.#transparent;
  }

  get material() {
    return this.#material;
  }

  get texture() {
    return this.#texture;
  }

  set texture(texture) {
    this.set({ texture });
  }

  /** @returns {string | number | null | undefined} */
  get root() {
    return this.#options.root;
  }

  set root(root) {
    this.set({ root });
  }

  get transform() {
    return this.#options.transform;
  }

  set transform(transform) {
    this.set({ transform });
  }

  get mode() {
    return this.#options.mode;
  }

  set mode(mode) {
    this.set({ mode });
  }

  get channel() {
    return this.#options.channel;
  }

  set channel(channel) {
    this.set({ channel });
  }

  get wrap() {
    return this.#options.wrap;
  }

  set wrap(wrap) {
    this.set({ wrap });
  }

  get flat() {
    return this.#options.flat;
  }

  set flat(flat) {
    this.set({ flat });
  }

  get invert() {
    return this.#options.invert;
  }

  set invert(invert) {
    this.set({ invert });
  }

  get color() {
    return this.#options.color;
  }

  set color(color) {
    this.set({ color });
  }

  get map() {
    return this.#options.map;
  }

  set map(map) {
    this.set({ map });
  }

  get threshold() {
    return this.#options.threshold;
  }

  set threshold(threshold) {
    this.set({ threshold });
  }

  get background() {
    return this.#options.background;
  }

  set background(background) {
    this.set({ background });
  }

  get instanced() {
    return this.#options.instanced;
  }

  get linear() {
    return this.#options.linear;
  }

  set linear(linear) {
    this.set({ linear });
  }

  /** @returns {import('./fold-texture.js').FoldTexture | null} */
  get fold() {
    return this.#options.fold;
  }

  set fold(fold) {
    this.set({ fold });
  }

  /** Time of the fold in seconds; cheap to set in every frame. */
  get time() {
    return this.#options.time;
  }

  set time(time) {
    this.#options = { ...this.#options, time };
    this.#uniforms.vextureTime.value = this.#options.fold?.clock(time) ?? 0;
  }

  /**
   * Whether the masked surface covers a point of a mesh; false in a hole.
   *
   * @param {number} u
   * @param {number} v the mesh's uv
   * @param {number} [root] place of another shape than the mask's
   * @returns {boolean}
   */
  hits(u, v, root) {
    const { mode, background, invert } = this.#options;
    if (mode === 'mix' || (mode === 'paint' && background === 'own')) return true;
    if (this.#isRootless && root === undefined) root = this.#texture.index();
    const { x, y } = lookedUp(u, v, this.#options);
    const first = root ?? this.#range.first;
    const end = root === undefined ? first + this.#range.count : root + 1;
    for (let shape = first; shape < end; shape++) {
      if (this.#texture.contains(x, y, shape)) return !invert;
    }
    return invert;
  }

  /**
   * The topmost element at a point of a mesh; null where nothing is, or nothing with elements (`vexture convert --restyle`).
   *
   * @param {number} u
   * @param {number} v the mesh's uv
   * @param {number} [root] place of another shape than the mask's
   * @returns {import('./element-at.js').FoundElement | null}
   */
  elementAt(u, v, root) {
    const { data } = this.#texture;
    if (data.encoding !== 'packed' || (this.#isRootless && root === undefined)) return null;
    const { first, count } = root === undefined ? this.#range : { first: root, count: 1 };
    const { x, y } = lookedUp(u, v, this.#options);
    return elementAt(/** @type {import('./data.js').PackedData} */ (data), first, count, x, y);
  }

  /** @param {import('./mask-mesh.js').Masked} mesh */
  #isOn(mesh) {
    return [mesh.material].flat().includes(this.#material);
  }

  /**
   * Let rays and light pass through a mesh outside the shape, and rays find the elements of the drawing. Clones of the
   * mesh are attached, too, as long as they have this material.
   *
   * @param {import('./mask-mesh.js').Masked} mesh that has this material
   * @param {{ shadow?: boolean }} [options] without `shadow` light does not pass: several materials share one shadow
   * @returns {this}
   */
  attach(mesh, { shadow = true } = {}) {
    if (this.#meshes.has(mesh)) return this;
    if (!this.#isOn(mesh)) {
      throw new VextureError(`${mesh.name || mesh.type} has another material; give it this one first`, 'mesh');
    }
    if (this.#options.instanced && !mesh.geometry.getAttribute(ROOT_ATTRIBUTE)) {
      throw new VextureError(
        `${mesh.name || mesh.type} has no attribute ${ROOT_ATTRIBUTE}; make it by rootAttribute(texture, names)`,
        ROOT_ATTRIBUTE,
      );
    }
    const rootOf = (instance = 0) =>
      this.#options.instanced ? mesh.geometry.getAttribute(ROOT_ATTRIBUTE)?.getX(instance) : undefined;
    /** @type {import('./mask-mesh.js').Cut} */
    const cut = {
      material: this.#material,
      cuts: () => this.#options.mode === 'cut' || isTranslucent(this.#options),
      hits: (u, v, instance) => this.hits(u, v, rootOf(instance)),
      elementAt: (u, v, instance) => this.elementAt(u, v, rootOf(instance)),
      uv: () => UV_ATTRIBUTES[this.#options.channel],
      key: () => JSON.stringify({ ...this.#variant(), mode: 'cut' }),
      compile: (program, type) => this.#compile(program, { ...this.#variant(), mode: 'cut' }, type),
      attach: (copy) => {
        if (this.#isOn(copy)) this.attach(copy, { shadow });
      },
    };
    this.#meshes.add(mesh, new MaskedMesh(mesh, cut, shadow));
    return this;
  }

  /**
   * Undo `attach`.
   *
   * @param {import('./mask-mesh.js').Masked} mesh
   */
  detach(mesh) {
    this.#meshes.release(mesh);
  }

  /** Restore the material and all meshes. The texture, which others may use, is not disposed of. */
  remove() {
    this.#meshes.releaseAll();
    this.#takeBack();
    if (this.#material.clone === this.#cloned) this.#material.clone = this.#clone;
    this.#listen(false);
    this.#material.removeEventListener('dispose', this.#onDispose);
    this.#material.transparent = this.#transparent;
    if (MASKS.get(this.#material) === this) MASKS.delete(this.#material);
  }

  /** The same as `remove`, which frees the mask's own GPU memory. */
  dispose() {
    this.remove();
  }
}

/**
 * Mask a built-in mesh material or sprite material with a shape. `material.clone()` has a mask of its own with the same
 * options; `vectorMaskOf` finds it, to attach it to a mesh or change it.
 *
 * @param {import('three').Material} material its own `onBeforeCompile`, if any, runs first
 * @param {VectorTexture} texture
 * @param {MaskOptions} [options]
 * @returns {VectorMask}
 * @throws {VextureError} if the material has a mask already or cannot be masked, or the root is unknown or
 *   ambiguous
 */
export function applyVectorMask(material, texture, options) {
  return new VectorMask(material, texture, options);
}

/**
 * The mask of a material or of a clone of a masked one; undefined if it has none.
 *
 * @param {import('three').Material} material
 * @returns {VectorMask | undefined}
 */
export function vectorMaskOf(material) {
  return MASKS.get(material);
}

/**
 * Attribute `vextureRoot` for the geometry of an `InstancedMesh`: the shape of each instance.
 *
 * @param {VectorTexture} texture
 * @param {readonly (string | number)[]} roots names or places in `texture.roots`, one for each instance
 * @returns {InstancedBufferAttribute}
 */
export function rootAttribute(texture, roots) {
  const places = roots.map((root) => texture.index(root));
  const most = places.findIndex((place) => place >= MOST_ROWS);
  if (most >= 0) {
    throw new VextureError(`${texture.name}: root ${places[most]}; instances can show the first ${MOST_ROWS}`, 'root');
  }
  return new InstancedBufferAttribute(new Uint32Array(places), 1);
}
