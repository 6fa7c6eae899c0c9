// HTTP requests with progress, size limits and errors that name the address and the cause.
import { VextureError, line } from './errors.js';

/**
 * @typedef {object} FetchOptions
 * @property {AbortSignal} signal
 * @property {Record<string, string>} [headers]
 * @property {RequestCredentials} [credentials]
 * @property {RequestCache} [cache]
 * @property {'high' | 'low' | 'auto'} [priority]
 */

/**
 * @callback OnBytes
 * @param {number} loaded
 * @param {number} total 0 if it is not known
 * @returns {void}
 */

/** Node.js has no ProgressEvent. */
const ProgressEventClass =
  globalThis.ProgressEvent ??
  class ProgressEvent extends Event {
    /** @param {string} type @param {ProgressEventInit} init */
    constructor(type, { lengthComputable, loaded, total }) {
      super(type);
      Object.assign(this, { lengthComputable, loaded, total });
    }
  };

/**
 * @param {number} loaded
 * @param {number} total 0 if it is not known
 * @returns {ProgressEvent}
 */
export function progressEvent(loaded, total) {
  return /** @type {ProgressEvent} */ (new ProgressEventClass('progress', { lengthComputable: total > 0, loaded, total }));
}

/**
 * A successful response.
 *
 * @param {string} url
 * @param {FetchOptions} options
 * @param {number[]} [accepted] further status codes
 */
export async function fetchResponse(url, options, accepted = []) {
  let response;
  try {
    response = await fetch(url, options);
  } catch (error) {
    throw failure(url, options.signal, error);
  }
  if (!response.ok && !accepted.includes(response.status)) {
    response.body?.cancel().catch(() => {});
    const status = `HTTP ${response.status} ${response.statusText}`.trim();
    throw new VextureError(`${shown(url)}: ${status}; check the address and the server`, `status ${response.status}`);
  }
  return response;
}

/**
 * The bytes of a file.
 *
 * @param {string} url
 * @param {FetchOptions} options
 * @param {number} most bytes; a longer file is not read to its end
 * @param {OnBytes} [onBytes]
 */
export async function fetchBytes(url, options, most, onBytes) {
  const response = await fetchResponse(url, options);
  const said = response.headers.has('Content-Encoding') ? 0 : Number(response.headers.get('Content-Length')) || 0;
  const parts = [];
  let loaded = 0;
  try {
    const reader = /** @type {ReadableStream<Uint8Array<ArrayBuffer>>} */ (response.body ?? new Blob([]).stream()).getReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      loaded += value.length;
      if (Math.max(loaded, said) > most) {
        reader.cancel().catch(() => {});
        throw new VextureError(`${shown(url)}: longer than ${most} bytes, so not a texture; check the address`, 'byteLength');
      }
      parts.push(value);
      onBytes?.(loaded, said);
    }
  } catch (error) {
    throw error instanceof VextureError ? error : failure(url, options.signal, error);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/**
 * The content of a file on this machine, in Node.js; null for other addresses, and in pages, which may not read it.
 *
 * @param {string} url
 * @param {number} most bytes
 * @returns {Promise<Uint8Array<ArrayBuffer> | null>}
 * @throws {VextureError} if it cannot be read, or is longer
 */
export async function fileBytes(url, most) {
  if (!url.startsWith('file:') || !('process' in globalThis)) return null;
  const files = 'node:fs/promises'; // a name that bundlers of pages leave alone
  const { readFile, stat } = await import(/* @vite-ignore */ /* webpackIgnore: true */ files);
  const place = new URL(url);
  try {
    const { size } = await stat(place);
    if (size > most) throw new VextureError(`${url}: longer than ${most} bytes; check the address`, 'byteLength');
    return new Uint8Array(await readFile(place));
  } catch (error) {
    throw error instanceof VextureError ? error : new VextureError(`${url}: cannot be read (${line(error)}); check the address`, 'url', { cause: error });
  }
}

/**
 * Return whether an error means that a file could not be fetched, as opposed to invalid content.
 *
 * @param {unknown} error
 */
export function isTransport(error) {
  return !(error instanceof VextureError) || error.field === 'url' || error.field.startsWith('status ');
}

/**
 * @param {string} url
 * @param {AbortSignal} signal
 * @param {unknown} error
 */
function failure(url, signal, error) {
  if (signal.aborted) return error; // as three's loaders do: an AbortError stays one
  const cause = error instanceof Error && error.cause instanceof Error ? error.cause : error;
  // scripts in a browser cannot tell a refusal by CORS from a dead server
  const remedy = "check the address, the network and, for another site, the server's Access-Control-Allow-Origin (CORS)";
  return new VextureError(`${shown(url)}: cannot be fetched (${line(cause)}); ${remedy}`, 'url', { cause: error });
}

/**
 * Format an address for a message; data addresses are cut, because they contain the whole file.
 *
 * @param {string} url
 */
export function shown(url) {
  return url.startsWith('data:') ? `${url.slice(0, 40)}...` : url;
}
