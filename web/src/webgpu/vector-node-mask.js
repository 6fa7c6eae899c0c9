import { Color } from 'three';
import { bool, float, materialColor, materialOpacity, mix, texture as textureNode, uniform, uv, vec3, vec4 } from 'three/tsl';
import { UV_ATTRIBUTES, warnOfMissing } from '../attributes.js';
import { VextureError, givenOptions, unfit } from '../errors.js';
import { glyphHooks } from '../glyph-hooks.js';
import { NAMES, isOfGlyphs, isTranslucent, withOptions } from '../mask-options.js';
import { takePartIn, warnOfJSON } from '../methods.js';
import { MaskedMeshes, RayMesh } from '../ray-mesh.js';
import { WHITE } from '../shape-material.js';
import { ShownShape, checkMesh, isOn } from '../shown-shape.js';
import { nodeVariant, shapeNode } from './shape-inputs.js';
import { instancedRoot } from './vector-nodes.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('../mask-options.js').MaskOptions} MaskOptions */
/** @typedef {import('../ray-mesh.js').Masked} Masked */

/** @typedef {any} NodeMaterial three.js's types know node materials of some versions only */

/** What a mask sets of a material. */
const SET = Object.freeze(['transparent', 'colorNode', 'opacityNode', 'maskNode', 'maskShadowNode', 'positionNode']);

/** @type {WeakMap<NodeMaterial, VectorNodeMask>} */
const MASKS = new WeakMap();

/** @type {new () => import('../mask-options.js').AllOptions} */
const WithOptions = withOptions(/** @type {any} */ (Object), NAMES, 'set');

/** @param {import('../mask-options.js').AllOptions} options @returns {any} */
const instanceOf = ({ instanced }) => (instanced ? true : null);

/** @param {any} renderer */
function refuseWebGL(renderer) {
  if (!renderer.isWebGLRenderer) return;
  throw new VextureError(
    "a material of 'vexture/webgpu' is drawn by WebGLRenderer; draw it by WebGPURenderer, or take that of 'vexture'",
    'renderer',
  );
}

/**
 * A shape as the mask of a node material, made by `applyVectorMask`. Each option is a property, too; changes take effect
 * in the next frame.
 */
export class VectorNodeMask extends WithOptions {
  #material;
  #shown;
  /** @type {Record<string, any>} */
  #before;
  #takeBack;
  #meshes = new MaskedMeshes();
  #drawn = '';
  /** What the nodes read, and follow by themselves. @type {unknown[]} */
  #read = [];
  #transform;
  #inside = new Color();
  #uniforms;
  #onChange = () => this.#refresh();

  /**
   * @param {NodeMaterial} material
   * @param {VectorTexture} texture
   * @param {MaskOptions} [options]
   */
  constructor(material, texture, options = {}) {
    super();
    if (!material?.isMaterial) throw unfit('material', material, 'give one, such as mesh.material');
    if (material.isNodeMaterial !== true) {
      throw new VextureError(
        `${material.type} is no node material; use one, as MeshStandardNodeMaterial, or applyVectorMask of 'vexture'`,
        'material',
      );
    }
    if (MASKS.has(material)) {
      throw new VextureError(
        `${material.name || material.type} has a vector mask already; change that one, or remove() it first`,
        'material',
      );
    }
    if (texture && texture.encoding !== 'packed') {
      throw new VextureError(`${texture.name}: a ${texture.encoding} texture; convert the drawing to KTX2`, 'encoding');
    }
    this.#material = material;
    this.#shown = new ShownShape(texture, options, material.type.replace('Node', ''));
    this.#before = Object.fromEntries(SET.map((name) => [name, material[name]]));
    this.#transform = this.#shown.options.transform.clone();
    this.#uniforms = {
      transform: /** @type {any} */ (uniform(this.#transform)),
      inside: /** @type {any} */ (uniform(this.#inside)),
      threshold: /** @type {any} */ (uniform(0)),
      colored: /** @type {any} */ (uniform(0)),
    };
    this.#uniforms.transform.onRenderUpdate(() => this.#transform.copy(this.#shown.options.transform));
    this.#uniforms.inside.onRenderUpdate(() => this.#inside.set(this.#shown.options.color));
    this.#uniforms.threshold.onRenderUpdate(() => this.#shown.options.threshold);
    this.#uniforms.colored.onRenderUpdate(() => Number(!material.color.equals(WHITE)));
    this.#takeBack = [
      takePartIn(material, 'onBeforeRender', (_own, renderer) => refuseWebGL(renderer)),
      takePartIn(material, 'clone', (clone) => this.#masked(clone())),
      takePartIn(material, 'toJSON', (toJSON, meta) => this.#plainly(() => toJSON(meta))),
    ];
    MASKS.set(material, this);
    this.#shown.texture.addEventListener('change', this.#onChange);
    this.#refresh();
  }

  /** A clone with a mask of its own. @param {NodeMaterial} copy */
  #masked(copy) {
    if (MASKS.has(copy)) return copy; // a VectorNodeMaterial copies its own
    this.restore(copy);
    new VectorNodeMask(copy, this.texture, { ...this.options, transform: this.transform.clone() });
    return copy;
  }

  /** Do something while the material is as it was before the mask. @param {() => unknown} act */
  #plainly(act) {
    const material = this.#material;
    const shown = Object.fromEntries(SET.map((name) => [name, material[name]]));
    warnOfJSON(material);
    this.restore(material);
    const done = act();
    Object.assign(material, shown);
    return done;
  }

  /**
   * Give a copy of the material what the material was before, without the mask.
   *
   * @param {NodeMaterial} copy
   */
  restore(copy) {
    for (const name of SET) copy[name] = this.#before[name];
  }

  /** Whether the shape is shown in the material's colour as soon as it has one: WebGPURenderer does not tell a material of a frame. */
  get #takesColor() {
    return this.#material.isVectorMaterial === true && this.#shown.given.mode === null;
  }

  /** Make the nodes again where they would be others. */
  #refresh() {
    this.#shown.follow();
    const { options, range, texture } = this.#shown;
    const { mode, invert, background, map, channel, fold } = options;
    const { variant, isSheets } = nodeVariant(/** @type {any} */ (texture), { ...options, instance: instanceOf(options), glyphs: isOfGlyphs(options.instanced) ? mode : null }, range);
    const key = JSON.stringify([variant, isSheets, mode, invert, background, channel, Boolean(options.instanced), this.#takesColor]);
    const read = [texture, fold, map, options.instanced];
    this.#material.transparent = isTranslucent(options) || this.#before.transparent;
    if (key === this.#drawn && read.every((one, place) => one === this.#read[place])) return;
    [this.#drawn, this.#read] = [key, read];
    this.#setNodes();
    this.#material.needsUpdate = true;
  }

  /** @param {'coverage' | 'colour'} what @param {{ uv: any } | null} glyphs */
  #node(what, glyphs) {
    const { options } = this.#shown;
    const at = glyphs ? glyphs.uv : this.#uniforms.transform.mul(vec3(/** @type {any} */ (uv(options.channel)), 1)).xy;
    return shapeNode(what, /** @type {any} */ (this.#shown.texture), {
      ...options,
      uv: at,
      dx: null,
      dy: null,
      instance: options.instanced ? /** @type {any} */ (instancedRoot()) : null,
      glyphs: glyphs && options.mode,
      range: () => this.#shown.range,
      time: () => this.#shown.options.time,
      onBuild: ({ object, geometry }) => warnOfMissing(object, geometry, this.#shown.options),
    });
  }

  #setNodes() {
    const material = this.#material;
    const { mode, invert, background, map, channel } = this.#shown.options;
    const before = this.#before;
    const { instanced } = this.#shown.options;
    const glyphs = isOfGlyphs(instanced) ? (glyphHooks.nodes?.(instanced) ?? null) : null;
    const tint = glyphs?.tint ?? null;
    const opacity = tint ? float(before.opacityNode ?? materialOpacity).mul(tint.a) : float(before.opacityNode ?? materialOpacity);
    const color = tint ? vec4(before.colorNode ?? /** @type {any} */ (materialColor)).mul(vec4(tint.rgb, 1)) : vec4(before.colorNode ?? /** @type {any} */ (materialColor));
    const paint = mode === 'paint' ? this.#node('colour', glyphs) : null;
    const shape = paint ? paint.a : this.#node('coverage', glyphs);
    const coverage = invert ? shape.oneMinus() : shape;
    const both = (/** @type {any} */ node) => (before.maskNode ? bool(before.maskNode).and(node) : node);
    this.restore(material);
    if (glyphs) material.positionNode = glyphs.position;
    if (this.#shown.cuts) {
      material.maskNode = both(mode === 'cut' ? coverage.greaterThanEqual(this.#uniforms.threshold) : coverage.greaterThan(0));
      material.maskShadowNode = both(coverage.greaterThanEqual(this.#uniforms.threshold));
    }
    if (mode === 'alpha') material.opacityNode = opacity.mul(coverage);
    if (mode === 'alpha' && tint) material.colorNode = color;
    if (mode === 'mix') {
      const inside = vec4(this.#uniforms.inside, 1);
      const painted = map ? inside.mul(/** @type {any} */ (textureNode(map, uv(channel)))) : inside;
      material.colorNode = mix(color, painted, coverage);
    }
    if (paint && background === 'own') material.colorNode = vec4(mix(color.rgb, paint.rgb, paint.a), color.a);
    if (paint && background === 'none') {
      material.colorNode = vec4(this.#takesColor ? mix(paint.rgb, color.rgb, this.#uniforms.colored) : paint.rgb, 1);
      material.opacityNode = opacity.mul(paint.a);
    }
    material.transparent = isTranslucent(this.#shown.options) || before.transparent;
  }

  /**
   * Change several options at once, such as a texture and its root. After an error nothing is changed.
   *
   * @param {MaskOptions & { texture?: VectorTexture }} changes
   * @throws {VextureError} if an option is out of range, options exclude each other, or the root is unknown or
   *   ambiguous
   */
  set(changes) {
    const { time, ...others } = givenOptions(changes, 'changes');
    if (Number.isFinite(time) && Object.keys(others).length === 0) { // cheap, as each frame of a fold has its time
      this.#shown.setTime(/** @type {number} */ (time));
      return;
    }
    const shown = this.#shown.with(changes);
    this.#shown.texture.removeEventListener('change', this.#onChange);
    this.#shown = shown;
    shown.texture.addEventListener('change', this.#onChange);
    this.#refresh();
  }

  /** The options, as `applyVectorMask` takes them. */
  get options() {
    return { ...this.#shown.given };
  }

  /** The material that has this mask. */
  get material() {
    return this.#material;
  }

  /** The texture whose shape is shown; another one is shown from the next frame on. */
  get texture() {
    return /** @type {VectorTexture} */ (/** @type {unknown} */ (this.#shown.texture));
  }

  set texture(texture) {
    this.set({ texture });
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
    return this.#shown.hits(u, v, root);
  }

  /**
   * The topmost element at a point of a mesh; null where nothing is, or nothing with elements (`vexture convert --restyle`).
   *
   * @param {number} u
   * @param {number} v the mesh's uv
   * @param {number} [root] place of another shape than the mask's
   * @returns {import('../element-at.js').FoundElement | null}
   */
  elementAt(u, v, root) {
    return this.#shown.elementAt(u, v, root);
  }

  /**
   * Let rays pass through a mesh outside the shape, and find the elements of the drawing; light does so without it. Clones
   * of the mesh are attached, too, as long as they have this material.
   *
   * @param {Masked} mesh that has this material
   * @returns {this}
   */
  attach(mesh) {
    if (this.#meshes.has(mesh)) return this;
    checkMesh(mesh, this.#material, this.#shown.options);
    /** @type {import('../ray-mesh.js').Rays} */
    const rays = {
      material: this.#material,
      hits: (u, v, instance) => this.hits(u, v, this.#shown.rootOf(mesh, instance)),
      elementAt: (u, v, instance) => this.elementAt(u, v, this.#shown.rootOf(mesh, instance)),
      uv: () => UV_ATTRIBUTES[this.#shown.options.channel],
      attach: (copy) => {
        if (isOn(copy, this.#material)) this.attach(copy);
      },
    };
    this.#meshes.add(mesh, new RayMesh(mesh, rays));
    return this;
  }

  /**
   * Undo `attach`.
   *
   * @param {Masked} mesh
   */
  detach(mesh) {
    this.#meshes.release(mesh);
  }

  /** Restore the material and all meshes. The texture, which others may use, is not disposed of. */
  remove() {
    this.#meshes.releaseAll();
    this.#shown.texture.removeEventListener('change', this.#onChange);
    for (const takeBack of this.#takeBack) takeBack();
    this.restore(this.#material);
    this.#material.needsUpdate = true;
    MASKS.delete(this.#material);
  }

  /** The same as `remove`. */
  dispose() {
    this.remove();
  }
}

/**
 * Mask a node material with a shape: its opacity, its colour or what of it there is, its shadow included.
 * `material.clone()` has a mask of its own with the same options; `vectorMaskOf` finds it.
 *
 * @param {NodeMaterial} material its own `colorNode`, `opacityNode` and `maskNode`, if any, stay in effect
 * @param {VectorTexture} texture
 * @param {MaskOptions} [options]
 * @returns {VectorNodeMask}
 * @throws {VextureError} if the material has a mask already or is no node material, or the root is unknown or ambiguous
 */
export function applyVectorMask(material, texture, options) {
  return new VectorNodeMask(material, texture, options);
}

/**
 * The mask of a material or of a clone of a masked one; undefined if it has none.
 *
 * @param {NodeMaterial} material
 * @returns {VectorNodeMask | undefined}
 */
export function vectorMaskOf(material) {
  return MASKS.get(material);
}
