// Reads and validates the list of roots in a packed texture's file (FORMAT.md, B.5).
import { MAP_VERSION, MOST_STYLE_BYTES, PACKED_VERSION, PICTURE_VERSION, TEXT_ROOTS, TEXT_STYLES } from '../generated/layout.js';
import { REMEDY, VextureError, line } from './errors.js';
import { inflate } from './inflate.js';
import { loadMaps, mapParts } from './maps.js';

const MOST_INDEX = 2 ** 32;

/** Before deflated styles: the length of their text. */
const LENGTH_BYTES = 4;

/**
 * Roots from their JSON text, and their styles if these are deflated; unknown members are ignored. What maps need is
 * loaded if one is a map.
 *
 * @param {string} text
 * @param {Uint8Array} [styles]
 * @returns {Promise<import('./data.js').Root[]>}
 */
export async function readRoots(text, styles) {
  const entries = parsed(text, TEXT_ROOTS);
  if (!Array.isArray(entries) || !entries.length) {
    throw new VextureError(`${TEXT_ROOTS} is ${line(text)}; it must be a list of at least one root; ${REMEDY}`, TEXT_ROOTS);
  }
  if (styles) {
    const listed = parsed(await inflated(styles), TEXT_STYLES);
    if (!Array.isArray(listed) || listed.length !== entries.length) {
      throw new VextureError(`${TEXT_STYLES} is no list of one style for each of ${entries.length} roots; ${REMEDY}`, TEXT_STYLES);
    }
    entries.forEach((entry, place) => isObject(entry) && Object.assign(entry, { style: listed[place] }));
  }
  if (entries.some((entry) => entry?.map === true)) await loadMaps();
  return entries.map(readRoot);
}

/**
 * The text of deflated styles.
 *
 * @param {Uint8Array} styles
 */
async function inflated(styles) {
  const whole = styles.length > LENGTH_BYTES;
  const length = whole ? new DataView(styles.buffer, styles.byteOffset).getUint32(0, true) : 0;
  if (!length || length > MOST_STYLE_BYTES) {
    throw new VextureError(
      `${TEXT_STYLES} says that it has ${length} bytes; the limit is ${MOST_STYLE_BYTES}; ${REMEDY}`,
      TEXT_STYLES,
    );
  }
  return new TextDecoder().decode(await inflate(styles.subarray(LENGTH_BYTES), length, TEXT_STYLES));
}

/**
 * @param {string} text
 * @param {string} what
 * @returns {any}
 */
function parsed(text, what) {
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new VextureError(`${what} is not JSON (${line(error)}); ${REMEDY}`, what, { cause: error });
  }
}

/**
 * @param {any} entry
 * @param {number} place
 * @returns {import('./data.js').Root}
 */
function readRoot(entry, place) {
  if (!isObject(entry)) refuse(`root ${place}`, entry, 'an object', place);
  const { name, quad, crs = null, tolerance = 0, transform, paint = null, map = false, style = null } = entry;
  if (typeof name !== 'string') refuse(`root ${place}: name`, name, 'a text', place, 'name');
  if (!Number.isInteger(quad) || quad < 0 || quad >= MOST_INDEX) {
    refuse(`root ${place}: quad`, quad, 'an index of a texel', place, 'quad');
  }
  if (typeof map !== 'boolean') refuse(`root ${place}: map`, map, 'true or false', place, 'map');
  if (crs !== null && typeof crs !== 'string') refuse(`root ${place}: crs`, crs, 'a text', place, 'crs');
  if (!areNumbers(transform, 6)) refuse(`root ${place}: transform`, transform, '6 finite numbers', place, 'transform');
  if (!areNumbers([tolerance], 1) || tolerance < 0) {
    refuse(`root ${place}: tolerance`, tolerance, 'a finite number of at least 0', place, 'tolerance');
  }
  if (style !== null && !map) refuse(`root ${place}: style`, style, 'of a map', place, 'style');
  return {
    name, quad, transform, tolerance, crs, paint: paint === null ? null : readPaint(paint, place), isMap: map, hasGradients: false, hasPictures: false,
    style: style === null ? null : mapParts().readStyle(style, `root ${place}`),
  };
}

/**
 * @param {any} paint
 * @param {number} place
 * @returns {import('./data.js').RootPaint}
 */
function readPaint(paint, place) {
  if (!isObject(paint)) refuse(`root ${place}: paint`, paint, 'an object', place, 'paint');
  const { color, opacity = 1 } = paint;
  if (!areNumbers(color, 3) || !areNumbers([opacity], 1) || ![...color, opacity].every((one) => one >= 0 && one <= 1)) {
    refuse(`root ${place}: paint`, paint, 'a color of 3 numbers and an opacity, all in 0..1', place, 'paint');
  }
  return { color, opacity };
}

/**
 * @param {unknown} value
 */
function isObject(value) {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/**
 * @param {unknown} values
 * @param {number} count
 */
function areNumbers(values, count) {
  return Array.isArray(values) && values.length === count && values.every(Number.isFinite);
}

/**
 * @param {string} what
 * @param {unknown} value
 * @param {string} must
 * @param {number} place
 * @param {string} [member]
 * @returns {never}
 */
function refuse(what, value, must, place, member) {
  const field = `${TEXT_ROOTS}[${place}]${member ? `.${member}` : ''}`;
  throw new VextureError(`${what} is ${line(value)}; it must be ${must}; ${REMEDY}`, field);
}

/**
 * Version of a file with these shapes.
 *
 * @param {import('./data.js').Root[]} roots
 */
export function versionOf(roots) {
  if (roots.some(({ hasPictures }) => hasPictures)) return PICTURE_VERSION;
  return roots.some(({ isMap }) => isMap) ? MAP_VERSION : PACKED_VERSION;
}
