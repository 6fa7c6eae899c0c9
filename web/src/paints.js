// Colours of elements as users give them.
import { VextureError, line } from './errors.js';
import { nearest } from './map-means.js';

/**
 * @typedef {import('three').ColorRepresentation | [number, number, number, number] | null} Paint a colour as `THREE.Color`
 *   reads it, with `#rrggbbaa` and `rgba()`; or sRGB components and opacity, 0..1; null or `none` hides; `own` is what the
 *   element had at first
 *
 * @typedef {Readonly<Record<string, Paint>> | ReadonlyMap<string, Paint>} PaintList colours by the names of elements
 *
 * @typedef {Pick<typeof import('three'), 'Color' | 'LinearSRGBColorSpace' | 'SRGBColorSpace'>} Colors of three.js
 *
 * @typedef {object} Paints
 * @property {string[]} names of elements
 * @property {Float64Array} parts red, green, blue, opacity for each name: sRGB, not premultiplied, 0..1; NaN restores
 */

/** Colours and opacities of elements are whole numbers of these parts, as in files. */
const DIGITS = 1e6;

/**
 * @param {PaintList} paints by name
 * @param {Colors} colors
 * @returns {Paints}
 * @throws {VextureError} if one is no paint
 */
export function readPaints(paints, colors) {
  if (!(paints instanceof Object)) throw new VextureError(`paints are ${line(paints)}; give an object or a Map`, 'paint');
  const isMap = paints instanceof Map;
  const names = isMap ? [...paints.keys()] : Object.keys(paints);
  const parts = new Float64Array(4 * names.length);
  const color = new colors.Color();
  let at = 0;
  const read = (/** @type {Paint} */ paint) => {
    if (paint === 'own') parts.fill(NaN, at, at + 4);
    else if (Array.isArray(paint)) readParts(paint, parts, at);
    else if (paint !== null && paint !== 'none') {
      parts[at + 3] = typeof paint === 'string' ? opacityOf(paint) : 1;
      readColor(paint, color, colors).toArray(parts, at);
    }
    at += 4;
  };
  if (isMap) paints.forEach(read);
  else for (const name of names) read(/** @type {Record<string, Paint>} */ (paints)[name]);
  round(parts);
  return { names, parts };
}

/** To whole numbers of DIGITS, in place. @param {Float64Array} parts */
export function round(parts) {
  for (let i = 0; i < parts.length; i++) parts[i] = nearest(parts[i] * DIGITS) / DIGITS;
}

/**
 * @param {number[]} paint
 * @param {Float64Array} parts
 * @param {number} at
 */
function readParts(paint, parts, at) {
  let isPaint = paint.length === 4;
  for (let c = 0; c < 4; c++) {
    isPaint &&= paint[c] >= 0 && paint[c] <= 1;
    parts[at + c] = paint[c];
  }
  if (!isPaint) throw noPaint(paint);
}

/** Colours that `THREE.Color` reads: by name, #rgb and #rrggbb, rgb() and hsl(); and, here, #rgba and #rrggbbaa. */
const COLORS = /^(?:[a-z]+|#(?:[\da-f]{3,4}|[\da-f]{6}|[\da-f]{8})|(?:rgb|hsl)a?\([\d\s.,%/+-]*\))$/i;

/** @param {string} text a colour @returns {number} its opacity, 0..1 */
function opacityOf(text) {
  const hex = /^#(?:[\da-f]{3}([\da-f])|[\da-f]{6}([\da-f]{2}))$/i.exec(text);
  if (hex) return hex[1] ? parseInt(hex[1], 16) / 15 : parseInt(hex[2], 16) / 255;
  const last = /^(?:rgb|hsl)a?\([^,]+,[^,]+,[^,]+,\s*([\d.]+)(%?)\s*\)$/i.exec(text);
  return last ? Math.min(Number(last[1]) / (last[2] ? 100 : 1), 1) : 1;
}

/** @param {unknown} paint @returns {VextureError} */
const noPaint = (paint) =>
  new VextureError(`a paint is ${line(paint)}; give a colour, four numbers in 0..1, or null`, 'paint');

/**
 * The sRGB components of a colour; a text or number is taken as it is, as to linear light and back would cost digits.
 *
 * @param {import('three').ColorRepresentation} paint
 * @param {import('three').Color} color receives them
 * @param {Colors} colors
 */
function readColor(paint, color, { Color, LinearSRGBColorSpace, SRGBColorSpace }) {
  if (typeof paint === 'string') {
    const isName = /^[a-z]+$/i.test(paint);
    if (!COLORS.test(paint) || (isName && !(paint.toLowerCase() in Color.NAMES))) throw noPaint(paint);
    const opaque = paint
      .replace(/^#([\da-f]{3})[\da-f]$|^#([\da-f]{6})[\da-f]{2}$/i, '#$1$2')
      .replace(/^(rgb|hsl)a?\(([^,]+,[^,]+,[^,]+),[^,]*\)$/i, '$1($2)');
    return color.setStyle(opaque, LinearSRGBColorSpace);
  }
  if (typeof paint === 'number' && Number.isInteger(paint) && paint >= 0 && paint <= 0xffffff) {
    return color.setHex(paint, LinearSRGBColorSpace);
  }
  if (!(paint instanceof Object) || !paint.isColor) throw noPaint(paint);
  paint.getRGB(color, SRGBColorSpace);
  return color;
}
