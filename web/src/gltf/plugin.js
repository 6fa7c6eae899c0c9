// Plugin of three.js's GLTFLoader for the extension VEXTURE_vector_texture.
import { Color, LinearSRGBColorSpace, LoaderUtils } from 'three';
import { VextureError, unfit } from '../errors.js';
import { gltfTransform } from '../gltf-transform.js';
import { attachAll, meshesIn } from '../mask-scene.js';
import { applyVectorMask } from '../vector-mask.js';
import { VectorTextureLoader } from '../vector-texture-loader.js';
import { EXTENSION, readMaterial, readSources } from './extension.js';

/**
 * @typedef {import('three/addons/loaders/GLTFLoader.js').GLTFParser} GLTFParser
 * @typedef {import('three/addons/loaders/GLTFLoader.js').GLTF} GLTF
 * @typedef {import('../vector-texture.js').VectorTexture} VectorTexture
 * @typedef {import('./extension.js').TextureSource} TextureSource
 * @typedef {import('./extension.js').MaterialMask} MaterialMask
 */

/**
 * Masks the materials of a model that have vector textures, and attaches its meshes.
 *
 *     const loader = new GLTFLoader().register((parser) => new VectorTexturePlugin(parser));
 *
 * `vectorMaskOf(material)` is the mask of a loaded material, and `gltf.userData.vectorTextures` lists the textures that
 * the model shows; call `dispose()` of each to free its GPU memory when nothing shows it any more. An invalid extension
 * makes the loader fail with an error, without a model.
 */
export class VectorTexturePlugin {
  #parser;
  /** @type {TextureSource[]} */
  #sources = [];
  /** @type {(MaterialMask | null)[]} */
  #materials = [];
  /** @type {Map<number, Promise<VectorTexture>>} */
  #textures = new Map();

  /**
   * @param {GLTFParser} parser passed by `GLTFLoader.register`
   * @throws {VextureError} if it is not a parser
   */
  constructor(parser) {
    if (!parser?.json) throw unfit('parser', parser, 'hand it on: register((parser) => new VectorTexturePlugin(parser))');
    this.#parser = parser;
  }

  /** Name of the extension, `VEXTURE_vector_texture`. */
  get name() {
    return EXTENSION;
  }

  /** Validate everything before loading anything; called by GLTFLoader. */
  async beforeRoot() {
    const { json } = this.#parser;
    this.#sources = readSources(json);
    /** @type {unknown[]} */
    const materials = Array.isArray(json.materials) ? json.materials : [];
    this.#materials = materials.map((one, place) => readMaterial(one, place, this.#sources.length));
  }

  /**
   * Load a material; GLTFLoader calls it once for each.
   *
   * @param {number} place
   * @returns {Promise<import('three').Material> | null} null if the material does not use the extension
   */
  loadMaterial(place) {
    const shown = this.#materials[place];
    return shown ? this.#masked(place, shown) : null;
  }

  /**
   * Attach the meshes, which are complete at this point; called by GLTFLoader.
   *
   * @param {GLTF} gltf
   */
  async afterRoot(gltf) {
    for (const scene of gltf.scenes) attachAll(meshesIn(scene));
    const places = [...this.#textures.keys()].sort((a, b) => a - b);
    gltf.userData.vectorTextures = await Promise.all(places.map((place) => this.#textureOf(place)));
  }

  /**
   * @param {number} place
   * @param {MaterialMask} shown
   */
  async #masked(place, { where, texture, texCoord, color, transform, ...options }) {
    const [material, loaded] = await Promise.all([this.#parser.loadMaterial(place), this.#textureOf(texture)]);
    try {
      applyVectorMask(material, loaded, {
        ...options,
        channel: texCoord,
        color: new Color().setRGB(...color, LinearSRGBColorSpace),
        transform: gltfTransform(transform),
      });
    } catch (error) {
      throw error instanceof VextureError ? error.in(where) : error;
    }
    return material;
  }

  /** @param {number} place */
  #textureOf(place) {
    const texture = this.#textures.get(place) ?? this.#load(this.#sources[place]);
    this.#textures.set(place, texture);
    return texture;
  }

  /**
   * @param {TextureSource} source
   * @returns {Promise<VectorTexture>}
   */
  async #load({ where, uri, base64, bufferView, name }) {
    const { manager, requestHeader, crossOrigin, path } = this.#parser.options;
    const loader = new VectorTextureLoader(manager).setRequestHeader(requestHeader);
    loader.setWithCredentials(crossOrigin === 'use-credentials');
    try {
      if (uri !== undefined) return await loader.loadAsync(LoaderUtils.resolveURL(uri, path));
      const bytes = base64 === undefined ? await this.#parser.getDependency('bufferView', Number(bufferView)) : decoded(base64);
      return await loader.parse(bytes, name ?? where);
    } catch (error) {
      throw error instanceof VextureError ? error.in(where) : error;
    }
  }
}

/**
 * @param {string} base64
 * @returns {Uint8Array}
 */
function decoded(base64) {
  let text;
  try {
    text = atob(base64);
  } catch {
    throw new VextureError('uri is no base64; export the model again', 'uri');
  }
  return Uint8Array.from(text, (character) => character.charCodeAt(0));
}
