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
 * Points of a line through values, a gap where one is NaN; and the least and the greatest.
 *
 * @param {number[]} values
 */
export function lineOf(values) {
  const known = values.filter((value) => !Number.isNaN(value));
  const [low, high] = [Math.min(...known), Math.max(...known)];
  let path = '';
  values.forEach((value, at) => {
    if (Number.isNaN(value)) return;
    const x = (WIDTH * at) / Math.max(values.length - 1, 1);
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
    const steps = await Promise.all(player.names.map(async (name) => (await player.steps.open(name)).manifest.facts?.area));
    const values = place ? await levelsThere() : steps.map((area) => area ?? NaN);
    if (mine !== turn) return;
    const { path, low, high } = lineOf(values);
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
    const x = (WIDTH * player.index) / Math.max(player.count - 1, 1);
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
