/** A chart under the time: the area under water, or the water's level at a clicked place. */
import { element } from '../viewer/dom.js';
import { short } from './shades.js';

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

  /** Levels above the zero of the heights at the place, NaN where it is dry; of each step. */
  async function levelsThere() {
    const { relief } = stage.surface;
    const [s, t] = place ?? [0, 0];
    const at = Math.round((1 - t) * (relief.rows - 1)) * relief.columns + Math.round(s * (relief.columns - 1));
    const all = await Promise.all(player.names.map(levelsAt));
    return all.map(({ surface }) => (surface?.wet[at] ? surface.levels[at] + relief.still : NaN));
  }

  async function fill() {
    const mine = ++turn;
    const steps = await Promise.all(player.names.map(async (name) => (await player.steps.open(name)).manifest.facts));
    const values = place ? await levelsThere() : steps.map((facts) => facts?.area ?? NaN);
    if (mine !== turn) return;
    places = placesOf(steps.map((facts) => facts?.time));
    const { path, low, high } = lineOf(values, places);
    const text = place ? (/** @type {number} */ value) => `${value.toFixed(2)} m` : areaText;
    const what = place ? 'Water level at the marked place' : 'Area under water';
    const range = high >= low ? `${text(low)} to ${text(high)}` : 'always dry';
    chart.hidden = values.length < 2 || (!place && !(high >= low));
    back.hidden = place === null;
    label.textContent = `${what}: ${range}`;
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
