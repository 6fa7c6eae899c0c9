// The room that the pictures of a drawing take: the largest are halved until all fit, as by Python's `fit_into_budget`.
import { MOST_PICTURE_SIDE } from '../../generated/layout.js';
import { MOST_PICTURE_TEXELS } from '../../generated/svg-reader.js';
import { texelCount } from '../pictures.js';

/** @import { Pixels } from './decode-picture.js' */
/** @import { Path } from './painter.js' */

/**
 * Halve the largest pictures of a drawing until all fit, and note those that are smaller than in their files.
 *
 * @param {Path[]} paths
 * @param {import('./report.js').Report} report
 * @returns {Path[]}
 */
export function fitPictures(paths, report) {
  /** @type {Map<Pixels, number>} */
  const times = new Map();
  for (const { paint } of paths) if (paint.picture) times.set(paint.picture.pixels, timesAlone(paint.picture.pixels));
  const sizes = new Map([...times].map(([pixels, count]) => [pixels, sizeOf(pixels, count)]));
  for (let sum = total(sizes); sum > MOST_PICTURE_TEXELS; sum = total(sizes)) {
    const [[largest]] = [...sizes].sort(([, one], [, other]) => other - one);
    if (sizes.get(largest) === 1) break;
    const count = 1 + (times.get(largest) ?? 0);
    times.set(largest, count);
    sizes.set(largest, sizeOf(largest, count));
  }
  const halved = new Map([...times].filter(([, count]) => count).map(([pixels, count]) => [pixels, halvedPixels(pixels, count)]));
  for (const [{ label, columns, rows }, small] of halved) {
    const [wide, high, width, height, most] = [small.columns, small.rows, columns, rows, MOST_PICTURE_TEXELS].map((count) => count.toLocaleString('en-US'));
    report.simplified(`${label}: ${wide} x ${high} of its ${width} x ${height} pixels (pictures of a drawing take at most ${most} texels)`);
  }
  return paths.map((path) => {
    const picture = path.paint.picture;
    const pixels = picture && halved.get(picture.pixels);
    if (!picture || !pixels) return path;
    const part = 0.5 ** (times.get(picture.pixels) ?? 0);
    const toPixels = /** @type {import('./paints.js').Rows} */ (picture.toPixels.map((row) => row.map((value) => part * value)));
    return { ...path, paint: { ...path.paint, picture: { ...picture, pixels, toPixels } } };
  });
}

/** @param {Map<Pixels, number>} sizes */
const total = (sizes) => [...sizes.values()].reduce((sum, size) => sum + size, 0);

/** @param {number} side @param {number} count of halvings */
const shorter = (side, count) => Math.ceil(side / 2 ** count);

/** @param {Pixels} pixels @param {number} count of halvings @returns {number} its texels */
const sizeOf = ({ columns, rows }, count) => texelCount(shorter(columns, count), shorter(rows, count));

/** @param {Pixels} pixels @returns {number} halvings until it fits alone */
function timesAlone(pixels) {
  const longest = Math.max(pixels.columns, pixels.rows);
  let count = 0;
  while (sizeOf(pixels, count) > MOST_PICTURE_TEXELS || shorter(longest, count) > MOST_PICTURE_SIDE) count++;
  return count;
}

/** @param {Pixels} pixels @param {number} count @returns {Pixels} the means of squares of 2^count pixels, of those that exist */
function halvedPixels({ columns, rows, rgba, label }, count) {
  const [across, down] = [shorter(columns, count), shorter(rows, count)];
  const sums = new Float64Array(4 * across * down);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const from = 4 * (row * columns + column);
      const to = 4 * ((row >> count) * across + (column >> count));
      for (let k = 0; k < 4; k++) sums[to + k] += rgba[from + k];
    }
  }
  const side = 2 ** count;
  const small = new Uint8Array(sums.length);
  for (let place = 0; place < across * down; place++) {
    const [x, y] = [side * (place % across), side * Math.floor(place / across)];
    const met = Math.min(side, columns - x) * Math.min(side, rows - y);
    for (let k = 4 * place; k < 4 * place + 4; k++) small[k] = Math.floor(sums[k] / met + 0.5);
  }
  return { columns: across, rows: down, rgba: small, label };
}
