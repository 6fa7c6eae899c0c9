/** Outlines as an SVG document in the units of their source, as `Texture.to_svg` writes it. Plain data. */
import { outlines } from './outlines.js';

/** Digits after the point of a coordinate in units of the unit square: finer than all but the smallest leaves. */
const DIGITS = 9;
const NOT_IN_XML = /[^\t\n\r\x20-\ud7ff\ue000-\ufffd\u{10000}-\u{10ffff}]/gu;
/** @type {Record<string, string>} */
const ESCAPES = { '&': '&amp;', '<': '&lt;', '>': '&gt;' };

/** @typedef {import('../src/data.js').Root} Root */

/** @param {string} text */
const escaped = (text) => text.replace(NOT_IN_XML, '\ufffd').replace(/[&<>]/g, (letter) => ESCAPES[letter]);

/** @param {number} value @param {number} places */
function number(value, places) {
  const text = value.toFixed(places);
  const short = places ? text.replace(/\.?0+$/, '') : text;
  return short === '-0' ? '0' : short;
}

/** @param {Root} root */
function placesOf({ transform: [a, b, , d, e] }) {
  const scale = Math.max(...[a, b, d, e].map(Math.abs));
  return scale > 0 ? Math.max(DIGITS - Math.floor(Math.log10(scale)), 0) : 0;
}

/** @param {Root} root */
function fillOf({ paint }) {
  if (!paint) return '';
  const levels = paint.color.map((part) => 255 * part);
  const color = levels.every((level) => Math.abs(level - Math.round(level)) < 1e-9)
    ? `#${levels.map((level) => Math.round(level).toString(16).padStart(2, '0')).join('')}`
    : `rgb(${paint.color.map((part) => `${number(100 * part, DIGITS)}%`).join(',')})`;
  return ` fill="${color}"${paint.opacity === 1 ? '' : ` fill-opacity="${number(paint.opacity, DIGITS)}"`}`;
}

/**
 * Path data of one contour.
 *
 * @param {import('./outlines.js').Part[]} contour
 * @param {(u: number, v: number) => [number, number]} toSource
 * @param {number} places
 */
function pathOf(contour, toSource, places) {
  const points = (/** @type {number[]} */ cubic, /** @type {number} */ first) => {
    const found = [];
    for (let i = first; i < 8; i += 2) found.push(...toSource(cubic[i], cubic[i + 1]).map((at) => number(at, places)));
    return found.join(' ');
  };
  const data = contour.map(({ cubic, isLine }) => (isLine ? `L${points(cubic, 6)}` : `C${points(cubic, 2)}`));
  if (contour.at(-1)?.isLine) data.pop(); // Z draws it
  return `M${toSource(contour[0].cubic[0], contour[0].cubic[1]).map((at) => number(at, places)).join(' ')}${data.join('')}Z`;
}

/**
 * A path for each shape, none of which is a planar map; the view box holds the unit square of each.
 *
 * @param {import('../src/data.js').PackedData} data
 * @param {Root[]} roots
 * @param {string} name of the document
 */
export function svgText(data, roots, name) {
  /** @type {number[][]} */
  const corners = [];
  const paths = [];
  for (const root of roots) {
    const [a, b, c, d, e, f] = root.transform;
    const toSource = (/** @type {number} */ u, /** @type {number} */ v) => /** @type {[number, number]} */ ([a * u + b * v + c, d * u + e * v + f]);
    const upwards = a * e - b * d > 0;
    const square = [toSource(0, 0), toSource(1, 0), toSource(0, 1), toSource(1, 1)];
    corners.push(...square.map(([x, y]) => [x, upwards ? -y : y]));
    const path = outlines(data, root.quad).map((contour) => pathOf(contour, toSource, placesOf(root))).join('');
    paths.push(`<path${fillOf(root)}${upwards ? ' transform="scale(1 -1)"' : ''} d="${path}"><title>${escaped(root.name)}</title></path>\n`);
  }
  const digits = Math.max(...roots.map(placesOf));
  const [xs, ys] = [0, 1].map((axis) => corners.map((corner) => corner[axis]));
  const [x, y] = [Math.min(...xs), Math.min(...ys)];
  const box = [x, y, Math.max(...xs) - x, Math.max(...ys) - y].map((value) => number(value, digits)).join(' ');
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${box}">\n<title>${escaped(name)}</title>\n${paths.join('')}</svg>\n`;
}
