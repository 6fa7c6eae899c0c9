// Inflating what strangers deflated, by the platform's own inflater.
import { REMEDY, VextureError, line } from './errors.js';

/** Bytes that one byte of a deflate stream can become at most (zlib's technical details). */
const DEFLATE_RATIO = 1032;

/** Bytes handed to the inflater at once, which may hand out all that they become: 1032 times as many. */
const SLICE = 1 << 14;

/**
 * Inflate to so many bytes; memory is taken for no more, but for what one slice becomes.
 *
 * @param {Uint8Array} stored zlib stream (RFC 1950)
 * @param {number} size bytes that it must become
 * @param {string} field names it in errors
 * @returns {Promise<ArrayBuffer>}
 */
export async function inflate(stored, size, field) {
  if (size > DEFLATE_RATIO * (stored.length + 1)) {
    throw new VextureError(`${field}: ${stored.length} bytes; they cannot inflate to ${size}; ${REMEDY}`, field);
  }
  let at = 0;
  /** @type {ReadableStream<BufferSource>} */
  const slices = new ReadableStream({
    pull(controller) {
      controller.enqueue(/** @type {Uint8Array<ArrayBuffer>} */ (stored.subarray(at, at + SLICE)));
      at += SLICE;
      if (at >= stored.length) controller.close();
    },
  });
  const raw = new Uint8Array(size);
  let filled = 0;
  const reader = slices.pipeThrough(new DecompressionStream('deflate')).getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (filled + value.length > size) {
        throw new VextureError(`${field} inflates to more than ${size} bytes; ${REMEDY}`, field);
      }
      raw.set(value, filled);
      filled += value.length;
    }
  } catch (error) {
    reader.cancel().catch(() => {}); // what the stream says of its own end is no news
    if (error instanceof VextureError) throw error;
    throw new VextureError(`${field} cannot be inflated (${line(error)}); ${REMEDY}`, field, { cause: error });
  }
  if (filled !== size) {
    throw new VextureError(`${field} inflates to ${filled} bytes; it must be ${size}; ${REMEDY}`, field);
  }
  return raw.buffer;
}
