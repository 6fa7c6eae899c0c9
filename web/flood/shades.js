/** What the water is coloured by: its look, its depth, or the time at which it came. */

/** @typedef {import('../src/water/fields.js').DepthColors} DepthColors */
/** @typedef {'water' | 'depth' | 'smooth' | 'arrival'} Shade */

/** ColorBrewer's YlGnBu (C. Brewer, 2002): it stays in order for those who are blind to some colours, and in gray. */
const SEQUENCE = ['#ffffd9', '#edf8b1', '#c7e9b4', '#7fcdbb', '#41b6c4', '#1d91c0', '#225ea8', '#253494', '#081d58'];
/** The palest of them is left out, since it would not be seen on sand. */
const PALEST = 1;
const OPACITY = 0.9;
/** Samples beside the water that have its values: the shore is between them. */
const BESIDE = 3;
/** Classes of arrival times. */
const ARRIVALS = 6;

/** @param {string} color @returns {number[]} */
const parts = (color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));

/** So many colours of the sequence, from pale to dark. @param {number} count @returns {string[]} */
export function colorsOf(count) {
  return Array.from({ length: count }, (_, at) => {
    const place = count === 1 ? SEQUENCE.length / 2 : PALEST + ((SEQUENCE.length - 1 - PALEST) * at) / (count - 1);
    const below = Math.min(Math.floor(place), SEQUENCE.length - 2);
    const [one, other] = [parts(SEQUENCE[below]), parts(SEQUENCE[below + 1])];
    const mixed = one.map((part, k) => Math.round(part + (other[k] - part) * (place - below)));
    return `#${mixed.map((part) => part.toString(16).padStart(2, '0')).join('')}`;
  });
}

/**
 * Colours of values from these on.
 *
 * @param {readonly number[]} from ascending
 * @param {{smooth?: boolean, reversed?: boolean}} [how]
 * @returns {DepthColors}
 */
function colored(from, { smooth = false, reversed = false } = {}) {
  const colors = colorsOf(from.length);
  if (reversed) colors.reverse();
  return { classes: from.map((value, at) => ({ from: value, color: colors[at], opacity: OPACITY })), smooth };
}

/**
 * Colours and legend of a shade; null for the look of water.
 *
 * @param {Shade} shade
 * @param {readonly number[]} depths metres from which classes begin
 * @param {number} hours from the first step to the last
 * @returns {{colors: DepthColors, title: string, unit: string} | null}
 */
export function shadeOf(shade, depths, hours) {
  if (shade === 'water') return null;
  if (shade === 'arrival') {
    const from = Array.from({ length: ARRIVALS }, (_, at) => (hours * at) / ARRIVALS);
    return { colors: colored(from, { reversed: true }), title: 'First under water after', unit: 'h' };
  }
  return { colors: colored(depths, { smooth: shade === 'smooth' }), title: 'Depth', unit: 'm' };
}

/**
 * Hours from the first step until each place is under water; beside it, those of the nearest, NaN elsewhere.
 *
 * @param {{hours: number, wet: Uint8Array}[]} steps
 * @param {{columns: number, rows: number}} size
 */
export function arrivals(steps, { columns, rows }) {
  let found = new Float32Array(columns * rows).fill(NaN);
  for (const { hours, wet } of [...steps].sort((one, other) => other.hours - one.hours)) {
    wet.forEach((is, at) => {
      if (is) found[at] = hours;
    });
  }
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

/** A number for people: as short as it can be. @param {number} value */
export const short = (value) => (Math.abs(value) >= 10 ? value.toFixed(0) : String(Math.round(value * 100) / 100));
