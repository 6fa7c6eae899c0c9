// The glTF extension as JSON, validated because everything in a model is untrusted (FORMAT.md, E).
import { PACKED_FILE_LIMIT } from '../../generated/layout.js';
import { WRAPS } from '../../generated/wraps.js';
import { VextureError, line } from '../errors.js';
import { BACKGROUNDS, CHANNELS, MODES } from '../mask-options.js';

export const EXTENSION = 'VEXTURE_vector_texture';

const MIME_TYPE = 'image/ktx2';

/** Starts of `data:` addresses that can hold a texture. */
const DATA = Object.freeze([`data:${MIME_TYPE};base64,`, 'data:application/octet-stream;base64,']);

/** Characters of base64 for one byte. */
const BASE64_RATIO = 4 / 3;

/** Characters of an address that is not `data:`. */
const LONGEST_URI = 2048;

/**
 * @typedef {object} TextureSource Location of a texture's file, in one of three forms.
 * @property {string} where its place in the model, for messages
 * @property {string} [uri] relative to the model
 * @property {string} [base64] the file itself
 * @property {number} [bufferView]
 * @property {string} [name]
 *
 * @typedef {object} MaterialMask Mask of a material.
 * @property {string} where its place in the model, for messages
 * @property {number} texture index in the list of textures
 * @property {string | number} [root]
 * @property {'alpha' | 'mix' | 'cut' | 'paint'} mode
 * @property {'none' | 'clamp' | 'repeat'} wrap
 * @property {boolean} invert
 * @property {'own' | 'none'} background
 * @property {readonly [number, number, number]} color linear
 * @property {number} threshold
 * @property {0 | 1} texCoord
 * @property {import('../gltf-transform.js').GLTFTransform} transform
 */

/**
 * @param {string} where
 * @param {unknown} value
 * @param {string} remedy
 * @returns {never}
 */
function refuse(where, value, remedy) {
  throw new VextureError(`${where} is ${line(value)}; ${remedy}`, where);
}

/**
 * @param {unknown} value
 * @param {string} where
 * @returns {Record<string, unknown>}
 */
function objectOf(value, where) {
  if (typeof value === 'object' && value !== null && !Array.isArray(value)) return /** @type {Record<string, unknown>} */ (value);
  return refuse(where, value, 'it must be an object');
}

/**
 * @param {unknown} value
 * @param {number} count
 * @param {string} where
 */
function placeOf(value, count, where) {
  if (Number.isInteger(value) && Number(value) >= 0 && Number(value) < count) return Number(value);
  return refuse(where, value, count > 0 ? `it must be a whole number, 0 to ${count - 1}` : 'the model has none');
}

/**
 * @template T
 * @param {unknown} value
 * @param {readonly T[]} allowed the first of them by default
 * @param {string} where
 * @returns {T}
 */
function oneOf(value, allowed, where) {
  if (value === undefined) return allowed[0];
  if (allowed.includes(/** @type {T} */ (value))) return /** @type {T} */ (value);
  return refuse(where, value, `it must be one of ${allowed.join(', ')}`);
}

/**
 * @param {unknown} value
 * @param {readonly number[]} otherwise its length is that of the list
 * @param {string} where
 * @param {(number: number) => boolean} [isAllowed]
 * @param {string} [what]
 */
function numbersOf(value, otherwise, where, isAllowed = Number.isFinite, what = 'finite numbers') {
  if (value === undefined) return otherwise;
  const isRight = Array.isArray(value) && value.length === otherwise.length && value.every((one) => isAllowed(one));
  return isRight ? /** @type {number[]} */ (value) : refuse(where, value, `it must be ${otherwise.length} ${what}`);
}

/** @param {unknown} value whether it is a number from 0 to 1 */
const isPart = (value) => typeof value === 'number' && value >= 0 && value <= 1;

/**
 * @param {unknown} value
 * @param {string} where
 */
function textOf(value, where) {
  if (value === undefined || typeof value === 'string') return value;
  return refuse(where, value, 'it must be a text');
}

/**
 * Check that an address stays in the folder of the model, on the same server.
 *
 * @param {string} uri
 * @param {string} where
 */
function checkRelative(uri, where) {
  if (uri.length === 0 || uri.length > LONGEST_URI) refuse(where, uri, `it must have 1 to ${LONGEST_URI} characters`);
  let plain = uri;
  try {
    plain = decodeURIComponent(uri);
  } catch {
    refuse(where, uri, 'its escapes must be those of UTF-8');
  }
  const isOutside = /^[/\\]|^[a-z][a-z\d+.-]*:|\\|(^|\/)\.\.(\/|$)|[\p{Cc}?#]/iu;
  if (isOutside.test(plain) || /[?#]/.test(uri)) {
    refuse(where, uri, 'it must be data: or the name of a file beside the model or in a folder there');
  }
}

/**
 * @param {string} uri
 * @param {string} where
 * @returns {Pick<TextureSource, 'uri' | 'base64'>}
 */
function addressOf(uri, where) {
  if (!/^data:/i.test(uri)) {
    checkRelative(uri, where);
    return { uri };
  }
  const start = DATA.find((one) => uri.startsWith(one));
  if (start === undefined) return refuse(where, uri, `it must begin with ${DATA.join(' or ')}`);
  if (uri.length - start.length > BASE64_RATIO * PACKED_FILE_LIMIT + 4) {
    refuse(where, uri, `it must hold no more than ${PACKED_FILE_LIMIT} bytes`);
  }
  return { base64: uri.slice(start.length) };
}

/**
 * @param {unknown} value
 * @param {string} where
 * @param {any} json
 * @returns {TextureSource}
 */
function readSource(value, where, json) {
  const given = objectOf(value, where);
  const name = textOf(given.name, `${where}.name`);
  if ((given.uri === undefined) === (given.bufferView === undefined)) {
    throw new VextureError(`${where} must have either uri or bufferView; export the model again`, where);
  }
  if (given.uri !== undefined) {
    const uri = /** @type {string} */ (textOf(given.uri, `${where}.uri`));
    return { where, name, ...addressOf(uri, `${where}.uri`) };
  }
  if (given.mimeType !== MIME_TYPE) refuse(`${where}.mimeType`, given.mimeType, `it must be ${MIME_TYPE}`);
  const views = Array.isArray(json.bufferViews) ? json.bufferViews : [];
  const bufferView = placeOf(given.bufferView, views.length, `${where}.bufferView`);
  const bytes = views[bufferView]?.byteLength;
  if (!(bytes <= PACKED_FILE_LIMIT)) refuse(`bufferViews[${bufferView}].byteLength`, bytes, `it must be at most ${PACKED_FILE_LIMIT}`);
  return { where, name, bufferView };
}

/**
 * Read the textures of a model.
 *
 * @param {any} json
 * @returns {TextureSource[]}
 * @throws {VextureError} if the list is invalid
 */
export function readSources(json) {
  const given = json.extensions?.[EXTENSION];
  if (given === undefined) return [];
  const { textures } = objectOf(given, EXTENSION);
  if (!Array.isArray(textures)) return refuse(`${EXTENSION}.textures`, textures, 'it must be a list');
  return textures.map((one, place) => readSource(one, `${EXTENSION}.textures[${place}]`, json));
}

/**
 * @param {unknown} value
 * @param {string} where
 * @returns {import('../gltf-transform.js').GLTFTransform}
 */
function readTransform(value, where) {
  const { offset, rotation, scale } = objectOf(value ?? {}, where);
  const pair = (/** @type {unknown} */ one, /** @type {[number, number]} */ otherwise, /** @type {string} */ name) =>
    /** @type {readonly [number, number]} */ (/** @type {unknown} */ (numbersOf(one, otherwise, `${where}.${name}`)));
  const [angle] = numbersOf(rotation === undefined ? undefined : [rotation], [0], `${where}.rotation`);
  return { offset: pair(offset, [0, 0], 'offset'), rotation: angle, scale: pair(scale, [1, 1], 'scale') };
}

/**
 * Read the mask of a material; null without the extension.
 *
 * @param {any} definition of the material
 * @param {number} place of the material
 * @param {number} count of textures
 * @returns {MaterialMask | null}
 * @throws {VextureError} if the extension is invalid
 */
export function readMaterial(definition, place, count) {
  const given = definition?.extensions?.[EXTENSION];
  if (given === undefined) return null;
  const name = typeof definition.name === 'string' ? definition.name : '';
  const where = `material ${name ? line(name) : place}: ${EXTENSION}`;
  const { root, mode, invert, threshold, ...rest } = objectOf(given, where);
  if (root !== undefined && typeof root !== 'string' && !(Number.isInteger(root) && Number(root) >= 0)) {
    refuse(`${where}.root`, root, 'it must be the name or the place of a shape');
  }
  if (mode === undefined) refuse(`${where}.mode`, mode, `it must be one of ${MODES.join(', ')}`);
  if (threshold !== undefined && !isPart(threshold)) refuse(`${where}.threshold`, threshold, 'it must be a number, 0 to 1');
  const color = numbersOf(rest.color, [1, 1, 1], `${where}.color`, isPart, 'numbers, each 0 to 1');
  return {
    where,
    texture: placeOf(rest.texture, count, `${where}.texture`),
    root: /** @type {string | number | undefined} */ (root),
    mode: /** @type {MaterialMask['mode']} */ (oneOf(mode, MODES, `${where}.mode`)),
    wrap: oneOf(rest.wrap, /** @type {(keyof typeof WRAPS)[]} */ (Object.keys(WRAPS)), `${where}.wrap`),
    invert: oneOf(invert, [false, true], `${where}.invert`),
    background: /** @type {'own' | 'none'} */ (oneOf(rest.background, BACKGROUNDS, `${where}.background`)),
    color: /** @type {readonly [number, number, number]} */ (/** @type {unknown} */ (color)),
    threshold: /** @type {number} */ (threshold ?? 0.5),
    texCoord: /** @type {0 | 1} */ (oneOf(rest.texCoord, CHANNELS, `${where}.texCoord`)),
    transform: readTransform(rest.transform, `${where}.transform`),
  };
}
