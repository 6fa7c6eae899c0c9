// What only planar maps need is loaded when a file holds one: most pages show shapes of one colour first, or nothing else.
import { VextureError, line } from './errors.js';

/** @type {typeof import('./map-parts.js') | null} */
let parts = null;

/**
 * Load what planar maps need. `readPacked` and all loaders do so for a file with maps; it is needed before a `VectorTexture`
 * is made of data that another thread has read.
 *
 * @returns {Promise<void>}
 * @throws {VextureError} if it cannot be fetched
 */
export async function loadMaps() {
  try {
    parts ??= await import('./map-parts.js');
  } catch (error) {
    throw new VextureError(`the module for planar maps cannot be loaded (${line(error)}); check the network and the site's files`,
      'url', { cause: error });
  }
}

/**
 * What `loadMaps` has loaded.
 *
 * @throws {VextureError} if it has not been called
 */
export function mapParts() {
  if (parts) return parts;
  throw new VextureError('the module for planar maps is not loaded; read the file with readPacked, or await loadMaps()', 'maps');
}
