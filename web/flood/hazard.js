/** Hazard of a step, from an image of its ratings. */
import { decode } from 'fast-png';

/**
 * Ratings on the grid of the relief, NaN where it is dry or unknown.
 *
 * @param {Uint8Array} png 8-bit gray, northernmost row first; 0: dry or unknown, 1: a rating of 0
 * @param {{unit: number}} facts
 * @param {{columns: number, rows: number}} size of the grid
 */
export function readHazard(png, { unit }, { columns, rows }) {
  const { width, height, depth, channels, data } = decode(png);
  if (depth !== 8 || channels !== 1 || width !== columns || height !== rows) {
    throw new Error(`The picture of the hazard is ${width} x ${height} with ${channels} x ${depth} bits, not `
      + `${columns} x ${rows} with 8.`);
  }
  return Float32Array.from(data, (number) => (number === 0 ? NaN : (number - 1) * unit));
}
