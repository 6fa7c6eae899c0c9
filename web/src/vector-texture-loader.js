import { Loader } from 'three';
import { CURVES_SUFFIX, FILE_LIMIT, PACKED_FILE_LIMIT, PACKED_SUFFIX, QUADS_SUFFIX } from '../generated/layout.js';
import { VextureError, line } from './errors.js';
import { fetchBytes, isTransport, progressEvent, shown } from './fetching.js';
import { isKtx2 } from './ktx2.js';
import { readPacked } from './packed.js';
import { readThesis } from './read-thesis.js';
import { VectorTexture } from './vector-texture.js';

/**
 * @typedef {string | [string, string]} TextureUrl a KTX2 file; or a thesis pair: its common stem, either file, or both
 * @typedef {ArrayBuffer | Uint8Array} Bytes
 * @typedef {import('./data.js').TextureData} TextureData
 * @typedef {(event: ProgressEvent) => void} OnProgress
 * @typedef {{ signal: AbortSignal, onProgress?: OnProgress }} Request
 */

/** What has its content, not its name, to say what it is. */
const NAMELESS = /^(data|blob):/;

/** What needs no path in front of it. */
const ABSOLUTE = /^([a-z][a-z\d+.-]+:|\/\/)/i;

/**
 * Address in its parts: what the suffix belongs to, and the query and fragment behind it.
 *
 * @param {string} url
 */
function divided(url) {
  const end = NAMELESS.test(url) ? url.length : url.search(/[?#]|$/);
  return { path: url.slice(0, end), rest: url.slice(end) };
}

/**
 * The two addresses of a thesis pair, if this is one of them.
 *
 * @param {string} url
 * @returns {[string, string] | null}
 */
function pairOf(url) {
  const { path, rest } = divided(url);
  const suffix = [QUADS_SUFFIX, CURVES_SUFFIX].find((one) => path.endsWith(one));
  if (!suffix) return null;
  const stem = path.slice(0, -suffix.length);
  return [stem + QUADS_SUFFIX + rest, stem + CURVES_SUFFIX + rest];
}

/** What is at fault where servers answer with a page of theirs, as those of single-page programs do for any address. */
const PAGE = 'page';

/** Faults of an address at which there may still be a pair. */
const NOT_THERE = ['status 404', PAGE];

/** @param {ArrayBuffer | Uint8Array} file */
function isPage(file) {
  const start = String.fromCharCode(...new Uint8Array(file.slice(0, 64)));
  return /^\s*<(!doctype html|html)\b/i.test(start);
}

/**
 * Name of a texture by its address.
 *
 * @param {string} url
 */
function nameOf(url) {
  if (NAMELESS.test(url)) return 'texture';
  const file = divided(url).path.split('/').at(-1) ?? '';
  const suffix = [PACKED_SUFFIX, QUADS_SUFFIX, CURVES_SUFFIX].find((one) => file.endsWith(one)) ?? '';
  const name = file.slice(0, file.length - suffix.length);
  try {
    return decodeURIComponent(name) || 'texture';
  } catch {
    return name;
  }
}

/**
 * Loads packed textures (`NAME.ktx2`), and thesis textures (`NAME.quads.png` and `NAME.curves.png`).
 *
 * @extends {Loader<VectorTexture, TextureUrl>}
 */
export class VectorTextureLoader extends Loader {
  #controller = new AbortController();

  /**
   * @param {TextureUrl} url
   * @param {(texture: VectorTexture) => void} onLoad
   * @param {OnProgress} [onProgress]
   * @param {(error: unknown) => void} [onError]
   */
  load(url, onLoad, onProgress, onError = console.error) {
    this.loadData(url, onProgress).then((data) => onLoad(new VectorTexture(data)), onError);
  }

  /**
   * @param {TextureUrl} url
   * @param {OnProgress} [onProgress]
   * @returns {Promise<VectorTexture>}
   */
  async loadAsync(url, onProgress) {
    return new VectorTexture(await this.loadData(url, onProgress));
  }

  /**
   * What a file holds, read and checked, without anything of three.js.
   *
   * @param {TextureUrl} url
   * @param {OnProgress} [onProgress]
   * @param {AbortSignal} [signal] stops this one, as `abort` stops all
   * @returns {Promise<TextureData>}
   */
  async loadData(url, onProgress, signal) {
    for (const one of Array.isArray(url) ? url : [url]) {
      if (typeof one !== 'string') throw new VextureError(`the address is ${line(one)}; give one, or two of a pair`, 'url');
    }
    const signals = [this.#controller.signal];
    if (signal) signals.unshift(signal);
    if (this.manager.abortController) signals.push(this.manager.abortController.signal); // in newer three
    const request = { signal: typeof AbortSignal.any === 'function' ? AbortSignal.any(signals) : signals[0], onProgress };
    const pair = Array.isArray(url) ? url : pairOf(url);
    const data = pair ? await this.#loadPair(pair, request) : await this.#loadSingle(/** @type {string} */ (url), request);
    request.signal.throwIfAborted();
    return data;
  }

  /**
   * A texture from the contents of its file, or of the two files of a thesis pair.
   *
   * @param {Bytes | [Bytes, Bytes]} contents
   * @param {string} [name]
   * @returns {Promise<VectorTexture>}
   */
  async parse(contents, name) {
    const data = Array.isArray(contents)
      ? await readThesis(contents[0], contents[1], name)
      : await readPacked(contents, name);
    return new VectorTexture(data);
  }

  /** Stop all that is loading; each ends with an `AbortError`. */
  abort() {
    this.#controller.abort();
    this.#controller = new AbortController();
    return this;
  }

  /**
   * @param {string} url
   * @param {Request} request
   */
  async #loadSingle(url, request) {
    const [bytes, error] = await this.#fetch([url], PACKED_FILE_LIMIT, request).then(
      ([found]) => [found, null],
      (reason) => [null, reason],
    );
    const { path, rest } = divided(url);
    const isStem = !NAMELESS.test(url) && !path.endsWith(PACKED_SUFFIX);
    if (isStem && (bytes ? !isKtx2(bytes) : NOT_THERE.includes(error.field))) {
      const both = await this.#loadPair([path + QUADS_SUFFIX + rest, path + CURVES_SUFFIX + rest], request).catch(
        (reason) => reason, // a pair that is there and broken is the news; one that is not there is not
      );
      request.signal.throwIfAborted();
      if (!(both instanceof Error)) return both;
      const isThere = !isTransport(both) && !(both instanceof VextureError && both.field === PAGE);
      if (isThere) throw both;
    }
    if (!bytes) throw error;
    const data = await readPacked(bytes, shown(url));
    return data.name === shown(url) ? { ...data, name: nameOf(url) } : data;
  }

  /**
   * @param {[string, string]} urls
   * @param {Request} request
   */
  async #loadPair(urls, request) {
    const [quads, curves] = await this.#fetch(urls, FILE_LIMIT, request);
    return readThesis(quads, curves, nameOf(urls[0]));
  }

  /**
   * @param {string[]} urls
   * @param {number} most bytes of each
   * @param {Request} request
   */
  async #fetch(urls, most, { signal, onProgress }) {
    const loaded = urls.map(() => 0);
    const totals = urls.map(() => 0);
    const sum = (/** @type {number[]} */ numbers) => numbers.reduce((one, other) => one + other, 0);
    return Promise.all(
      urls.map((url, place) =>
        this.#fetchOne(url, signal, most, (bytes, total) => {
          loaded[place] = bytes;
          totals[place] = total;
          onProgress?.(progressEvent(sum(loaded), totals.every(Boolean) ? sum(totals) : 0));
        }),
      ),
    );
  }

  /**
   * @param {string} url
   * @param {AbortSignal} signal
   * @param {number} most
   * @param {import('./fetching.js').OnBytes} onBytes
   */
  async #fetchOne(url, signal, most, onBytes) {
    const resolved = this.addressOf(url);
    this.manager.itemStart(resolved);
    try {
      const bytes = await fetchBytes(resolved, { signal, ...this.requestOptions() }, most, onBytes);
      if (isPage(bytes)) throw new VextureError(`${resolved}: is a web page, not a texture; check the address`, PAGE);
      return bytes;
    } catch (error) {
      this.manager.itemError(resolved);
      throw error;
    } finally {
      this.manager.itemEnd(resolved);
    }
  }

  /**
   * Where a file lies, by the loader's path and its manager's rules.
   *
   * @param {string} url
   */
  addressOf(url) {
    return this.manager.resolveURL(ABSOLUTE.test(url) ? url : this.path + url);
  }

  /** What it asks of servers: its headers, credentials, cache mode and priority. */
  requestOptions() {
    return {
      headers: this.requestHeader,
      credentials: /** @type {RequestCredentials} */ (this.withCredentials ? 'include' : 'same-origin'),
      cache: this.cache ?? 'default', // neither is there in three 0.163
      priority: this.priority ?? 'auto',
    };
  }
}
