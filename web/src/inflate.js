// Inflates untrusted zlib streams with the platform's DecompressionStream.
import { REMEDY, VextureError, line } from './errors.js';

/** Largest compression ratio of deflate (zlib, "Technical Details"). */
const DEFLATE_RATIO = 1032;

/** Bytes passed to the inflater at once; it may return 1032 times as many in one piece. */
const SLICE = 1 << 14;

/**
 * Inflate to a known size. Memory is bounded by that size and the output of one slice.
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
    reader.cancel().catch(() => {}); // the error above already says what is wrong
    if (error instanceof VextureError) throw error;
    throw new VextureError(`${field} cannot be inflated (${line(error)}); ${REMEDY}`, field, { cause: error });
  }
  if (filled !== size) {
    throw new VextureError(`${field} inflates to ${filled} bytes; it must be ${size}; ${REMEDY}`, field);
  }
  return raw.buffer;
}
