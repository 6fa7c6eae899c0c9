// What only planar maps need is loaded when a file holds one: most pages show shapes of one colour first, or nothing else.
import { VextureError, line } from './errors.js';

/** @type {typeof import('./map-parts.js') | null} */
let parts = null;

/** What else maps need in this page: the texts of its shaders. @type {Set<() => Promise<void>>} */
const texts = new Set();

/**
 * A text that is loaded with the first map.
 *
 * @param {() => Promise<string>} load
 * @returns {() => string}
 */
export function withMaps(load) {
  let text = '';
  texts.add(async () => {
    text ||= await load();
  });
  return () => text || missing();
}

/** @returns {never} */
function missing() {
  throw new VextureError('the module for planar maps is not loaded; read the file with readPacked, or await loadMaps()', 'maps');
}

/**
 * Load the code for planar maps. `readPacked` and all loaders do so for a file with maps; call it before making a
 * `VectorTexture` of data that another thread has read.
 *
 * @returns {Promise<void>}
 * @throws {VextureError} if the code cannot be fetched
 */
export async function loadMaps() {
  try {
    [parts] = await Promise.all([import('./map-parts.js'), ...[...texts].map((load) => load())]);
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
  return parts ?? missing();
}
