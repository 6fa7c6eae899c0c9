// One texture as the mask of the materials of a whole model.
import { VextureError, line, givenOptions, unfit } from './errors.js';
import { applyVectorMask, vectorMaskOf } from './vector-mask.js';

/** @import { Material, Object3D } from 'three' */

/**
 * @typedef {import('./ray-mesh.js').Masked} Masked
 * @typedef {import('./vector-texture.js').AnyVectorTexture} VectorTexture
 * @typedef {import('./vector-mask.js').VectorMask} VectorMask
 * @typedef {import('./mask-options.js').MaskOptions} MaskOptions
 *
 * @typedef {MaskOptions & { materials?: string | readonly string[] | ((material: Material, mesh: Masked) => boolean) }
 *   } SceneMaskOptions the options of a mask; and `materials`: which materials, by a name or names, or by a function that
 *   chooses them; by default all
 */

/** Names that a message lists. */
const MOST_LISTED = 12;

/**
 * The meshes and sprites of a scene graph, hidden ones as well.
 *
 * @param {Object3D} scene
 * @returns {Masked[]}
 */
export function meshesIn(scene) {
  /** @type {Masked[]} */
  const found = [];
  scene.traverse((object) => {
    if ('isMesh' in object || 'isSprite' in object) found.push(/** @type {Masked} */ (/** @type {Object3D} */ (object)));
  });
  return found;
}

/**
 * Attach every mesh to the masks of its materials.
 *
 * @param {readonly Masked[]} meshes
 * @param {readonly VectorMask[]} [masks] to these only, and in their order, so that the reverse one undoes it
 */
export function attachAll(meshes, masks) {
  const order = new Map(masks?.map((mask, place) => [mask, place]));
  const rank = (/** @type {VectorMask} */ mask) => order.get(mask) ?? 0;
  for (const mesh of meshes) {
    const own = [mesh.material].flat().flatMap((material) => vectorMaskOf(material) ?? []);
    const wanted = masks ? own.filter((mask) => order.has(mask)).sort((a, b) => rank(a) - rank(b)) : own;
    for (const mask of wanted) mask.attach(mesh, { shadow: !Array.isArray(mesh.material) });
  }
}

/** The masks of a model's materials, made by `applyVectorMaskToScene`. */
export class SceneMask {
  #masks;

  /**
   * @internal
   * @param {readonly VectorMask[]} masks
   */
  constructor(masks) {
    this.#masks = Object.freeze([...masks]);
  }

  /** One for each material. */
  get masks() {
    return this.#masks;
  }

  /**
   * Change options of all masks, like `VectorMask.set`. After an error nothing is changed.
   *
   * @param {MaskOptions & { texture?: VectorTexture }} changes
   * @throws {VextureError} for the reasons of `VectorMask.set`
   */
  set(changes) {
    const before = this.#masks.map((mask) => ({ ...mask.options, texture: mask.texture }));
    let place = 0;
    try {
      for (; place < this.#masks.length; place++) this.#masks[place].set(changes);
    } catch (error) {
      while (place-- > 0) this.#masks[place].set(before[place]);
      throw error;
    }
  }

  /** Restore all materials and meshes. The texture is not disposed of, because others may use it. */
  remove() {
    for (const mask of [...this.#masks].reverse()) mask.remove();
  }
}

/**
 * Mask the materials of a model, or of any part of a scene, each once for all its meshes, and attach the meshes.
 *
 * A mesh of several materials keeps its whole shadow, because its materials share one.
 *
 * @param {Object3D} scene such as the `scene` of a model of glTF, for which `transform: gltfTransform()` is right
 * @param {VectorTexture} texture
 * @param {SceneMaskOptions} [given] those of `applyVectorMask`, which all masks share, and `materials`
 * @returns {SceneMask}
 * @throws {VextureError} if no material has a name or is chosen, or one cannot be masked; then nothing is changed
 */
export function applyVectorMaskToScene(scene, texture, given) {
  if (!scene?.isObject3D) throw unfit('scene', scene, 'give a scene, a group or a mesh, such as gltf.scene');
  const { materials, ...options } = givenOptions(given);
  const meshes = meshesIn(scene);
  const chosen = choose(meshes, materials);
  /** @type {VectorMask[]} */
  const masks = [];
  try {
    for (const material of chosen) masks.push(applyVectorMask(material, texture, options));
    attachAll(meshes, masks);
  } catch (error) {
    for (const mask of masks.reverse()) mask.remove();
    throw error;
  }
  return new SceneMask(masks);
}

/**
 * @param {readonly Masked[]} meshes
 * @param {SceneMaskOptions['materials']} wanted
 * @returns {Set<Material>}
 */
function choose(meshes, wanted) {
  const names = typeof wanted === 'string' ? [wanted] : wanted;
  if (names && typeof names !== 'function' && !Array.isArray(names)) {
    throw new VextureError(`materials is ${line(wanted)}; give a name, a list of names, or a function`, 'materials');
  }
  const isWanted = typeof names === 'function' ? names : (/** @type {Material} */ { name }) => names?.includes(name) ?? true;
  /** @type {Set<Material>} */
  const all = new Set();
  /** @type {Set<Material>} */
  const chosen = new Set();
  for (const mesh of meshes) {
    for (const material of [mesh.material].flat()) {
      all.add(material);
      if (isWanted(material, mesh)) chosen.add(material);
    }
  }
  const there = [...new Set([...all].map(({ name }) => name).filter(Boolean))];
  const missing = Array.isArray(names) ? names.find((name) => !there.includes(name)) : undefined;
  if (missing !== undefined) throw new VextureError(`no material ${line(missing)}; ${listed(there)}`, 'materials');
  if (chosen.size === 0) throw new VextureError(`no material is chosen of ${all.size}; ${listed(there)}`, 'materials');
  return chosen;
}

/** @param {string[]} names */
function listed(names) {
  if (names.length === 0) return 'none has a name; choose by a function';
  const more = names.length > MOST_LISTED ? ` and ${names.length - MOST_LISTED} more` : '';
  return `there are ${names.slice(0, MOST_LISTED).map(line).join(', ')}${more}`;
}
