// A pyramid as a page uses it: opened, its features coloured and asked for. The renderers are built upon it.
import { LATTICE } from '../../generated/layout.js';
import { elementAt } from '../element-at.js';
import { isTransport } from '../fetching.js';
import { loadMaps } from '../maps.js';
import { TileClient } from './client.js';
import { FeatureColors } from './feature-colors.js';
import { ancestor, mercator, squareOf } from './grid.js';
import { checkOptions, placeOf } from './options.js';
import { tried } from './queue.js';
import { isArchive, openTiles } from './source.js';

/**
 * @typedef {import('./client.js').LoadedTile} LoadedTile
 *
 * @typedef {object} Feature A feature at a place.
 * @property {string} id its name
 *
 * @typedef {{ quad: import('./choose.js').Quad, loaded: LoadedTile }[]} View what is shown
 *
 * @typedef {string | URL | import('./source.js').TileArchive | import('./source.js').TileSource} Given an address, the bytes of an
 *   archive, or what `openTiles` has made of them
 *
 * @typedef {{ source: Given } & import('./client.js').AllTileOptions} PyramidOptions
 */

/** Parts of a tile's side within which its outlines are exact. */
const ROUNDED = LATTICE / 2;

/** @param {Given} given @returns {given is import('./source.js').TileSource} */
const isSource = (given) => !!(/** @type {any} */ (given)?.load);

export class Pyramid {
  /** @type {TileClient | null} */
  client = null;
  /** @type {View} */
  shown = [];
  #controller = new AbortController();
  #options;
  #isFailed = false;

  /**
   * @param {PyramidOptions} options
   * @param {FeatureColors} [colors] those of a pyramid before it
   * @throws {VextureError} if an option cannot be
   */
  constructor(options, colors = new FeatureColors()) {
    checkOptions(options);
    this.colors = colors;
    this.#options = options;
    colors.onError = (error) => options.onError?.(error);
    /** When its metadata are there; null: it was disposed of before. @type {Promise<TileClient | null>} */
    this.ready = this.#open();
  }

  #open() {
    const opened = this.#opened();
    opened.catch((error) => {
      this.#isFailed = true;
      this.#options.onError?.(error); // who waits for it gets it, too
    });
    return opened;
  }

  async #opened() {
    const { source: given, retries, pause, onChange } = this.#options;
    const { signal } = this.#controller;
    const isPassing = (/** @type {unknown} */ error) => !isArchive(given) && isTransport(error);
    try {
      const [source] = await Promise.all([
        isSource(given) ? given : tried(() => openTiles(given, signal), signal, retries, pause, isPassing), loadMaps()]);
      if (signal.aborted) return null;
      this.client = new TileClient(source, this.#options);
    } catch (error) {
      if (signal.aborted) return null;
      throw error;
    }
    onChange?.();
    return this.client;
  }

  /** Ask again for what could not be had: tiles, or the metadata. */
  retry() {
    if (this.client) this.client.retry();
    else if (this.#isFailed && !this.isClosed) {
      this.#isFailed = false;
      this.ready = this.#open();
    }
  }

  /** Whether it has been disposed of. */
  get isClosed() {
    return this.#controller.signal.aborted;
  }

  /**
   * What a view shows now, each tile in the features' colours.
   *
   * @param {import('./choose.js').Quad[]} quads
   * @param {(loaded: LoadedTile, rows: [number, number][]) => void} send rows of texels that have changed
   */
  update(quads, send) {
    this.shown = (!this.isClosed && this.client?.update(quads)) || [];
    for (const loaded of new Set(this.shown.map((one) => one.loaded))) {
      const rows = this.colors.apply(loaded);
      if (rows.length) send(loaded, rows);
    }
    return this.shown;
  }

  /**
   * The feature that is seen at a place; null where nothing is, or nothing is loaded.
   *
   * @param {{ lng: number, lat: number } | [number, number]} place in degrees
   * @returns {Feature | null}
   */
  featureAt(place) {
    const [x, y] = mercator(...placeOf(place));
    const loaded = this.#tileAt(x, y);
    if (!loaded?.data || !this.client) return null;
    const { data, tile } = loaded;
    const edge = 2 ** -tile.z / ROUNDED; // what is cut off at the grid's end may end before it
    const [u, v] = squareOf(x, Math.min(Math.max(y, edge), 1 - edge), tile, this.client.source.margin);
    const found = elementAt(data, 0, data.roots.length, u, v);
    return found?.name && this.colors.isSeen(found.name) ? { id: found.name } : null;
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  #tileAt(x, y) {
    const at = (/** @type {number} */ z) => ({ z, x: Math.floor(x * 2 ** z), y: Math.floor(y * 2 ** z) });
    const seen = this.shown.find(({ quad }) => {
      const here = at(quad.z);
      return here.x === quad.x && here.y === quad.y;
    });
    if (seen) return seen.loaded;
    const zooms = [...(this.client?.source.zooms ?? [])].reverse();
    const deepest = at(zooms[0] ?? 0);
    return zooms.map((z) => this.client?.get(ancestor(deepest, z))).find((one) => one?.state === 'ready');
  }

  dispose() {
    this.#controller.abort();
    this.client?.dispose();
    this.shown = [];
  }
}
