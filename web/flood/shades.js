/** What the water is coloured by: its look, its depth now or at its greatest, its hazard, or when it came. */

/** @typedef {import('../src/water/fields.js').DepthColors} DepthColors */
/** @typedef {'water' | 'depth' | 'smooth' | 'greatest' | 'hazard' | 'arrival'} Shade */

/** Of the colours. */
export const OPACITY = 0.9;
const HAZARD = 'Greatest hazard: depth × (speed + 0.5)';
/** Hours of the classes of arrival: minutes, hours, a day. */
const ROUND = [...[1, 2, 5, 10, 15, 30].map((minutes) => minutes / 60), 1, 2, 3, 4, 6, 12, 24];
/** Samples beside the water that have its values: the shore is between them. */
const BESIDE = 3;

/** @param {number[]} from ascending @param {string[]} colors @param {boolean} smooth @returns {DepthColors} */
const colored = (from, colors, smooth) => ({
  classes: from.map((value, at) => ({ from: value, color: colors[at], opacity: OPACITY })), smooth,
});

/** The least round time that is at least so long. @param {number} hours */
export function roundHours(hours) {
  const days = Math.ceil(hours / 24);
  return ROUND.find((each) => each >= hours - 1e-9) ?? 24 * days;
}

/**
 * Colours and legend of a shade; null for the look of water.
 *
 * @param {Shade} shade
 * @param {Pick<import('./page-data.js').Flood, 'depths' | 'arrivals' | 'hazards'>} colors
 * @param {number} hours from the first step to the last
 * @returns {{colors: DepthColors, title: string, unit: string, texts?: string[], end?: number, mapped: boolean} | null}
 *   texts: of the classes, in place of where they begin; end: of the last class, if it has one; mapped: by a map of the
 *   classes, where there is one
 */
export function shadeOf(shade, { depths, arrivals: colors, hazards }, hours) {
  if (shade === 'water') return null;
  if (shade === 'arrival') {
    const each = roundHours(hours / colors.length);
    const from = colors.map((_, at) => each * at).filter((value) => value < hours);
    return { colors: colored(from, colors, false), title: 'First under water after', unit: 'h', mapped: false };
  }
  if (shade === 'hazard') {
    const found = colored(hazards.map((one) => one.from), hazards.map(({ color }) => color), false);
    return { colors: found, title: HAZARD, unit: '', texts: hazards.map(({ text }) => text), mapped: false };
  }
  const from = depths.map((one) => one.from);
  const found = colored(from, depths.map(({ color }) => color), shade === 'smooth');
  const title = shade === 'greatest' ? 'Greatest depth' : 'Depth';
  return { colors: found, title, unit: 'm', end: depths.at(-1)?.to, mapped: shade === 'depth' };
}

/**
 * Hours from the first step until each place is under water; beside it, those of the nearest, NaN elsewhere.
 *
 * @param {{hours: number, wet: Uint8Array}[]} steps
 * @param {{columns: number, rows: number}} size
 */
export function arrivals(steps, { columns, rows }) {
  const found = new Float32Array(columns * rows).fill(NaN);
  for (const { hours, wet } of [...steps].sort((one, other) => other.hours - one.hours)) {
    wet.forEach((is, at) => {
      if (is) found[at] = hours;
    });
  }
  return widened(found, columns);
}

/** Values, and beside them those of the nearest. @param {Float32Array} values @param {number} columns of the grid */
function widened(values, columns) {
  let found = values;
  for (let pass = 0; pass < BESIDE; pass++) {
    const before = found;
    found = before.map((value, at) => {
      if (!Number.isNaN(value)) return value;
      const near = [at % columns > 0 ? at - 1 : -1, at % columns < columns - 1 ? at + 1 : -1, at - columns, at + columns];
      return near.map((one) => before[one]).find((one) => one !== undefined && !Number.isNaN(one)) ?? NaN;
    });
  }
  return found;
}

/**
 * Greatest depth of all steps at each place, NaN where it is never under water or beside it.
 *
 * @param {Float32Array[]} levels
 * @param {ArrayLike<number>} heights
 */
export function greatestDepths(levels, heights) {
  return Float32Array.from(heights, (height, at) => {
    const known = levels.map((one) => one[at]).filter((level) => !Number.isNaN(level));
    return known.length > 0 ? Math.max(...known) - height : NaN;
  });
}

/**
 * Greatest hazard of all steps at each place, and beside the water that of the nearest; NaN elsewhere.
 *
 * @param {Float32Array[]} ratings of the steps
 * @param {number} columns of the grid
 */
export function greatestHazards(ratings, columns) {
  const found = new Float32Array(ratings[0].length).fill(NaN);
  for (const one of ratings) {
    one.forEach((rating, at) => {
      if (!(rating <= found[at]) && !Number.isNaN(rating)) found[at] = rating;
    });
  }
  return widened(found, columns);
}

/** A number for people: as short as it can be. @param {number} value */
export const short = (value) => String(Number(value.toFixed(Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : 2)));
