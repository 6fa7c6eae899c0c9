/** Where waves meet a shore of open water, from an image. */
import { decode } from 'fast-png';
import { Relief } from './relief.js';

/**
 * Openness of the water on the grid of the relief, 0..1.
 *
 * @param {Relief} relief
 * @param {Uint8Array | null} png 8-bit gray over the box, northernmost row first; null: no water is open
 * @returns {Float32Array}
 */
export function opennessOver({ columns, rows }, png) {
  const found = new Float32Array(columns * rows);
  if (!png) return found;
  const { width, height, depth, channels, data } = decode(png);
  if (depth !== 8 || channels !== 1) throw new Error(`The picture of the waves has ${channels} x ${depth} bits, not 8.`);
  const cells = new Relief({ columns: width, rows: height }, Float32Array.from(data, (number) => number / 255));
  // its values stand for the middles of its pixels, those of the relief for corners
  const inward = (/** @type {number} */ place, /** @type {number} */ count) => (place * count - 0.5) / (count - 1);
  for (let row = 0, at = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++, at++) {
      found[at] = cells.at(inward(column / (columns - 1), width), inward(1 - row / (rows - 1), height));
    }
  }
  return found;
}
