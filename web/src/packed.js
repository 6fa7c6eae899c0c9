// Reads a packed texture from its file (FORMAT.md, part B) and validates all that a shader relies on.
import {
  ENCODING_PACKED,
  PACKED_FILE_LIMIT,
  PACKED_VERSION,
  TEXT_ENCODING,
  TEXT_NAME,
  TEXT_ROOTS,
  TEXT_VERSION,
} from '../generated/layout.js';
import { checkForest } from './check-texels.js';
import { REMEDY, VextureError, line } from './errors.js';
import { readKtx2 } from './ktx2.js';
import { readRoots } from './read-roots.js';

/**
 * Read and validate a packed texture.
 *
 * @param {ArrayBuffer | Uint8Array} file
 * @param {string} [name] name for messages, and for the texture if the file has none
 * @returns {Promise<import('./data.js').PackedData>}
 * @throws {VextureError} if the file is damaged or violates the format
 */
export async function readPacked(file, name = 'texture') {
  try {
    if (!(file?.byteLength >= 0)) throw new VextureError(`contents are ${line(file)}; give a file's bytes`, 'contents');
    if (file.byteLength > PACKED_FILE_LIMIT) {
      throw new VextureError(`longer than ${PACKED_FILE_LIMIT} bytes, so not a texture; ${REMEDY}`, 'byteLength');
    }
    const { width, height, texels, texts } = await readKtx2(file);
    for (const [key, known] of [
      [TEXT_ENCODING, ENCODING_PACKED],
      [TEXT_VERSION, PACKED_VERSION],
    ]) {
      if (texts.get(key) !== known) {
        throw new VextureError(
          `${key} is ${line(texts.get(key))}; this package reads "${known}"; update it or ${REMEDY}`,
          key,
        );
      }
    }
    const roots = readRoots(texts.get(TEXT_ROOTS) ?? '');
    checkForest(
      texels,
      roots.map((root) => root.quad),
    );
    return { encoding: 'packed', name: texts.get(TEXT_NAME) || name, width, height, texels, roots };
  } catch (error) {
    throw error instanceof VextureError ? error.in(name) : error;
  }
}
