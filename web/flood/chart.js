/** A chart under the time: the area under water, or the water's level at a clicked place. */
import { element } from '../viewer/dom.js';
import { Ranks } from './depths.js';
import { short } from './shades.js';
import { depthsOf } from './steps.js';

const WIDTH = 600;
const HEIGHT = 44;
const SVG = 'http://www.w3.org/2000/svg';
/** Pixels that a pointer may move in a click. */
const STILL = 4;

/** @param {number} area square metres */
export const areaText = (area) => (area >= 1e6 ? `${short(area / 1e6)} km²` : `${short(area / 1e4)} ha`);

/**
 * Places of steps along the chart, 0..1: by their times, if all have one and each is later than the one before.
 *
 * @param {(string | null | undefined)[]} times
 */
export function placesOf(times) {
  const known = times.map((time) => (time ? Date.parse(time) : NaN));
  const [first, whole] = [known[0], (known.at(-1) ?? NaN) - known[0]];
  if (whole > 0 && known.every((time, at) => at === 0 || time > known[at - 1])) return known.map((time) => (time - first) / whole);
  return known.map((_, at) => at / Math.max(known.length - 1, 1));
}

/**
 * Points of a line through values, a gap where one is NaN; and the least and the greatest.
 *
 * @param {number[]} values
 * @param {number[]} [places] 0..1
 */
export function lineOf(values, places = placesOf(values.map(() => null))) {
  const known = values.filter((value) => !Number.isNaN(value));
  const [low, high] = [Math.min(...known), Math.max(...known)];
  let path = '';
  values.forEach((value, at) => {
    if (Number.isNaN(value)) return;
    const x = WIDTH * places[at];
    const y = HEIGHT - 3 - ((HEIGHT - 6) * (value - low)) / (high - low || 1);
    path += `${at > 0 && !Number.isNaN(values[at - 1]) ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`;
  });
  return { path, low, high };
}

/**
 * Values of the steps, NaN where it is dry; what they are, and how their range is said.
 *
 * @typedef {{values: number[], what: string, range: (low: number, high: number) => string}} Charted
 */

/** @param {(import('./page-data.js').Facts | undefined)[]} steps @returns {Charted} */
const areasOf = (steps) => ({
  values: steps.map((facts) => facts?.area ?? NaN), what: 'Area under water',
  range: (low, high) => `${areaText(low)} to ${areaText(high)}`,
});

/**
 * The classes of depth of a place.
 *
 * @param {Awaited<ReturnType<typeof depthsOf>>[]} steps
 * @param {number} s @param {number} t
 * @returns {Charted}
 */
export function classesAt(steps, s, t) {
  const ranks = steps.map((step) => (step instanceof Ranks ? step : null));
  const values = ranks.map((step) => step?.at(s, t) || NaN);
  const text = (/** @type {number} */ rank) => ranks[values.indexOf(rank)]?.textOf(rank) ?? '';
  return {
    values, what: 'Depth at the marked place',
    range: (low, high) => (low === high ? text(low) : `least ${text(low)}, most ${text(high)}`),
  };
}

/**
 * @param {import('./stage.js').Stage} stage
 * @param {import('./player.js').Player} player
 * @param {(px: number, py: number) => [number, number] | null} placeAt place of the box under a pixel of the canvas
 * @param {(name: string) => Promise<{step: import('./steps.js').Step, surface: import('./levels.js').Levels | null}>}
 *   levelsAt
 * @param {(place: [number, number] | null) => void} marked
 */
export function createChart(stage, player, placeAt, levelsAt, marked) {
  const made = (/** @type {string} */ tag, /** @type {Record<string, string | number>} */ attributes) => {
    const one = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, String(value));
    return one;
  };
  const line = made('path', { fill: 'none', class: 'line', 'vector-effect': 'non-scaling-stroke' });
  const now = made('line', { y1: 0, y2: HEIGHT, class: 'now', 'vector-effect': 'non-scaling-stroke' });
  const picture = made('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: 'none', role: 'img' });
  picture.append(line, now);
  const label = element('span', { class: 'of' });
  const back = element('button', { type: 'button', title: 'Chart of the area', 'aria-label': 'Chart of the area',
    onclick: () => pick(null) }, '×');
  const chart = element('div', { class: 'chart' }, label, back, picture);
  /** @type {[number, number] | null} */
  let place = null;
  let turn = 0;
  let places = /** @type {number[]} */ ([]);

  /** @param {[number, number] | null} picked */
  function pick(picked) {
    place = picked;
    marked(place);
    void fill();
  }

  /**
   * What is charted of a place: its class of depth, where classes are known; else its level above the zero of the
   * heights; only whether it is wet, where the depth is unknown and the ground is invented.
   *
   * @param {[number, number]} there
   * @returns {Promise<Charted>}
   */
  async function chartedAt([s, t]) {
    const steps = await Promise.all(player.names.map((name) => player.steps.open(name)));
    const facts = steps.map(({ manifest }) => manifest.facts);
    if (facts.some((one) => one?.ranges)) return classesAt(await Promise.all(steps.map(depthsOf)), s, t);
    const { relief } = stage.surface;
    const at = Math.round((1 - t) * (relief.rows - 1)) * relief.columns + Math.round(s * (relief.columns - 1));
    const surfaces = (await Promise.all(player.names.map(levelsAt))).map(({ surface }) => surface);
    if (relief.invented && !facts.some((one) => one?.depth)) {
      const values = surfaces.map((surface) => (surface?.wet[at] ? 1 : NaN));
      const count = values.filter((value) => value === 1).length;
      return { values, what: 'The marked place', range: () => `under water in ${count} of ${values.length} steps` };
    }
    const values = surfaces.map((surface) => (surface?.wet[at] ? surface.levels[at] + relief.still : NaN));
    const text = (/** @type {number} */ value) => `${value.toFixed(2)} m`;
    return { values, what: 'Water level at the marked place', range: (low, high) => `${text(low)} to ${text(high)}` };
  }

  async function fill() {
    const mine = ++turn;
    const steps = await Promise.all(player.names.map(async (name) => (await player.steps.open(name)).manifest.facts));
    const { values, what, range } = place ? await chartedAt(place) : areasOf(steps);
    if (mine !== turn) return;
    places = placesOf(steps.map((facts) => facts?.time));
    const { path, low, high } = lineOf(values, places);
    chart.hidden = values.length < 2 || (!place && !(high >= low));
    back.hidden = place === null;
    label.textContent = `${what}: ${high >= low ? range(low, high) : 'always dry'}`;
    line.setAttribute('d', path);
    picture.setAttribute('aria-label', label.textContent);
    mark();
  }

  function mark() {
    const x = WIDTH * (places[player.index] ?? 0);
    now.setAttribute('x1', String(x));
    now.setAttribute('x2', String(x));
  }

  let pressed = [0, 0];
  stage.canvas.addEventListener('pointerdown', ({ clientX, clientY }) => (pressed = [clientX, clientY]));
  stage.canvas.addEventListener('click', ({ clientX, clientY }) => {
    if (Math.hypot(clientX - pressed[0], clientY - pressed[1]) > STILL || player.count < 2) return;
    const box = stage.canvas.getBoundingClientRect();
    const picked = placeAt(clientX - box.left, clientY - box.top);
    if (picked) pick(picked);
  });
  const refill = () => fill().catch(() => {}); // a step that cannot be read is told of when it is shown
  player.addEventListener('steps', refill);
  player.addEventListener('step', mark);
  refill();
  return chart;
}
