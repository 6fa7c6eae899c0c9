// The shape of water: the textures it is read from, and their uniforms.
import { Color, Matrix3, Vector2, Vector3, Vector4 } from 'three';
import { VextureError, line } from '../errors.js';
import { wordTexture } from '../upload.js';
import { Shores } from './shore.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */

/**
 * @typedef {object} Foam The foam along a shore.
 * @property {number} [width] of the foam and shallows along the shore, in unit-square units; by default 0: none
 * @property {number} [period] seconds from one line of foam to the next, by default 7
 * @property {import('three').ColorRepresentation} [color] by default `0xf2f6f7`
 * @property {number} [amount] 0 (none) to 1, by default 0.9
 *
 * @typedef {object} WaterShapeOptions The shape of water, and its look along the shore.
 * @property {string | number | null} [root] name or place of the shape in each texture; needed if a texture holds
 *   several shapes
 * @property {Matrix3} [transform] from the mesh's uv to the unit square; its elements may be changed at any time
 * @property {Foam} [foam] along the shore; by default none
 * @property {import('three').ColorRepresentation | null} [shallow] colour of the water at the shore; null, the default: as
 *   elsewhere
 * @property {import('three').ColorRepresentation | null} [flat] uniform colour of the water, without lighting and tone
 *   mapping, for measurements; null, the default: none
 */

const FOAM = Object.freeze({ width: 0, period: 7, color: 0xf2f6f7, amount: 0.9 });

/** Bound while there is no texture: the shader does not read it, but its sampler needs an integer texture. */
let nothing = /** @type {import('three').DataTexture | null} */ (null);

/**
 * Texels of two textures in one image, the second below the first.
 *
 * @param {import('../data.js').PackedData} first
 * @param {import('../data.js').PackedData} second
 */
function stacked(first, second) {
  const width = Math.max(first.width, second.width);
  const words = new Uint32Array(4 * width * (first.height + second.height));
  let at = 0;
  for (const { width: columns, height, texels } of [first, second]) {
    for (let row = 0; row < height; row++, at += 4 * width) {
      words.set(texels.subarray(4 * columns * row, 4 * columns * (row + 1)), at);
    }
  }
  return wordTexture(words, width, first.height + second.height);
}

/** @param {VectorTexture} texture a checked one */
const texelsOf = (texture) => /** @type {import('three').DataTexture} */ (texture.textures.texels);

/**
 * The texture that the water is read from, or two during a fade.
 */
export class WaterShape {
  /** @type {VectorTexture | null} */
  #texture = null;
  /** @type {VectorTexture | null} */
  #next = null;
  #fade = 0;
  /** @type {import('three').DataTexture | null} both, during a fade */
  #both = null;
  #shores = new Shores();
  /** @type {Map<VectorTexture, number>} root quad of each texture */
  #roots = new Map();
  #root;
  #shown;
  #onChange = () => this.#refresh();

  /**
   * @param {VectorTexture | null} texture
   * @param {WaterShapeOptions} options
   * @param {(shown: boolean) => void} shown called with whether there is any water
   */
  constructor(texture, options, shown) {
    const { root, transform = new Matrix3(), foam = {}, shallow = null, flat = null } = options;
    if (transform?.elements?.length !== 9) {
      throw new VextureError(`transform is ${line(transform)}; it must be a Matrix3`, 'transform');
    }
    this.#root = root;
    this.#shown = shown;
    /** @type {Record<string, { value: any }>} */
    this.uniforms = {
      vextureTexels: { value: null },
      vextureShapes: { value: 0 },
      vextureQuads: { value: new Vector2() },
      vextureRows: { value: new Vector2() },
      vextureShares: { value: new Vector2() },
      vextureTransform: { value: transform },
      vextureFolding: { value: null },
      vextureCycle: { value: 0 },
      vextureTime: { value: 0 },
      vextureAround: { value: null },
      vextureAroundNext: { value: null },
      vextureBox: { value: new Vector3() },
      vextureShore: { value: 0 },
      vextureLapping: { value: FOAM.period },
      vextureShallow: { value: new Vector4() },
      vextureFoamColor: { value: new Vector4() },
      vextureFlatColor: { value: new Vector4() },
    };
    this.foam = foam;
    this.shallow = shallow;
    this.flat = flat;
    this.texture = texture;
  }

  get texture() {
    return this.#texture;
  }

  set texture(texture) {
    if (texture !== null) this.#check(texture);
    this.#put(texture, null);
  }

  get next() {
    return this.#next;
  }

  /** @param {VectorTexture | null} texture */
  fadeTo(texture) {
    if (texture !== null) this.#check(texture);
    this.#put(this.#fade < 0.5 ? this.#texture : this.#next, texture);
  }

  get fade() {
    return this.#fade;
  }

  set fade(fade) {
    if (!(fade >= 0 && fade <= 1)) throw new VextureError(`fade is ${line(fade)}; it must be from 0 to 1`, 'fade');
    this.#fade = fade;
    this.#weigh();
  }

  get foam() {
    const { vextureShore, vextureLapping, vextureFoamColor } = this.uniforms;
    const { x, y, z, w } = vextureFoamColor.value;
    return { width: vextureShore.value, period: vextureLapping.value, color: new Color(x, y, z), amount: w };
  }

  set foam(/** @type {Foam} */ foam) {
    const { width, period, color, amount } = { ...FOAM, ...foam };
    const wrong = Object.entries({ width, period, amount }).find(([, value]) => !(value >= 0 && value < Infinity));
    if (wrong) throw new VextureError(`foam: ${wrong[0]} is ${line(wrong[1])}; it must be 0 or more`, `foam.${wrong[0]}`);
    this.uniforms.vextureShore.value = width;
    this.uniforms.vextureLapping.value = period || FOAM.period;
    setColor(this.uniforms.vextureFoamColor, color, amount);
  }

  get shallow() {
    return colorOf(this.uniforms.vextureShallow);
  }

  set shallow(/** @type {import('three').ColorRepresentation | null} */ color) {
    setColor(this.uniforms.vextureShallow, color ?? 0, color == null ? 0 : 1);
  }

  get flat() {
    return colorOf(this.uniforms.vextureFlatColor);
  }

  set flat(/** @type {import('three').ColorRepresentation | null} */ color) {
    setColor(this.uniforms.vextureFlatColor, color ?? 0, color == null ? 0 : 1);
  }

  /**
   * Draw the shore rasters, if their shapes have changed.
   *
   * @param {import('three').WebGLRenderer} renderer that is about to draw the water
   */
  prepare(renderer) {
    const shapes = [...this.#roots].map(([one, quad]) => ({ texels: texelsOf(one), quad }));
    const { vextureAround, vextureAroundNext, vextureBox, vextureShore } = this.uniforms;
    const { rasters, boxes } = this.#shores.drawn(renderer, shapes, vextureShore.value);
    const isFirst = this.#texture !== null && this.#fade < 1;
    vextureAround.value = rasters[isFirst ? 0 : rasters.length - 1];
    vextureAroundNext.value = rasters[rasters.length - 1];
    vextureBox.value.copy(boxes);
  }

  /** Stop following textures, and free all GPU memory but theirs. */
  dispose() {
    this.#put(null, null);
    this.#shores.dispose();
  }

  /** @param {VectorTexture} texture */
  #check(texture) {
    if (!texture?.isVectorTexture) {
      throw new VextureError(`the texture is ${line(texture)}; load one by VectorTextureLoader`, 'texture');
    }
    if (texture.encoding !== 'packed') {
      throw new VextureError(`${texture.name}: water needs a packed texture; convert the drawing to KTX2`, 'encoding');
    }
    this.#rootOf(texture);
  }

  /**
   * @param {VectorTexture} texture
   * @returns {import('../data.js').Root}
   * @throws {VextureError} if there is no such shape, several and no choice, or it is a planar map
   */
  #rootOf(texture) {
    const root = texture.roots[texture.index(this.#root)];
    if (!root.isMap) return root;
    throw new VextureError(
      `${texture.name}: ${line(root.name)} is a planar map, and water needs a shore; convert the drawing as a silhouette`,
      'root',
    );
  }

  /**
   * @param {VectorTexture | null} texture
   * @param {VectorTexture | null} next
   */
  #put(texture, next) {
    for (const one of [this.#texture, this.#next]) one?.removeEventListener('change', this.#onChange);
    [this.#texture, this.#next, this.#fade] = [texture, next, 0];
    for (const one of [texture, next]) one?.addEventListener('change', this.#onChange);
    this.#refresh();
  }

  /** Update the uniforms from the textures. */
  #refresh() {
    const [texture, next] = [this.#texture, this.#next];
    this.#both?.dispose();
    this.#both = texture && next && texture !== next ? stacked(texture.data, next.data) : null;
    const textures = [texture, next].filter((one) => one !== null);
    this.#roots = new Map(textures.map((one) => [one, this.#quad(one)]));
    nothing ??= wordTexture(new Uint32Array(4), 1, 1);
    this.uniforms.vextureTexels.value = this.#both ?? (texture ?? next)?.textures.texels ?? nothing;
    this.#weigh();
  }

  /** Set the shapes that the shader reads and their weights; a shape of weight 0 is not read. */
  #weigh() {
    const [texture, next] = [this.#texture, this.#next];
    const below = this.#both && texture ? texture.data.height : 0;
    const shapes = [
      { texture, row: 0, share: 1 - this.#fade },
      { texture: next, row: below, share: this.#fade },
    ].filter(({ texture: one, share }) => one && share > 0);
    const { vextureShapes, vextureQuads, vextureRows, vextureShares } = this.uniforms;
    vextureShapes.value = shapes.length;
    vextureShares.value.set(0, 0);
    shapes.forEach(({ texture: one, row, share }, i) => {
      vextureQuads.value.setComponent(i, this.#roots.get(/** @type {VectorTexture} */ (one)));
      vextureRows.value.setComponent(i, row);
      vextureShares.value.setComponent(i, share);
    });
    this.#shown(shapes.length > 0);
  }

  /** @param {VectorTexture} texture */
  #quad(texture) {
    try {
      return this.#rootOf(texture).quad;
    } catch (error) {
      if (!(error instanceof VextureError)) throw error; // new data lack the root: show the first shape, with a note
      texture.dispatchEvent({ type: 'note', message: error.message });
      return texture.roots[0].quad;
    }
  }
}

/**
 * @param {{ value: Vector4 }} uniform
 * @param {import('three').ColorRepresentation} color
 * @param {number} alpha
 */
function setColor(uniform, color, alpha) {
  const { r, g, b } = new Color(color);
  uniform.value.set(r, g, b, alpha);
}

/** @param {{ value: Vector4 }} uniform */
function colorOf({ value: { x, y, z, w } }) {
  return w === 0 ? null : new Color(x, y, z);
}
