// The content of a source: text, bytes, a file, or an address, plain or gzipped.
import { VextureError, line, unfit } from '../errors.js';
import { LONGEST } from './parse.js';

/** Declaration of a multi-byte encoding in single-byte characters: it is wrong, and browsers read UTF-8. */
const WIDE = /^(?:utf-?(?:16|32)|(?:iso-10646-)?ucs-?[24])/i;

/**
 * Load the markup of an SVG, as `loadContent` does.
 *
 * @param {Parameters<typeof loadContent>[0]} source
 * @param {{ signal?: AbortSignal }} [options]
 * @returns {Promise<string>}
 * @throws {VextureError} if it cannot be fetched, or is too large
 */
export async function loadMarkup(source, options) {
  return textOf(await loadContent(source, options));
}

/**
 * Load the content of a file.
 *
 * @param {string | Blob | ArrayBuffer | Uint8Array | URL | Response} source a text is markup, not an address
 * @param {{ signal?: AbortSignal }} [options]
 * @returns {Promise<string | Uint8Array<ArrayBuffer>>} text only if it is given
 * @throws {VextureError} if it cannot be fetched, or is too large
 */
export async function loadContent(source, { signal } = {}) {
  if (typeof source === 'string') return source;
  if (source instanceof URL) {
    return loadContent(await load(source, signal)).catch((error) => {
      signal?.throwIfAborted(); // its reason, not that the file has no end
      throw error;
    });
  }
  if (source instanceof Response) {
    if (!source.ok) throw new VextureError(`${line(source.url)} answers ${source.status}; check the address`, 'source');
    return unpacked(source.body ?? new Blob().stream());
  }
  if (source instanceof Blob) return unpacked(source.stream());
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) {
    return unpacked(new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (source)]).stream());
  }
  throw unfit('source', source, 'give the text of an SVG, a Blob, a URL, or an <svg> of the page');
}

/** @param {URL} url @param {AbortSignal | undefined} signal @returns {Promise<Response>} */
async function load(url, signal) {
  try {
    return await fetch(url, { signal });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new VextureError(
      `${line(url.href)} cannot be loaded (${line(error)}); check the address`,
      'source', { cause: error },
    );
  }
}

/** @param {ReadableStream<Uint8Array<ArrayBuffer>>} stream @returns {Promise<Uint8Array<ArrayBuffer>>} */
async function unpacked(stream) {
  const bytes = await collect(stream);
  const isPacked = bytes[0] === 0x1f && bytes[1] === 0x8b;
  return isPacked ? collect(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))) : bytes;
}

/** @param {string | Uint8Array} content of a file of text @returns {string} */
export function textOf(content) {
  return typeof content === 'string' ? content : new TextDecoder(encodingOf(content)).decode(content);
}

/** @param {ReadableStream<Uint8Array<ArrayBuffer>>} stream @returns {Promise<Uint8Array<ArrayBuffer>>} */
async function collect(stream) {
  const parts = [];
  let size = 0;
  const reader = stream.getReader();
  try {
    for (let { done, value } = await reader.read(); !done; { done, value } = await reader.read()) {
      const part = /** @type {Uint8Array<ArrayBuffer>} */ (value);
      size += part.length;
      if (size > LONGEST) {
        throw new VextureError(
          `the file is larger than ${LONGEST.toLocaleString('en-US')} bytes; simplify or split the drawing`,
          'size',
        );
      }
      parts.push(part);
    }
  } catch (error) {
    reader.cancel().catch(() => {}); // the error already says what is wrong
    if (error instanceof VextureError) throw error;
    throw new VextureError(`the file cannot be read (${line(error)}); check it`, 'source', { cause: error });
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** @param {Uint8Array} bytes @returns {string} by the byte order mark, or the declaration of XML */
function encodingOf(bytes) {
  if (bytes[0] === 0xff && bytes[1] === 0xfe) return 'utf-16le';
  if (bytes[0] === 0xfe && bytes[1] === 0xff) return 'utf-16be';
  const head = String.fromCharCode(...bytes.subarray(0, 200));
  const name = /^\s*<\?xml\s[^>]*encoding\s*=\s*["']([\w.:-]+)/.exec(head)?.[1] ?? 'utf-8';
  if (WIDE.test(name)) return 'utf-8';
  try {
    return new TextDecoder(name).encoding;
  } catch { // an unknown encoding
    return 'utf-8';
  }
}
