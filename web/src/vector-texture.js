import { EventDispatcher } from 'three';
import { CURVE_WIDTH, QUAD_WIDTH } from '../generated/layout.js';
import { FOLD_HEIGHT } from '../generated/shaders.js';
import { VextureError } from './errors.js';
import { layersOf, layersTexture } from './layers.js';
import { indexOf } from './names.js';
import { listTexture, wordTexture } from './upload.js';
import { containsThesis } from './thesis-walk.js';
import { contains } from './walk.js';

/** @typedef {import('three').DataTexture} DataTexture */

/**
 * @typedef {object} TextureMap What a shader reads: `texels` and `layers` of a packed texture, `quads` and `curves` of
 * a thesis texture.
 * @property {DataTexture} [texels]
 * @property {DataTexture} [layers] two texels to a root: its quad, its paint, its bounds
 * @property {DataTexture} [quads]
 * @property {DataTexture} [curves]
 */

/**
 * @typedef {object} VectorTextureEvents
 * @property {{}} change other data are in place
 * @property {{ message: string }} note of a live texture: why an update is not shown
 * @property {{ message: string }} offline of a live texture: the server cannot be reached; the last picture stays
 * @property {{}} online of a live texture: it can again
 */

/**
 * @param {import('./data.js').TextureData} data
 * @returns {TextureMap}
 */
function upload(data) {
  if (data.encoding === 'packed') {
    return { texels: wordTexture(data.texels, data.width, data.height), layers: layersTexture(data) };
  }
  return {
    quads: listTexture(data.quads, QUAD_WIDTH, FOLD_HEIGHT),
    curves: listTexture(data.curves, CURVE_WIDTH, FOLD_HEIGHT),
  };
}

/**
 * Shapes that a shader reads at random. Made by `VectorTextureLoader`, which has checked the data.
 *
 * @extends {EventDispatcher<VectorTextureEvents>}
 */
export class VectorTexture extends EventDispatcher {
  /** @type {import('./data.js').TextureData} */
  #data;
  /** @type {TextureMap} */
  #textures;

  /**
   * @param {import('./data.js').TextureData} data as `readPacked` or `readThesis` gives them
   */
  constructor(data) {
    super();
    this.#data = data;
    this.#textures = upload(data);
  }

  get isVectorTexture() {
    return true;
  }

  /** What the file held. */
  get data() {
    return this.#data;
  }

  /** What the GPU holds; others after a `change`. */
  get textures() {
    return this.#textures;
  }

  get encoding() {
    return this.#data.encoding;
  }

  get name() {
    return this.#data.name;
  }

  /** The shapes, the layers of a drawing in painting order. */
  get roots() {
    return this.#data.roots;
  }

  /** Size in the GPU's memory, the list of layers not counted. */
  get nbytes() {
    const { texels, quads, curves } = this.#textures;
    return [texels, quads, curves].reduce((sum, one) => sum + (one?.image.data?.byteLength ?? 0), 0);
  }

  /**
   * Place of a shape in `roots`.
   *
   * @param {string | number} which its name or its place
   * @returns {number}
   * @throws {VextureError} if there is none; it names those whose names are near
   */
  index(which) {
    return indexOf(this.roots, which, this.name);
  }

  /**
   * Whether a point of the unit square is inside a shape, by the outlines themselves.
   *
   * @param {number} u
   * @param {number} v upwards
   * @param {string | number} [root] name or place of the shape
   * @returns {boolean}
   */
  contains(u, v, root = 0) {
    const data = this.#data;
    const { quad } = data.roots[this.index(root)];
    return data.encoding === 'packed' ? contains(data, quad, u, v) : containsThesis(data, u, v);
  }

  /**
   * Which rows of `textures.layers` a drawing consists of.
   *
   * @param {string | number} [root] name or place: `NAME` stands for the layers `NAME/...` of an atlas. Without it all
   *   roots if they have paints, else the first one.
   * @returns {{ first: number, count: number }}
   */
  layersOf(root) {
    if (this.#data.encoding === 'packed') return layersOf(this.#data, root);
    throw new VextureError(`${this.name}: a thesis texture has no layers; convert the drawing to KTX2`, 'encoding');
  }

  /**
   * Put other data in place, all at once: what is drawn next is drawn with them.
   *
   * @param {import('./data.js').TextureData} data
   */
  replace(data) {
    const before = this.#textures;
    this.#textures = upload(data);
    this.#data = data;
    try {
      this.dispatchEvent({ type: 'change' });
    } finally {
      disposeAll(before); // whatever a listener does
    }
  }

  /** Free the GPU's memory. What still draws with it uploads it again. */
  dispose() {
    disposeAll(this.#textures);
  }
}

/**
 * @param {TextureMap} textures
 */
function disposeAll(textures) {
  for (const texture of Object.values(textures)) texture.dispose();
}
