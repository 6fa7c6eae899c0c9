/** Levels of the water of a step, from an image of them. */
import { decode } from 'fast-png';

/**
 * Levels on the grid of the relief, in metres above the still water, NaN where there is no water.
 *
 * @param {Uint8Array} png 16-bit gray, northernmost row first; 0: no water, 1: the lowest level
 * @param {{lowest: number, unit: number}} facts metres
 * @param {{columns: number, rows: number}} size of the grid
 * @returns {Float32Array}
 */
export function readLevels(png, { lowest, unit }, { columns, rows }) {
  const { width, height, depth, channels, data } = decode(png);
  if (depth !== 16 || channels !== 1 || width !== columns || height !== rows) {
    throw new Error(`The picture of the levels is ${width} x ${height} with ${channels} x ${depth} bits, not `
      + `${columns} x ${rows} with 16.`);
  }
  return Float32Array.from(data, (number) => (number === 0 ? NaN : lowest + (number - 1) * unit));
}

/**
 * Between two grids of levels; where only one of them has water, its level.
 *
 * @param {Float32Array} from @param {Float32Array} to
 * @param {number} share 0..1
 */
export function mixedLevels(from, to, share) {
  return Float32Array.from(from, (level, at) => {
    if (Number.isNaN(level)) return to[at];
    return Number.isNaN(to[at]) ? level : level + (to[at] - level) * share;
  });
}
