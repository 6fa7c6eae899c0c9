// Arrays as textures that a shader reads by texelFetch: an index between two others means nothing, so no filter.
import { DataTexture, FloatType, NearestFilter, NoColorSpace, RGBAFormat, RGBAIntegerFormat, UnsignedIntType } from 'three';

/**
 * @param {DataTexture} texture
 * @param {'RGBA32UI' | 'RGBA32F'} internalFormat
 */
function plain(texture, internalFormat) {
  texture.internalFormat = internalFormat;
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.colorSpace = NoColorSpace;
  texture.needsUpdate = true;
  return texture;
}

/**
 * Texture of four unsigned 32-bit words to a texel.
 *
 * @param {Uint32Array} words
 * @param {number} width
 * @param {number} height
 */
export function wordTexture(words, width, height) {
  const data = /** @type {Uint32Array<ArrayBuffer>} */ (words);
  return plain(new DataTexture(data, width, height, RGBAIntegerFormat, UnsignedIntType), 'RGBA32UI');
}

/**
 * Texture of one list of a thesis texture, as numbers in 0..1; row r goes to row r % height, in block r / height.
 *
 * @param {Uint8Array | Uint16Array} pixels RGB
 * @param {number} width pixels in a row
 * @param {number} most rows of the texture
 */
export function listTexture(pixels, width, most) {
  const rows = pixels.length / (3 * width);
  const height = Math.min(rows, most);
  const across = Math.ceil(rows / most) * width;
  const one = 256 ** pixels.BYTES_PER_ELEMENT - 1;
  const numbers = new Float32Array(4 * across * height);
  for (let row = 0; row < rows; row++) {
    const start = 4 * ((row % most) * across + Math.floor(row / most) * width);
    for (let i = 0; i < 3 * width; i++) {
      numbers[start + 4 * Math.floor(i / 3) + (i % 3)] = pixels[3 * width * row + i] / one;
    }
  }
  return plain(new DataTexture(numbers, across, height, RGBAFormat, FloatType), 'RGBA32F');
}
