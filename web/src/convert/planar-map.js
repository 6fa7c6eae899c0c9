// The texels of a planar map, by the kernel `coloured_texels`, and the style of one that can be restyled.
import { FARTHEST } from '../../generated/svg-reader.js';
import { MOST_PAINTS, MOST_PICTURE_SIDE } from '../../generated/layout.js';
import { VextureError } from '../errors.js';
import { checkOutcome, limitsOf, outlinesOf, overtime, workOf } from './silhouette.js';

/** @import { Bounds, Sheet } from './conversion.js' */
/** @import { Drawing, Group, Paint, Path } from './drawing.js' */
/** @import { Kernels } from './kernels.js' */
/** @import { Pixels } from './decode-picture.js' */
/** @import { Style } from '../style.js' */

/** Decimals of the colours of a style. */
const DIGITS = 1e6;

/** In the row of a picture, in place of a gradient's focal point. */
const PICTURE = -2;

/** Words of a picture before its pixels, and place of the number of rows in the first. */
const PICTURE_HEAD = 2;
const SIDE_BITS = 16;

/** Largest number of a map to pixels. */
const MOST_NUMBER = MOST_PICTURE_SIDE * FARTHEST;

/** Numbers of a stop. */
const STOP_COLUMNS = 5;

/** Names of masks in a style. @type {readonly ['none', 'opacity', 'luminance']} */
const MASKS = ['none', 'opacity', 'luminance'];

/**
 * Make the planar map of a drawing.
 *
 * @param {Kernels} kernels
 * @param {Drawing} drawing
 * @param {Bounds} bounds
 * @param {object} options
 * @param {boolean} options.restyle keep elements apart; the drawing has no gradients then
 * @param {number} options.first index of its first texel
 * @param {number} options.mostTexels
 * @returns {Sheet | null} null if it needs more texels
 * @throws {VextureError} if it leaves the unit square, or its tree is too large
 */
export function mapOf(kernels, drawing, bounds, { restyle, first, mostTexels }) {
  const elements = restyle ? elementsOf(drawing.paths) : null;
  const { constants } = kernels;
  const limits = limitsOf(bounds, constants.MAP_CAPACITY, constants);
  const most = Math.min(mostTexels, constants.ENDLESS);
  const source = sourceOf(drawing, elements?.numbers);
  const found = kernels.call('coloured_texels', [source, limits, Number(restyle), first, most, workOf(bounds)]);
  const { texels, quads, curves, flattened } = found;
  if (!texels.length) {
    checkReach(drawing.name, found.reach);
    checkOutcome(drawing.name, found.outside, quads, constants);
    if (3 * quads + curves + (curves >> 2) > most) return null;
    if (!found.paints) throw overtime(drawing.name, bounds);
    throw new VextureError(`${drawing.name}: ${found.paints > MOST_PAINTS ? 'too many colours' : 'too many gradients'}; divide the drawing`, 'paints');
  }
  const size = 3 * quads + curves + (curves >> 2) + (found.paints >> 1);
  return { drawing, texels, size, isMap: true, flattened, style: elements && styleOf(drawing, elements, found) };
}

/**
 * @param {string} name
 * @param {number} reach
 */
function checkReach(name, reach) {
  if (reach <= FARTHEST) return;
  throw new VextureError(`${name}: a gradient is ${reach} times the size of the drawing away; the limit is ${FARTHEST}; correct it`, 'gradient');
}

/**
 * A drawing as the arrays of Python's `MapSource`.
 *
 * @param {Drawing} drawing
 * @param {number[]} [elements] number of the element of each path
 */
function sourceOf({ paths, groups }, elements) {
  const { cubics, lengths, path, rules } = outlinesOf(paths);
  const { numbers, ...shades } = shadesOf(paths);
  const columns = paths.flatMap(({ group }, k) => [group, numbers[k], elements?.[k] ?? 0, 0]);
  const rgba = paths.flatMap(({ paint: { color, opacity } }) => [...color, opacity]);
  return [
    cubics, lengths, path, rules, columns, rgba,
    groups.flatMap(({ outer, blend, mask }) => [outer, blend, mask]),
    groups.map(({ opacity }) => opacity),
    shades.rows, shades.stops, shades.words,
  ];
}

/**
 * The gradients and pictures of paths as the arrays of Python's `Shades`, and the number of each path's; -1 if it has none.
 *
 * @param {readonly Path[]} paths
 */
function shadesOf(paths) {
  /** @type {number[]} */
  const rows = [];
  /** @type {number[]} */
  const stops = [];
  const { begins, words } = listPixels(paths);
  let count = 0;
  for (const { paint: { picture } } of paths) if (picture) checkNumbers(picture.toPixels.flat());
  const numbers = paths.map(({ paint: { gradient, picture } }) => {
    if (gradient) {
      const { toRamp, focus, spread } = gradient;
      rows.push(...toRamp.flat(), ...(focus ?? [-1, -1]), spread, stops.length / STOP_COLUMNS, gradient.stops.length);
      for (const { color, opacity, offset } of gradient.stops) stops.push(...color, opacity, offset);
    } else if (picture) {
      rows.push(...picture.toPixels.flat(), PICTURE, picture.opacity, picture.sampling, begins.get(picture.pixels) ?? 0, 0);
    }
    return gradient || picture ? count++ : -1;
  });
  return { rows, stops, words, numbers };
}

/** @param {number[]} numbers of a map to pixels @throws {VextureError} if one is too large for a texture */
function checkNumbers(numbers) {
  const largest = Math.max(...numbers.map(Math.abs));
  if (largest <= MOST_NUMBER) return;
  const [found, most] = [largest, MOST_NUMBER].map((number) => number.toPrecision(3));
  throw new VextureError(
    `a picture's map to pixels has the number ${found}; the limit is ${most}; make the picture larger or the view box smaller`, 'picture',
  );
}

/**
 * The words of all pictures, each of size, whether it is opaque, and pixels; and where those of each begin.
 *
 * @param {readonly Path[]} paths
 */
function listPixels(paths) {
  /** @type {Map<Pixels, number>} */
  const begins = new Map();
  let end = 0;
  for (const { paint: { picture } } of paths) {
    if (!picture || begins.has(picture.pixels)) continue;
    begins.set(picture.pixels, end);
    end += PICTURE_HEAD + picture.pixels.rgba.length / 4;
  }
  const words = new Uint32Array(end);
  for (const [{ columns, rows, rgba }, begin] of begins) {
    const pixels = words.subarray(begin + PICTURE_HEAD, begin + PICTURE_HEAD + columns * rows);
    for (let k = 0; k < pixels.length; k++) {
      pixels[k] = rgba[4 * k] | (rgba[4 * k + 1] << 8) | (rgba[4 * k + 2] << 16) | (rgba[4 * k + 3] << 24);
    }
    words.set([columns | (rows << SIDE_BITS), Number(pixels.every((word) => word >>> 24 === 255))], begin);
  }
  return { begins, words };
}

/**
 * The elements of paths: those of equal name, paint and group are one.
 *
 * @param {readonly Path[]} paths
 * @returns {{ first: Path[], numbers: number[] }} the first path of each element, and the number of each path's element
 */
function elementsOf(paths) {
  /** @type {Map<string, number>} */
  const known = new Map();
  /** @type {Path[]} */
  const first = [];
  const numbers = paths.map((path) => {
    const { element, paint: { color, opacity }, group } = path;
    const key = JSON.stringify([element, color, opacity, group]);
    let number = known.get(key);
    if (number === undefined) known.set(key, (number = first.push(path) - 1));
    return number;
  });
  return { first, numbers };
}

/**
 * The style of a map that was built to be restyled (FORMAT.md, D.10).
 *
 * @param {Drawing} drawing
 * @param {{ first: Path[], numbers: number[] }} elements
 * @param {{ starts: ArrayLike<number | bigint>, members: ArrayLike<number>, hides: ArrayLike<number | bigint> }} found
 * @returns {Style}
 */
function styleOf({ groups }, { first, numbers }, { starts, members, hides }) {
  const round = (/** @type {number} */ part) => Math.round(part * DIGITS) / DIGITS;
  const hiding = new Set(numbers.filter((_, path) => Number(hides[path]) === 1));
  return {
    elements: first.map(({ element, paint: { color: [red, green, blue], opacity }, group }, number) => ({
      name: element, color: [round(red), round(green), round(blue)], opacity: round(opacity), group, hides: hiding.has(number),
    })),
    groups: groups.map(({ outer, opacity, blend, mask }) => ({ outer, opacity, blend, mask: MASKS[mask] })),
    stacks: Array.from({ length: starts.length - 1 }, (_, paint) => {
      return Array.from({ length: Number(starts[paint + 1]) - Number(starts[paint]) }, (_, k) => numbers[members[Number(starts[paint]) + k]]);
    }),
  };
}
