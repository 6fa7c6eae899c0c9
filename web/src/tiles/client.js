// The tiles of a pyramid in memory: what a view needs is loaded, what it has not used for longest goes first.
import { REMEDY, VextureError } from '../errors.js';
import { readPacked } from '../packed.js';
import { choose } from './choose.js';
import { keyOf } from './grid.js';
import { RequestQueue } from './queue.js';

/**
 * @typedef {import('./grid.js').TileId} TileId
 *
 * @typedef {object} LoadedTile A tile in memory.
 * @property {TileId} tile
 * @property {string} key
 * @property {'ready' | 'empty' | 'failed'} state
 * @property {import('../data.js').PackedData | null} data
 * @property {number} bytes of its texels
 * @property {number} used number of the view that used it last
 * @property {number} colors version of the colours that it has
 *
 * @typedef {object} TileClientOptions
 * @property {number} [budget] bytes of texels that are kept; what the view shows is never dropped
 * @property {() => void} [onChange] another tile is there: draw again
 * @property {(error: unknown, tile?: TileId) => void} [onError] a tile cannot be had, so that its parent stays; or what else fails
 * @property {(tile: LoadedTile) => void} [onDrop] a tile is dropped: free what the GPU has of it
 *
 * @typedef {TileClientOptions & import('./queue.js').QueueOptions} AllTileOptions
 */

const BUDGET = 256 * 2 ** 20;

export class TileClient {
  #options;
  /** @type {Map<string, LoadedTile>} */
  #tiles = new Map();
  /** @type {RequestQueue<TileId>} */
  #queue;
  #view = 0;
  #bytes = 0;

  /**
   * @param {import('./source.js').TileSource} source
   * @param {AllTileOptions} [options]
   */
  constructor(source, options = {}) {
    this.source = source;
    this.#options = options;
    const failed = (/** @type {TileId} */ tile, /** @type {unknown} */ error) => {
      this.#keep(tile, 'failed', null);
      options.onError?.(error, tile);
    };
    this.#queue = new RequestQueue((tile, signal) => this.#load(tile, signal), () => options.onChange?.(), failed, options);
  }

  /** Bytes of the texels in memory. */
  get bytes() {
    return this.#bytes;
  }

  /** Requests under way. */
  get running() {
    return this.#queue.running;
  }

  /** The tiles in memory. */
  get tiles() {
    return this.#tiles.values();
  }

  /**
   * A tile in memory.
   *
   * @param {TileId} tile
   */
  get(tile) {
    return this.#tiles.get(keyOf(tile));
  }

  /**
   * What a view shows now; what it lacks is asked for, and requests for all else are aborted.
   *
   * @param {import('./choose.js').Quad[]} quads
   * @returns {{ quad: import('./choose.js').Quad, loaded: LoadedTile }[]}
   */
  update(quads) {
    this.#view++;
    const { shown, wanted } = choose(quads, this.source.zooms, (key) => this.#tiles.get(key)?.state);
    for (const { key } of wanted) {
      const loaded = this.#tiles.get(key);
      if (loaded) loaded.used = this.#view;
    }
    this.#queue.want(wanted.filter(({ key }) => !this.#tiles.has(key)).map(({ key, tile }) => ({ key, item: tile })));
    this.#shrink();
    return shown.map(({ quad, tile }) => ({ quad, loaded: /** @type {LoadedTile} */ (this.get(tile)) }));
  }

  /** Ask again for the tiles that could not be had. */
  retry() {
    for (const [key, { state }] of this.#tiles) if (state === 'failed') this.#tiles.delete(key);
    this.#options.onChange?.();
  }

  /** Abort all requests, and drop all tiles. */
  dispose() {
    this.#queue.want([]);
    for (const loaded of [...this.#tiles.values()]) this.#drop(loaded);
  }

  /**
   * @param {TileId} tile
   * @param {AbortSignal} signal
   */
  async #load(tile, signal) {
    const file = await this.source.load(tile, signal);
    const data = file ? await readPacked(file, `${this.source.name ?? 'tile'} ${keyOf(tile)}`).catch(damaged) : null;
    if (!signal.aborted) this.#keep(tile, data ? 'ready' : 'empty', data);
  }

  /**
   * @param {TileId} tile
   * @param {LoadedTile['state']} state
   * @param {LoadedTile['data']} data
   */
  #keep(tile, state, data) {
    const bytes = data?.texels.byteLength ?? 0;
    const key = keyOf(tile);
    this.#tiles.set(key, { tile, key, state, data, bytes, used: this.#view, colors: 0 });
    this.#bytes += bytes;
  }

  /** Drop what was not used for longest, until the rest is within the budget. */
  #shrink() {
    const budget = this.#options.budget ?? BUDGET;
    if (this.#bytes <= budget) return;
    const old = [...this.#tiles.values()].filter(({ used, bytes }) => bytes && used < this.#view);
    for (const loaded of old.sort((one, other) => one.used - other.used)) {
      this.#drop(loaded);
      if (this.#bytes <= budget) return;
    }
  }

  /** @param {LoadedTile} loaded */
  #drop(loaded) {
    this.#tiles.delete(loaded.key);
    this.#bytes -= loaded.bytes;
    this.#options.onDrop?.(loaded);
  }
}

/** Tiles are not converted one by one. @param {any} error @returns {never} */
function damaged(error) {
  if (!(error instanceof VextureError)) throw error;
  const said = error.message.replace(REMEDY, 'copy all tiles again, or make them again');
  throw new VextureError(said, error.field, { cause: error });
}
