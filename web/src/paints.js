// Colours of elements as users give them.
import { Color, LinearSRGBColorSpace, SRGBColorSpace } from 'three';
import { VextureError, line } from './errors.js';
import { nearest } from './map-means.js';

/**
 * @typedef {import('three').ColorRepresentation | [number, number, number, number]} Paint a colour as `THREE.Color` reads
 *   it, or sRGB components and opacity, 0..1
 *
 * @typedef {object} Paints
 * @property {string[]} names of elements
 * @property {Float64Array} parts red, green, blue, opacity for each name: sRGB, not premultiplied, 0..1
 */

/** Colours and opacities of elements are whole numbers of these parts, as in files. */
const DIGITS = 1e6;

/**
 * @param {Readonly<Record<string, Paint>> | ReadonlyMap<string, Paint>} paints by name
 * @returns {Paints}
 * @throws {VextureError} if one is no paint
 */
export function readPaints(paints) {
  const isMap = paints instanceof Map;
  const names = isMap ? [...paints.keys()] : Object.keys(paints);
  const parts = new Float64Array(4 * names.length);
  const color = new Color();
  let at = 0;
  const read = (/** @type {Paint} */ paint) => {
    if (Array.isArray(paint)) readParts(paint, parts, at);
    else {
      readColor(paint, color).toArray(parts, at);
      parts[at + 3] = 1;
    }
    at += 4;
  };
  if (isMap) paints.forEach(read);
  else for (const name of names) read(/** @type {Record<string, Paint>} */ (paints)[name]);
  for (let i = 0; i < parts.length; i++) parts[i] = nearest(parts[i] * DIGITS) / DIGITS;
  return { names, parts };
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
  if (!isPaint) throw new VextureError(`a paint is ${line(paint)}; give a colour, or four numbers in 0..1`, 'paint');
}

/**
 * The sRGB components of a colour; a text or number is taken as it is, as to linear light and back would cost digits.
 *
 * @param {import('three').ColorRepresentation} paint
 * @param {Color} color receives them
 */
function readColor(paint, color) {
  if (typeof paint === 'string') return color.setStyle(paint, LinearSRGBColorSpace);
  if (typeof paint === 'number') return color.setHex(paint, LinearSRGBColorSpace);
  paint.getRGB(color, SRGBColorSpace);
  return color;
}
