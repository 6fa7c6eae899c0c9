import { VextureError } from './errors.js';
import { hasStreams, listen } from './event-stream.js';
import { fetchResponse, isTransport } from './fetching.js';
import { parsed } from './json.js';
import { withTimeLimit } from './patience.js';

/**
 * @typedef {object} Manifest A server's description of a shape; its addresses are relative to its own.
 * @property {string} name of the shape
 * @property {string} version changes with the data
 * @property {string} texture address of its packed texture
 * @property {string} [events] address of the stream of events
 * @property {string | null} [note] reason why the last update was refused
 * @property {Record<string, unknown>} [facts] about the drawing and its texture
 * @property {Record<string, string | string[]>} [views] addresses of other files about the shape on the server
 */

const NOT_MODIFIED = 304;

/** Attempts at a texture that is replaced between the request for its manifest and its own. */
const OVERTAKEN = 3;

/** A shape on a server: its manifest, its texture, its events. */
export class Source {
  /** @type {Manifest} */
  manifest = { name: '', version: '', texture: '' };
  #etag = '';
  #loaded = '';
  #loader;
  #url;

  /**
   * @param {string} url of the manifest
   * @param {import('./vector-texture-loader.js').VectorTextureLoader} loader
   */
  constructor(url, loader) {
    const base = globalThis.document?.baseURI ?? globalThis.location?.href;
    const address = loader.addressOf(url);
    try {
      this.#url = new URL(address, base).href;
    } catch (error) {
      throw new VextureError(`${address}: no address; give one such as https://example.org/shapes/duck`, 'url', {
        cause: error,
      });
    }
    this.#loader = loader;
  }

  /** Whether the server has an event stream and the platform has EventSource. */
  get hasEvents() {
    return this.manifest.events !== undefined && hasStreams();
  }

  /**
   * Listen to the server's events.
   *
   * @param {import('./event-stream.js').Listener} listener
   * @returns {() => void} ends it
   */
  listen(listener) {
    const url = new URL(/** @type {string} */ (this.manifest.events), this.#url);
    return listen(url, this.#loader.withCredentials, listener);
  }

  /**
   * Request the manifest.
   *
   * @param {AbortSignal} signal
   * @returns {Promise<boolean>} whether it is another one than before
   */
  async look(signal) {
    const { headers, ...options } = this.#loader.requestOptions();
    const limited = withTimeLimit(signal, this.#url);
    try {
      const asking = this.#etag ? { ...headers, 'If-None-Match': this.#etag } : headers;
      const request = { ...options, headers: asking, signal: limited.signal, cache: /** @type {const} */ ('no-store') };
      const response = await fetchResponse(this.#url, request, [NOT_MODIFIED]);
      if (response.status === NOT_MODIFIED) return false;
      this.manifest = checked(parsed(await response.text()), this.#url);
      this.#etag = response.headers.get('ETag') ?? '';
      return true;
    } finally {
      limited.done();
    }
  }

  /** Whether the manifest's texture has been loaded, or refused as damaged. */
  get isLoaded() {
    return this.#loaded === this.manifest.texture;
  }

  /**
   * Whether this version is the loaded one.
   *
   * @param {unknown} version
   */
  has(version) {
    return this.isLoaded && this.manifest.version === version;
  }

  /**
   * Load the manifest's texture.
   *
   * @param {AbortSignal} signal
   */
  async load(signal) {
    for (let attempt = 1; ; attempt++) {
      const { texture } = this.manifest;
      try {
        const data = await this.#loader.loadData(new URL(texture, this.#url).href, undefined, signal);
        this.#loaded = texture;
        return data;
      } catch (error) {
        if (!isTransport(error)) this.#loaded = texture;
        const isGone = error instanceof VextureError && error.field === 'status 404';
        if (isTransport(error)) this.#etag = ''; // so that the next request is answered in full
        if (!isGone || attempt === OVERTAKEN) throw error;
        await this.look(signal);
      }
    }
  }
}

/**
 * @param {any} manifest
 * @param {string} url
 * @returns {Manifest}
 */
function checked(manifest, url) {
  for (const field of ['name', 'version', 'texture']) {
    if (typeof manifest?.[field] !== 'string') {
      throw new VextureError(`${url}: is no manifest (its ${field} is no text); check the address`, `manifest.${field}`);
    }
  }
  return manifest;
}
