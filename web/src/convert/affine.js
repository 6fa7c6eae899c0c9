// Affine maps (x, y) -> (a x + c y + e, b x + d y + f), and their syntax in attributes (CSS Transforms 1, 8).
import { number, words } from './lengths.js';

/** @typedef {readonly [number, number, number, number, number, number]} Affine a, b, c, d, e, f */

/** @typedef {(text: string, axis: number) => number | null} AxisLength converts a length along x (0) or y (1) */

/** @type {Affine} */
export const IDENTITY = [1, 0, 0, 1, 0, 0];

/** Radians of each unit of angle; in attributes, degrees have no unit. @type {Readonly<Record<string, number>>} */
const TURN = { '': Math.PI / 180, deg: Math.PI / 180, grad: Math.PI / 200, rad: 1, turn: 2 * Math.PI };

const ANGLE = /^([+-]?(?:\d*\.\d+|\d+)(?:[eE][+-]?\d+)?)([a-zA-Z]*)$/;
const ARGUMENT = /[+-]?(?:\d*\.\d+|\d+)(?:[eE][+-]?\d+)?[a-zA-Z%]*/g;
const FUNCTION = /[\s,]*([a-zA-Z\d]+)\s*\(([^()]*)\)\s*/y;

/** @type {Readonly<Record<string, string>>} */
export const KEYWORDS = { left: '0%', top: '0%', center: '50%', right: '100%', bottom: '100%' };

/**
 * Multiply two maps; the second one is applied first.
 *
 * @param {Affine} m
 * @param {Affine} n
 * @returns {Affine}
 */
export function multiply([a, b, c, d, e, f], n) {
  return [
    n[0] * a + n[1] * c, n[0] * b + n[1] * d, n[2] * a + n[3] * c, n[2] * b + n[3] * d,
    a * n[4] + c * n[5] + e, b * n[4] + d * n[5] + f,
  ];
}

/** @param {Affine} m @param {number} x @param {number} y @returns {Affine} the map that translates first */
export const translate = (m, x, y) => multiply(m, [1, 0, 0, 1, x, y]);

/** @param {Affine} m @param {number} x @param {number} [y] @returns {Affine} the map that scales first */
export const scale = (m, x, y = x) => multiply(m, [x, 0, 0, y, 0, 0]);

/** @param {number} value sine or cosine @returns {number} the value without the rounding of right angles */
function snap(value) {
  if (Math.abs(value) < 1e-15) return 0;
  return value > 1 - 1e-15 ? 1 : value < -1 + 1e-15 ? -1 : value;
}

/** @param {Affine} m @param {number} turn radians @returns {Affine} the map that rotates first */
export function rotate(m, turn) {
  const c = snap(Math.cos(turn));
  const s = snap(Math.sin(turn));
  return multiply(m, [c, s, -s, c, 0, 0]);
}

/** @param {Affine} m */
export const isIdentity = (m) => m.every((part, k) => part === IDENTITY[k]);

/** @param {Affine} m */
export const determinant = ([a, b, c, d]) => a * d - b * c;

/** @param {Affine} m @returns {Affine} */
export function inverse(m) {
  if (isIdentity(m)) return m;
  const size = m[0] * m[3] - m[2] * m[1];
  const [a, b, c, d] = [m[3] / size, -m[1] / size, -m[2] / size, m[0] / size];
  return [a, b, c, d, -a * m[4] - c * m[5], -b * m[4] - d * m[5]];
}

/** @param {Affine} m @returns {number} the largest factor by which the map stretches a length */
export function stretch([a, b, c, d]) {
  const x = a * a + b * b;
  const y = c * c + d * d;
  return Math.sqrt((x + y + Math.sqrt((x - y) ** 2 + 4 * (a * c + b * d) ** 2)) / 2);
}

/**
 * @param {Affine} m
 * @param {Affine} move
 * @param {number} x
 * @param {number} y
 * @returns {Affine} m, then `move` about a point
 */
function about(m, move, x, y) {
  return x || y ? translate(multiply(translate(m, x, y), move), -x, -y) : multiply(m, move);
}

/** @param {string} text @returns {number | null} radians */
export function angle(text) {
  const match = ANGLE.exec(text.trim());
  const unit = match ? TURN[match[2].toLowerCase()] : undefined;
  return match && unit !== undefined ? Number(match[1]) * unit : null;
}

/**
 * Multiply a list of transforms.
 *
 * @param {string} text
 * @param {AxisLength} length
 * @returns {Affine | null} null if the list is not valid
 */
export function parseTransform(text, length) {
  const list = text.trim();
  if (list === '' || list.toLowerCase() === 'none') return IDENTITY;
  let product = IDENTITY;
  FUNCTION.lastIndex = 0;
  while (FUNCTION.lastIndex < list.length) {
    const match = FUNCTION.exec(list);
    const parts = match && argumentsOf(match[2]);
    const one = match && parts && single(match[1].toLowerCase(), parts, length);
    if (!one) return null;
    product = isIdentity(product) ? one : multiply(product, one);
  }
  return product;
}

/**
 * @param {string} text a list of transforms
 * @returns {boolean} whether arguments have units, which attributes do not allow
 */
export const hasUnits = (text) => /[a-z%]\s*[,)]|[\d.](?:[a-df-z%]|e(?![+-]?\d))[^()]*\)/i.test(text);

/** @param {string} text an attribute of a paint server @returns {Affine | null} */
export const parseAttribute = (text) => (hasUnits(text) ? null : parseTransform(text, number));

/**
 * @param {string} text
 * @returns {string[] | null} numbers with units, which may touch as in "1-2"; null if there is more
 */
function argumentsOf(text) {
  return /^[\s,]*$/.test(text.replace(ARGUMENT, '')) ? (text.match(ARGUMENT) ?? []) : null;
}

/** @param {string} name @param {string[]} texts @param {AxisLength} length @returns {Affine | null} */
export function single(name, texts, length) {
  /** @type {(number | null)[]} */
  let read;
  if (name.startsWith('translate')) read = texts.map((text, k) => length(text, name === 'translatey' ? 1 : Math.min(k, 1)));
  else if (name.startsWith('skew') || (name === 'rotate' && texts.length === 1)) read = texts.map(angle);
  else read = texts.map((text) => (text.endsWith('%') ? (number(text.slice(0, -1)) ?? NaN) / 100 : number(text)));
  if (read.some((value) => value === null || Number.isNaN(value))) return null;
  return mapOf(`${name}${read.length}`, /** @type {number[]} */ (read));
}

/** @param {string} form name and number of arguments @param {number[]} v @returns {Affine | null} */
function mapOf(form, v) {
  switch (form) {
    case 'matrix6': return [v[0], v[1], v[2], v[3], v[4], v[5]];
    case 'matrix3d16': return [v[0], v[1], v[4], v[5], v[12], v[13]];
    case 'translate1': case 'translatex1': return [1, 0, 0, 1, v[0], 0];
    case 'translate2': return [1, 0, 0, 1, v[0], v[1]];
    case 'translatey1': return [1, 0, 0, 1, 0, v[0]];
    case 'scale1': return [v[0], 0, 0, v[0], 0, 0];
    case 'scale2': return [v[0], 0, 0, v[1], 0, 0];
    case 'scalex1': return [v[0], 0, 0, 1, 0, 0];
    case 'scaley1': return [1, 0, 0, v[0], 0, 0];
    case 'rotate1': return rotate(IDENTITY, v[0]);
    case 'rotate3': return translate(rotate(translate(IDENTITY, v[1], v[2]), v[0] * TURN.deg), -v[1], -v[2]);
    case 'skew1': case 'skewx1': return [1, 0, Math.tan(v[0]), 1, 0, 0];
    case 'skew2': return [1, Math.tan(v[1]), Math.tan(v[0]), 1, 0, 0];
    case 'skewy1': return [1, Math.tan(v[0]), 0, 1, 0, 0];
  }
  return null;
}

/**
 * Parse `transform-origin` or another position.
 *
 * @param {string} text
 * @param {AxisLength} length
 * @returns {[number, number] | null} null if it is not valid
 */
export function parseOrigin(text, length) {
  let parts = words(text.toLowerCase()).slice(0, 2);
  if (parts.length === 1) parts = ['top', 'bottom'].includes(parts[0]) ? ['center', parts[0]] : [parts[0], 'center'];
  if (parts.length !== 2) return null;
  if (['top', 'bottom'].includes(parts[0]) || ['left', 'right'].includes(parts[1])) parts.reverse();
  const [x, y] = parts.map((part, axis) => length(KEYWORDS[part] ?? part, axis));
  return x === null || y === null ? null : [x, y];
}

/**
 * @param {Affine} matrix
 * @param {string} origin
 * @param {AxisLength} length
 * @returns {Affine} the map about an origin
 */
export function aboutOrigin(matrix, origin, length) {
  const [x, y] = parseOrigin(origin, length) ?? [0, 0];
  return about(IDENTITY, matrix, x, y);
}
