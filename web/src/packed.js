// Reads a packed texture from its file (FORMAT.md, parts B and D) and validates all that a shader relies on.
import {
  ENCODING_PACKED,
  MAP_VERSION,
  PACKED_FILE_LIMIT,
  PACKED_VERSION,
  PICTURE_VERSION,
  TEXT_ENCODING,
  TEXT_NAME,
  TEXT_ROOTS,
  TEXT_STYLES,
  TEXT_VERSION,
} from '../generated/layout.js';
import { checkForest } from './check-texels.js';
import { REMEDY, VextureError, line } from './errors.js';
import { readKtx2 } from './ktx2.js';
import { checkContents } from './mistaken.js';
import { mapParts } from './maps.js';
import { readRoots, versionOf } from './read-roots.js';

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
    checkContents(file);
    if (file.byteLength > PACKED_FILE_LIMIT) {
      throw new VextureError(`longer than ${PACKED_FILE_LIMIT} bytes, so not a texture; ${REMEDY}`, 'byteLength');
    }
    const { width, height, texels, texts, values } = await readKtx2(file);
    checkKnown(texts, TEXT_ENCODING, [ENCODING_PACKED]);
    checkKnown(texts, TEXT_VERSION, [PACKED_VERSION, MAP_VERSION, PICTURE_VERSION]);
    const roots = await readRoots(texts.get(TEXT_ROOTS) ?? '', values.get(TEXT_STYLES));
    const version = texts.get(TEXT_VERSION);
    if ((version === PACKED_VERSION) === roots.some(({ isMap }) => isMap)) {
      throw new VextureError(`${TEXT_VERSION} is "${version}"; with maps it is "${MAP_VERSION}", without "${PACKED_VERSION}"; ${REMEDY}`, TEXT_VERSION);
    }
    checkForest(texels, roots);
    for (const root of roots) if (root.isMap) mapParts().checkPaintsOf(root, texels);
    if (version !== versionOf(roots)) {
      const known = `with pictures it is "${PICTURE_VERSION}", without "${MAP_VERSION}"`;
      throw new VextureError(`${TEXT_VERSION} is "${version}"; ${known}; ${REMEDY}`, TEXT_VERSION);
    }
    return { encoding: 'packed', name: texts.get(TEXT_NAME) || name, width, height, texels, roots };
  } catch (error) {
    throw error instanceof VextureError ? error.in(name) : error;
  }
}

/**
 * @param {Map<string, string>} texts
 * @param {string} key
 * @param {string[]} known
 */
function checkKnown(texts, key, known) {
  const found = texts.get(key);
  if (found !== undefined && known.includes(found)) return;
  const read = known.map((one) => `"${one}"`).join(' and ');
  throw new VextureError(`${key} is ${line(found)}; this package reads ${read}; update it or ${REMEDY}`, key);
}
