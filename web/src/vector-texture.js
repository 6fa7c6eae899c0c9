import { Color, EventDispatcher, LinearSRGBColorSpace, SRGBColorSpace } from 'three';
import { elementAt } from './element-at.js';
import { VextureError } from './errors.js';
import { layersOf, layersTexture } from './layers.js';
import { mapParts } from './maps.js';
import { shapeIndex, styleOf } from './select-root.js';
import { wordTexture } from './upload.js';
import { checkData, colorAt, contains } from './walk.js';

/** @import { DataTexture } from 'three' */
/** @typedef {import('./data.js').TextureData} TextureData */
/** @typedef {import('./data.js').PackedData} PackedData */
/** @typedef {import('./select-root.js').RootChoice} RootChoice */

/** @typedef {VectorTexture<TextureData>} AnyVectorTexture a texture of any encoding */

/**
 * @typedef {Record<string, DataTexture>} TextureMap The textures that a shader reads: `texels` and `layers` of a packed
 *   texture. `layers` holds two texels for each root: its quad, its paint, its bounds.
 */

/**
 * @typedef {object} MaskReader How the shader of a mask reads an encoding other than the packed one.
 * @property {string} declared GLSL declarations and functions
 * @property {(footprint: string) => string} coverage GLSL expression of the coverage, from a position and its two
 *   derivatives
 * @property {Record<string, unknown>} uniforms values of the declared uniforms
 */

/**
 * @typedef {object} VectorTextureEvents The events of a texture.
 * @property {{}} change other data are in place
 * @property {{ message: string }} note a live texture's update was not shown, or a mask's root is missing in new data
 * @property {{ message: string }} offline a live texture's server cannot be reached; the last data stay in place
 * @property {{}} online the server can be reached again
 */

/** What reading colours needs of three.js, which the module for planar maps does not import. */
const COLORS = { Color, LinearSRGBColorSpace, SRGBColorSpace };

/**
 * Shapes with random access for shaders. `VectorTextureLoader` makes them from validated data.
 *
 * @template {TextureData} [Data=PackedData]
 * @extends {EventDispatcher<VectorTextureEvents>}
 */
export class VectorTexture extends EventDispatcher {
  /** @type {Data} */
  #data;
  /** @type {TextureMap} */
  #textures;

  /**
   * @param {Data} data as returned by `readPacked`
   * @throws {VextureError} if it is something else
   */
  constructor(data) {
    super();
    this.#textures = this.upload(checkData(data));
    this.#data = data;
  }

  /** Always true: identifies a vector texture. */
  get isVectorTexture() {
    return true;
  }

  /** Contents of the file. */
  get data() {
    return this.#data;
  }

  /** Textures on the GPU; a `change` replaces them. */
  get textures() {
    return this.#textures;
  }

  /** Name of the encoding: `packed` or `thesis`. @returns {Data['encoding']} */
  get encoding() {
    return this.#data.encoding;
  }

  /** Name of the texture, from its file. */
  get name() {
    return this.#data.name;
  }

  /** The shapes, the layers of a drawing in painting order. */
  get roots() {
    return this.#data.roots;
  }

  /** Bytes of GPU memory, without the layers texture. */
  get nbytes() {
    const { layers, ...lists } = this.#textures;
    return Object.values(lists).reduce((sum, one) => sum + (one.image.data?.byteLength ?? 0), 0);
  }

  /**
   * Find the index of a shape in `roots`.
   *
   * @param {RootChoice} [root] name or index of the shape; not needed if there is only one
   * @returns {number}
   * @throws {VextureError} if there is no such shape (the message lists near names), or several and no choice
   */
  index(root) {
    return shapeIndex(this.#data, root);
  }

  /**
   * Return whether a point of the unit square is inside a shape, by the stored outlines.
   *
   * @param {number} u
   * @param {number} v upwards
   * @param {RootChoice} [root] name or index of the shape; not needed if there is only one
   * @returns {boolean}
   * @throws {VextureError} if there is no such shape, or several and no choice
   */
  contains(u, v, root) {
    const data = packed(this.#data);
    return contains(data, data.roots[this.index(root)].quad, u, v);
  }

  /**
   * Compute the colour of a drawing at a point of the unit square, as mode `paint` shows it.
   *
   * @param {number} u
   * @param {number} v upwards
   * @param {RootChoice} [root] as in `layersOf`
   * @returns {import('./data.js').RootPaint} with opacity 0 if there is nothing
   * @throws {VextureError} if there is no such drawing, or several and no choice
   */
  colorAt(u, v, root) {
    const { first, count } = this.layersOf(root);
    return colorAt(packed(this.#data), this.roots.slice(first, first + count), u, v);
  }

  /**
   * Recolour elements of a drawing from the next frame on, without rebuilding trees or programs.
   *
   * @param {import('./paints.js').PaintList} paints by element: a colour as `THREE.Color` reads it, or sRGB components and
   *   opacity, 0..1, or `own` to restore the original colour. For thousands of elements, a `Map` is read faster than an
   *   object
   * @param {RootChoice} [root] as in `layersOf`
   * @throws {VextureError} if the texture has no elements (it was converted without `--restyle`), none has a name, or
   *   one that hides others would not stay opaque
   */
  setPaints(paints, root) {
    const { first, count } = this.#restylable(root);
    const appears = mapParts().setPaints(packed(this.#data), first, count, paints, this.#textures.texels, COLORS);
    if (appears) this.replace(this.#data); // the bounds, which masks read, have changed
  }

  /**
   * Find the topmost element of a drawing at a point of the unit square.
   *
   * @param {number} u
   * @param {number} v upwards
   * @param {RootChoice} [root] as in `layersOf`
   * @returns {import('./element-at.js').FoundElement | null} null if there is none
   * @throws {VextureError} if the texture has no elements
   */
  elementAt(u, v, root) {
    const { first, count } = this.#restylable(root);
    return elementAt(packed(this.#data), first, count, u, v);
  }

  /**
   * As `layersOf`, of a drawing whose elements are known.
   *
   * @param {RootChoice} root
   */
  #restylable(root) {
    const range = this.layersOf(root);
    for (const one of this.roots.slice(range.first, range.first + range.count)) styleOf(one);
    return range;
  }

  /**
   * Find the rows of `textures.layers` that hold a drawing.
   *
   * @param {RootChoice} [root] name or place; `NAME` selects the layers `NAME/...` of an atlas. Not needed if there is
   *   only one drawing.
   * @returns {{ first: number, count: number }}
   * @throws {VextureError} if there is no such drawing, or several and no choice
   */
  layersOf(root) {
    return layersOf(packed(this.#data), root);
  }

  /**
   * Replace the data from the next frame on.
   *
   * @param {Data} data
   */
  replace(data) {
    const before = this.#textures;
    this.#textures = this.upload(checkData(data));
    this.#data = data;
    try {
      this.dispatchEvent({ type: 'change' });
    } finally {
      disposeAll(before); // even if a listener throws
    }
  }

  /**
   * Make an independent texture with the same data, which can be recoloured separately. It does not follow a server.
   *
   * @returns {VectorTexture}
   */
  clone() {
    return new VectorTexture(structuredClone(packed(this.#data)));
  }

  /** Free the GPU memory. A material that still uses the texture uploads it again. */
  dispose() {
    disposeAll(this.#textures);
  }

  /**
   * Textures of other data. Other encodings override it; the constructor calls it.
   *
   * @protected
   * @param {Data} data
   * @returns {TextureMap}
   */
  upload(data) {
    const { texels, width, height, roots } = packed(data);
    const words = wordTexture(texels, width, height);
    if (roots.some(({ style }) => style)) mapParts().prepareRows(words);
    return { texels: words, layers: layersTexture(packed(data)) };
  }

  /**
   * What a mask needs to read another encoding; null for the packed one. Other encodings override it.
   *
   * @internal
   * @returns {MaskReader | null}
   */
  maskReader() {
    return null;
  }
}

/** What three.js reads of a map or a background before it compiles a program with it. */
const OF_IMAGES = ['channel', 'mapping', 'matrix', 'colorSpace', 'isCubeTexture'];

for (const property of OF_IMAGES) {
  Object.defineProperty(VectorTexture.prototype, property, {
    /** @this {AnyVectorTexture} */
    get() {
      throw new VextureError(
        `${this.name}: a VectorTexture is no image for a map or a background (${property}); use VectorMaterial, or ` +
          'applyVectorMask on a material',
        'map',
      );
    },
  });
}

/**
 * Data of a class that does not override the methods for packed textures.
 *
 * @param {TextureData} data
 */
function packed(data) {
  return /** @type {PackedData} */ (data);
}

/** @param {TextureMap} textures */
function disposeAll(textures) {
  for (const texture of Object.values(textures)) texture.dispose();
}
