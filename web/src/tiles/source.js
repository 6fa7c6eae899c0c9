// Where the tiles of a pyramid come from: a PMTiles archive, there or in memory, or a folder with a TileJSON.
import { FetchSource, FileSource, PMTiles } from 'pmtiles';
import { PACKED_FILE_LIMIT } from '../../generated/layout.js';
import { VextureError, line } from '../errors.js';
import { fetchBytes } from '../fetching.js';
import { START_BYTES, kindOf, mistakenFor } from '../mistaken.js';

/**
 * @typedef {object} TileSource A pyramid of tiles.
 * @property {string} [name] for messages
 * @property {string} [attribution] to be shown beside the map
 * @property {readonly number[]} zooms that have tiles, rising
 * @property {number} margin of a tile's texture around the tile, as a fraction of the tile's side
 * @property {(tile: import('./grid.js').TileId, signal: AbortSignal) => Promise<Uint8Array | null>} load loads the file of
 *   a tile; null for an empty tile
 */

/**
 * @typedef {ArrayBuffer | Uint8Array | Blob} TileArchive The content of a `.pmtiles`, or a `File` that a user chose.
 */

/** A tile in which nothing is may have no file. */
const NOTHING = ['status 404', 'status 204', 'status 410'];

/** And many servers send a page or nothing instead. @type {readonly unknown[]} */
const ABSENT = ['a web page', 'XML', 'nothing'];

/** Longest TileJSON, in bytes. */
const LONGEST = 2 ** 22;

/** What messages call an archive that has no address. */
const HELD = 'the archive';

/** What can be opened. */
export const GIVEN = 'the address of a .pmtiles or a TileJSON, or the bytes of a .pmtiles';

const PYRAMID = { what: 'pyramid of tiles', make: `give ${GIVEN}` };

/** @param {unknown} given @returns {given is TileArchive} */
export const isArchive = (given) => given instanceof ArrayBuffer || given instanceof Uint8Array || given instanceof Blob;

/**
 * Open a pyramid by its address, `map.pmtiles` or a TileJSON, or by the content of a `.pmtiles`.
 *
 * @param {string | URL | TileArchive} given
 * @param {AbortSignal} [signal]
 * @returns {Promise<TileSource>}
 * @throws {VextureError} if it cannot be fetched, or is not a pyramid by vexture
 */
export async function openTiles(given, signal = new AbortController().signal) {
  if (typeof given !== 'string' && !(given instanceof URL)) {
    if (!isArchive(given)) throw new VextureError(`the source is ${line(given)}; give ${GIVEN}`, 'source');
    const file = new File([/** @type {BlobPart} */ (given)], HELD);
    return archive(new FileSource(file), HELD, 'give all bytes of a .pmtiles');
  }
  let path;
  try {
    const isBlank = typeof given === 'string' && !given.trim(); // it would be the address of the page itself
    path = new URL(given, isBlank ? undefined : globalThis.location?.href).href;
  } catch (error) {
    throw new VextureError(`the source is ${line(given)}; give ${GIVEN}`, 'source', { cause: error });
  }
  return /\.pmtiles(?:$|[?#])/.test(path) ? archive(path, path, 'check the address, and that its server answers range requests') : folder(path, signal);
}

/**
 * @param {string | FileSource} given
 * @param {string} url or what it is called
 * @param {string} remedy
 * @returns {Promise<TileSource>}
 */
async function archive(given, url, remedy) {
  const source = new Watched(typeof given === 'string' ? new FetchSource(given) : given);
  const tiles = new PMTiles(source);
  let metadata;
  try {
    metadata = await tiles.getMetadata();
  } catch (error) {
    const other = source.start && mistakenFor(source.start, PYRAMID);
    throw new VextureError(`${url}: ${other ?? `cannot be read (${line(error)}); ${remedy}`}`, 'url', { cause: error });
  }
  const load = async (/** @type {import('./grid.js').TileId} */ { z, x, y }, /** @type {AbortSignal} */ signal) => {
    const found = await tiles.getZxy(z, x, y, signal);
    return found ? new Uint8Array(found.data) : null;
  };
  return { ...described(metadata, url), load };
}

/** A source that keeps its first bytes, which tell what it is if it is no archive. */
class Watched {
  /** @type {Uint8Array | null} */
  start = null;
  #source;

  /** @param {FetchSource | FileSource} source */
  constructor(source) {
    this.#source = source;
  }

  getKey() {
    return this.#source.getKey();
  }

  /** @type {import('pmtiles').Source['getBytes']} */
  async getBytes(offset, length, signal, etag) {
    const found = await /** @type {import('pmtiles').Source} */ (this.#source).getBytes(offset, length, signal, etag);
    if (offset === 0) this.start ??= new Uint8Array(found.data.slice(0, START_BYTES));
    return found;
  }
}

/**
 * @param {string} url of a TileJSON
 * @param {AbortSignal} signal
 * @returns {Promise<TileSource>}
 */
async function folder(url, signal) {
  const bytes = await fetchBytes(url, { signal }, LONGEST);
  let metadata;
  try {
    metadata = JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    const other = mistakenFor(bytes, PYRAMID);
    const said = other ?? `is no TileJSON (${line(error)}); give its address, or that of a .pmtiles`;
    throw new VextureError(`${url}: ${said}`, 'tiles');
  }
  const described_ = described(metadata, url);
  const template = metadata.tiles?.[0];
  if (typeof template !== 'string') {
    throw new VextureError(`${url}: tiles is ${line(metadata.tiles)}; it must hold an address with {z}, {x} and {y}`, 'tiles');
  }
  const load = async (/** @type {import('./grid.js').TileId} */ { z, x, y }, /** @type {AbortSignal} */ given) => {
    const place = template.replace('{z}', String(z)).replace('{x}', String(x)).replace('{y}', String(y));
    try {
      const file = await fetchBytes(new URL(place, url).href, { signal: given }, PACKED_FILE_LIMIT);
      return ABSENT.includes(kindOf(file)) ? null : file;
    } catch (error) {
      if (error instanceof VextureError && NOTHING.includes(error.field)) return null;
      throw error;
    }
  };
  return { ...described_, load };
}

/** Whether zooms rise, and the margin is a part of a tile. @param {{ zooms?: any, margin?: any }} source */
export const isGrid = ({ zooms, margin }) =>
  Array.isArray(zooms) && zooms.length > 0 && typeof margin === 'number' && margin >= 0 && margin < 1 &&
  zooms.every((z, k) => Number.isInteger(z) && z > (k ? zooms[k - 1] : -1) && z <= 30);

/**
 * What the metadata of a pyramid say.
 *
 * @param {any} metadata
 * @param {string} url
 * @returns {Omit<TileSource, 'load'>}
 */
function described(metadata, url) {
  const { margin, zooms } = metadata?.vexture ?? {};
  if (!isGrid({ zooms, margin })) {
    throw new VextureError(`${url}: its metadata have no pyramid of vexture; make one with vexture tiles`, 'vexture');
  }
  return { name: String(metadata.name ?? url), attribution: String(metadata.attribution ?? ''), zooms, margin };
}
