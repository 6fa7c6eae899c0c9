// What a page gives to a map of tiles, checked: what is wrong is said in a line, and not by what fails later on.
import { VextureError, line } from '../errors.js';
import { GIVEN, isArchive, isGrid } from './source.js';

/** The least of each number. */
const LEAST = { budget: 0, most: 1, retries: 0, pause: 0 };

/**
 * @param {import('./client.js').AllTileOptions & { source?: any }} options
 * @throws {VextureError} if one of them cannot be
 */
export function checkOptions(options) {
  const { source } = options ?? {};
  const isSource = typeof source === 'string' ? source.trim() !== '' : source instanceof URL || isArchive(source) || (typeof source?.load === 'function' && isGrid(source));
  if (!isSource) {
    throw new VextureError(`the source is ${line(source)}; give ${GIVEN}, or { zooms, margin, load }`, 'source');
  }
  for (const name of /** @type {const} */ (['onChange', 'onError'])) if (options[name] !== undefined) checkFunction(options[name], name);
  for (const [name, least] of Object.entries(LEAST)) {
    const value = /** @type {Record<string, any>} */ (options)[name] ?? least;
    if (typeof value !== 'number' || !(value >= least)) throw new VextureError(`${name} is ${line(value)}; give a number of ${least} or more`, name);
  }
}

/**
 * @param {unknown} given
 * @param {string} name
 * @throws {VextureError} if it is no function
 */
export function checkFunction(given, name) {
  if (typeof given !== 'function') throw new VextureError(`${name} is ${line(given)}; give a function`, name);
}

/**
 * Longitude and latitude, in degrees.
 *
 * @param {any} place `[lng, lat]` or `{ lng, lat }`
 * @returns {[number, number]}
 * @throws {VextureError} if it is no place
 */
export function placeOf(place) {
  const [lng, lat] = Array.isArray(place) ? place : [place?.lng, place?.lat];
  if (Number.isFinite(lng) && Math.abs(lat) <= 90) return [lng, lat];
  throw new VextureError(`the place is ${line(place)}; give [lng, lat] or { lng, lat } in degrees, latitudes of -90 to 90`, 'place');
}
