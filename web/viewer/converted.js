/** What `vexture convert` writes of a drawing: small, where the texture of the page is made for deep zoom. */
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';
import { bytesOf } from './library.js';

/**
 * @typedef {object} Converted
 * @property {number} bytes of the file
 * @property {VectorTexture} texture
 */

/** @type {WeakMap<import('./library.js').Manifest, Promise<Converted>>} */
const READ = new WeakMap();

/**
 * The file that comes with a shape; null if none does.
 *
 * @param {import('./library.js').Document} document
 * @returns {Promise<Converted> | null}
 */
export function convertedOf({ manifest, base, name }) {
  const url = manifest.views?.converted;
  if (!url) return null;
  const read = async () => {
    const file = await bytesOf(url, base);
    return { bytes: file.byteLength, texture: new VectorTexture(await readPacked(file, name)) };
  };
  const found = READ.get(manifest) ?? read();
  READ.set(manifest, found);
  return found;
}
