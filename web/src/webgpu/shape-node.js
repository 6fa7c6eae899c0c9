import { Node, NodeUtils } from 'three/webgpu';
import { glsl, wgsl } from 'three/tsl';
import { endingOf, shaderText } from './shader-text.js';

/** @typedef {import('./shader-text.js').NodeVariant} NodeVariant */

/**
 * @typedef {object} ShapeInputs
 * @property {Node} texels the texture's words
 * @property {Node} paints its layers
 * @property {Node | null} instance place of an instance's root; null: all have one
 * @property {Node} quad root quad of one shape
 * @property {Node} first number of the lowest layer
 * @property {Node} count number of layers
 * @property {Node} uv position
 * @property {Node | null} dx its step to the next pixel; null: its derivative
 * @property {Node | null} dy
 * @property {{ texels: Node, time: Node, cycle: Node } | null} fold
 */

/** @typedef {any} Builder three.js's NodeBuilder, whose types lack what nodes of text need */

/** @type {Map<string, ReturnType<typeof glsl>>} */
const CODES = new Map();

/**
 * One node for each variant and language, so that a program holds a text once, however many shapes it draws.
 *
 * @param {NodeVariant} variant
 * @param {import('./shader-text.js').Language} language
 */
function codeOf(variant, language) {
  const key = language + endingOf(variant);
  const made = CODES.get(key) ?? (language === 'wgsl' ? wgsl : glsl)(shaderText(variant, language));
  CODES.set(key, made);
  return made;
}

/**
 * Coverage of a pixel by a shape, or the colour of a drawing in it, straight and linear. It is a node of its own, not
 * `wgslFn` and `glslFn`: these cannot hand on a texture of integers, and know the first function of a text only.
 */
export class ShapeNode extends /** @type {new (type: string) => Node} */ (Node) {
  /** What was compiled with this node. @type {Set<WeakRef<import('three').Material>>} */
  #materials = new Set();

  static get type() {
    return 'VextureShapeNode';
  }

  /**
   * @param {'coverage' | 'colour'} what
   * @param {NodeVariant} variant
   * @param {boolean} isSheets whether several layers or maps may be shown, and not one map or shape
   * @param {ShapeInputs} inputs
   * @param {(builder: Builder) => void} [onBuild] called when a program is built
   */
  constructor(what, variant, isSheets, { fold, ...inputs }, onBuild) {
    super(what === 'coverage' ? 'float' : 'vec4');
    this.what = what;
    this.variant = variant;
    this.isSheets = isSheets;
    this.onBuild = onBuild;
    Object.assign(this, inputs, {
      foldTexels: fold?.texels ?? null,
      foldTime: fold?.time ?? null,
      foldCycle: fold?.cycle ?? null,
    });
  }

  /** Programs of another variant are others; three.js asks for this of materials that need an update. */
  customCacheKey() {
    return NodeUtils.hashString(this.id + endingOf(this.variant) + this.isSheets);
  }

  /**
   * Be the node of another variant, as data of another kind need it: what shows the node is compiled again.
   *
   * @param {NodeVariant} variant
   * @param {boolean} isSheets
   */
  become(variant, isSheets) {
    const before = this.customCacheKey();
    [this.variant, this.isSheets] = [variant, isSheets];
    if (this.customCacheKey() === before) return;
    for (const held of this.#materials) {
      const material = held.deref();
      if (material) material.needsUpdate = true;
    }
    this.#materials.clear();
  }

  /**
   * @param {Builder} builder
   * @param {string} output
   */
  generate(builder, output) {
    this.onBuild?.(builder);
    if (builder.material) this.#materials.add(new WeakRef(builder.material)); // the texture, which outlives them, holds this
    const isWgsl = /** @type {any} */ (builder.renderer.backend).isWebGPUBackend === true;
    codeOf(this.variant, isWgsl ? 'wgsl' : 'glsl').build(builder, 'void');
    return builder.format(this.#call(builder, isWgsl), this.nodeType, output);
  }

  /**
   * @param {Builder} builder
   * @param {boolean} isWgsl
   */
  #call(builder, isWgsl) {
    const ending = endingOf(this.variant);
    const self = /** @type {Record<string, any>} */ (/** @type {unknown} */ (this));
    /** @param {string} name @param {string} type */
    const built = (name, type) => /** @type {string} */ (self[name].build(builder, type));
    const texels = built('texels', 'texture');
    const place = this.#place(builder, isWgsl);
    const root = self.instance
      ? `vextureQuad${ending}(${built('paints', 'texture')}, ${built('instance', 'uint')})`
      : built('quad', 'uint');
    if (this.what === 'coverage' && !this.variant.colours) return `vextureWrapped${ending}(${texels}, ${root}, ${place})`;
    const layers = self.instance
      ? `i32(${built('instance', 'uint')}), 1`
      : `${built('first', 'int')}, ${built('count', 'int')}`;
    const sheets = `${texels}, ${built('paints', 'texture')}, ${isWgsl ? layers : layers.replace('i32', 'int')}`;
    const which = this.variant.colours ? 'vextureSheets' : 'vextureLayers';
    const colour = this.isSheets
      ? `${which}${ending}(${sheets}, ${place})`
      : `vextureWrappedColor${ending}(${texels}, ${root}, ${place})`;
    if (this.what === 'coverage' && self.instance && this.isSheets) {
      const paints = built('paints', 'texture');
      return `vextureSheetCoverage${ending}(${texels}, ${paints}, ${built('instance', 'uint')}, ${place})`;
    }
    if (this.what === 'coverage') return `${colour}.a`;
    return `${this.variant.colours ? 'vextureLight' : 'vextureStraight'}${ending}(${colour})`;
  }

  /**
   * The position and its steps, folded or not, as arguments.
   *
   * @param {Builder} builder
   * @param {boolean} isWgsl
   */
  #place(builder, isWgsl) {
    const ending = endingOf(this.variant);
    const self = /** @type {Record<string, any>} */ (/** @type {unknown} */ (this));
    const uv = self.uv.build(builder, 'vec2');
    const fragment = isWgsl ? `${builder.getFragCoord().replace(/\.xy$/, '')}, ` : '';
    const dx = self.dx ? self.dx.build(builder, 'vec2') : `vextureStepX${ending}(${fragment}${uv})`;
    const dy = self.dy ? self.dy.build(builder, 'vec2') : `vextureStepY${ending}(${fragment}${uv})`;
    if (!self.foldTexels) return `${uv}, ${dx}, ${dy}`;
    const texels = self.foldTexels.build(builder, 'texture');
    const [time, cycle] = [self.foldTime.build(builder, 'float'), self.foldCycle.build(builder, 'float')];
    const name = `vextureFolded${this.id}`;
    const how = isWgsl ? 'let' : `VextureFolded${ending}`;
    builder.addLineFlowCode(`${how} ${name} = vextureFold${ending}(${texels}, ${time}, ${cycle}, ${uv}, ${dx}, ${dy})`, this);
    return `${name}.uv, ${name}.dx, ${name}.dy`;
  }
}
