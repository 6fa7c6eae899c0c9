// Arrays as textures for texelFetch. Their values are indices and bit fields, so filtering is off.
import { DataTexture, NearestFilter, NoColorSpace, RGBAIntegerFormat, UnsignedIntType } from 'three';

/**
 * A texture without filtering, mipmaps and colour space.
 *
 * @template {DataTexture} T
 * @param {T} texture
 * @param {'RGBA32UI' | 'RGBA32F'} internalFormat
 */
export function unfiltered(texture, internalFormat) {
  texture.internalFormat = internalFormat;
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.colorSpace = NoColorSpace;
  texture.needsUpdate = true;
  return texture;
}

/**
 * Texture with four unsigned 32-bit words in each texel.
 *
 * @param {Uint32Array} words
 * @param {number} width
 * @param {number} height
 * @returns {DataTexture}
 */
export function wordTexture(words, width, height) {
  const data = /** @type {Uint32Array<ArrayBuffer>} */ (words);
  return unfiltered(new DataTexture(data, width, height, RGBAIntegerFormat, UnsignedIntType), 'RGBA32UI');
}
