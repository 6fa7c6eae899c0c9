// One texture as a pyramid of a single tile.
import { VextureError, line } from '../errors.js';
import { isGrid } from '../tiles/source.js';

/**
 * Make a source of one texture that shows the whole world in Web Mercator.
 *
 * @param {ArrayBuffer | Uint8Array} file its contents
 * @param {{ margin?: number, name?: string }} [options] margin: on each side beyond the world, as a fraction of the world
 * @returns {import('../tiles/source.js').TileSource}
 * @throws {VextureError} if the options are invalid
 */
export function textureSource(file, options) {
  const { margin = 0, name = 'globe' } = options ?? {};
  if (!(file instanceof ArrayBuffer || file instanceof Uint8Array)) {
    throw new VextureError(`the texture is ${line(file)}; give the contents of its file, an ArrayBuffer`, 'file');
  }
  if (!isGrid({ zooms: [0], margin })) throw new VextureError(`the margin is ${line(margin)}; give 0 or more, below 1`, 'margin');
  return { name, attribution: '', zooms: [0], margin, load: async () => new Uint8Array(file) };
}
