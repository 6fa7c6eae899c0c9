/** Levels of the water of a step, from an image of them. */
import { decode } from 'fast-png';

/** @typedef {{levels: Float32Array, wet: Uint8Array}} Levels wet: 1 where there is water, 0 beside it */

/** In the picture, what is added to a number where there is no water, but beside it. */
const BESIDE = 32768;

/**
 * Levels on the grid of the relief, in metres above the still water, NaN where there is no water near.
 *
 * @param {Uint8Array} png 16-bit gray, northernmost row first; 0: no water near, 1: the lowest level
 * @param {{lowest: number, unit: number}} facts metres
 * @param {{columns: number, rows: number}} size of the grid
 * @returns {Levels}
 */
export function readLevels(png, { lowest, unit }, { columns, rows }) {
  const { width, height, depth, channels, data } = decode(png);
  if (depth !== 16 || channels !== 1 || width !== columns || height !== rows) {
    throw new Error(`The picture of the levels is ${width} x ${height} with ${channels} x ${depth} bits, not `
      + `${columns} x ${rows} with 16.`);
  }
  return {
    levels: Float32Array.from(data, (number) => (number === 0 ? NaN : lowest + ((number % BESIDE) - 1) * unit)),
    wet: Uint8Array.from(data, (number) => Number(number > 0 && number < BESIDE)),
  };
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
