import { Loader } from 'three';
import { VextureError, line } from './errors.js';
import { fetchBytes, progressEvent } from './fetching.js';

/**
 * @typedef {ArrayBuffer | Uint8Array} Bytes contents of a file
 * @typedef {(event: ProgressEvent) => void} OnProgress called during loading, with the bytes loaded so far and in total
 * @typedef {{ signal: AbortSignal, onProgress?: OnProgress }} Request
 */

/** Addresses that carry their content and therefore have no file name. */
const NAMELESS = /^(data|blob):/;

/** Absolute addresses, which do not get the loader's path as a prefix. */
const ABSOLUTE = /^([a-z][a-z\d+.-]+:|\/\/)/i;

/**
 * Split an address into a part without query and fragment, and these.
 *
 * @param {string} url
 */
export function divided(url) {
  const end = NAMELESS.test(url) ? url.length : url.search(/[?#]|$/);
  return { path: url.slice(0, end), rest: url.slice(end) };
}

/**
 * Name a texture by its address: the file name without its suffix.
 *
 * @param {string} url
 * @param {string[]} suffixes
 */
export function nameOf(url, suffixes) {
  if (NAMELESS.test(url)) return 'texture';
  const file = divided(url).path.split('/').at(-1) ?? '';
  const suffix = suffixes.find((one) => file.endsWith(one)) ?? '';
  const name = file.slice(0, file.length - suffix.length);
  try {
    return decodeURIComponent(name) || 'texture';
  } catch {
    return name;
  }
}

/** @param {number[]} numbers */
const sum = (numbers) => numbers.reduce((one, other) => one + other, 0);

/**
 * Base of the loaders of all encodings: requests with progress, limits and `abort`.
 *
 * @template Texture
 * @template Url
 * @extends {Loader<Texture, Url>}
 */
export class BaseLoader extends Loader {
  #controller = new AbortController();

  /**
   * Load a file, and pass on its content.
   *
   * @param {Url} url
   * @param {(texture: Texture) => void} onLoad
   * @param {OnProgress} [onProgress]
   * @param {(error: unknown) => void} [onError] called with an error; by default it is logged to the console
   */
  load(url, onLoad, onProgress, onError = console.error) {
    this.loadAsync(url, onProgress).then(onLoad, onError);
  }

  /** Stop all requests; each rejects with an `AbortError`. @returns {this} */
  abort() {
    this.#controller.abort();
    this.#controller = new AbortController();
    return this;
  }

  /**
   * Resolve the address of a file by the loader's path and its manager's rules.
   *
   * @param {string} url
   * @throws {VextureError} if it is not an address
   */
  addressOf(url) {
    if (typeof url !== 'string' || !url.trim()) { // '' would be the page itself
      throw new VextureError(`the address is ${line(url)}; give that of a file, a text such as 'logo.ktx2'`, 'url');
    }
    return this.manager.resolveURL(ABSOLUTE.test(url) ? url : this.path + url);
  }

  /** Headers, credentials, cache mode and priority of requests. @internal */
  requestOptions() {
    return {
      headers: this.requestHeader,
      credentials: /** @type {RequestCredentials} */ (this.withCredentials ? 'include' : 'same-origin'),
      cache: this.cache ?? 'default', // neither exists in three 0.163
      priority: this.priority ?? 'auto',
    };
  }

  /**
   * Start a request that the caller's signal, the loader's `abort` or its manager's `abort` ends.
   *
   * @protected
   * @param {OnProgress} [onProgress]
   * @param {AbortSignal} [signal]
   * @returns {Request}
   */
  startRequest(onProgress, signal) {
    const signals = [this.#controller.signal];
    if (signal) signals.unshift(signal);
    if (this.manager.abortController) signals.push(this.manager.abortController.signal); // in newer three
    return { signal: typeof AbortSignal.any === 'function' ? AbortSignal.any(signals) : signals[0], onProgress };
  }

  /**
   * Fetch files in parallel.
   *
   * @protected
   * @param {string[]} urls
   * @param {number} most bytes of each
   * @param {Request} request
   */
  async fetchAll(urls, most, { signal, onProgress }) {
    const addresses = urls.map((url) => this.addressOf(url)); // before any is asked for
    const loaded = urls.map(() => 0);
    const totals = urls.map(() => 0);
    return Promise.all(
      addresses.map((address, place) =>
        this.#fetchOne(address, signal, most, (bytes, total) => {
          loaded[place] = bytes;
          totals[place] = total;
          onProgress?.(progressEvent(sum(loaded), totals.every(Boolean) ? sum(totals) : 0));
        }),
      ),
    );
  }

  /**
   * @param {string} address
   * @param {AbortSignal} signal
   * @param {number} most
   * @param {import('./fetching.js').OnBytes} onBytes
   */
  async #fetchOne(address, signal, most, onBytes) {
    this.manager.itemStart(address);
    try {
      return await fetchBytes(address, { signal, ...this.requestOptions() }, most, onBytes);
    } catch (error) {
      this.manager.itemError(address);
      throw error;
    } finally {
      this.manager.itemEnd(address);
    }
  }
}
