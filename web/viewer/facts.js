/** Facts about the shape, and its frame time. */
import { headOf } from '../src/planar-map.js';
import { counts } from '../src/walk.js';
import { element, section } from './dom.js';
import { median } from './median.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 */

const FRAMES = 30;

/** @param {number | null | undefined} value */
const count = (value) => (value === null || value === undefined ? 'not known' : value.toLocaleString('en'));

/** @param {number | null | undefined} value */
function bytes(value) {
  if (value === null || value === undefined) return 'not known';
  return value < 1e4 ? `${count(value)} B` : value < 1e7 ? `${count(Math.round(value / 100) / 10)} kB`
    : `${count(Math.round(value / 1e5) / 10)} MB`;
}

/** @param {number | null | undefined} value */
const milliseconds = (value) => (value === null || value === undefined ? 'not known' : `${value.toPrecision(3)} ms`);

/** @param {number | null | undefined} value parts of the unit square's side */
function distance(value) {
  if (value === null || value === undefined) return 'not known';
  return value === 0 ? 'exact' : `1/${count(Math.round(1 / value))}`;
}

/**
 * @param {Engine} engine
 * @param {State} _state
 */
export function create(engine, _state) {
  const list = element('dl', { class: 'facts' });
  const remarks = element('ul', { class: 'remarks', 'aria-label': 'Remarks' });
  const frame = element('output', { class: 'value', 'aria-live': 'off' }, 'not measured');
  const button = element('button', {
    type: 'button', title: `Draw ${FRAMES} frames and say how long one takes`,
    onclick: async () => {
      button.disabled = true;
      frame.value = 'measuring';
      frame.value = `${(await measure(engine)).toPrecision(3)} ms`;
      button.disabled = false;
    },
  }, 'Measure');

  function update() {
    const { document: opened, drawing } = engine;
    const data = drawing?.texture.data;
    if (!opened || !drawing || !data) return;
    const facts = opened.manifest.facts ?? {};
    const layers = data.roots.slice(drawing.first, drawing.first + drawing.count);
    const maps = layers.filter(({ isMap }) => isMap);
    const found = [...new Set(layers.map(({ quad }) => quad))].map((quad) => counts(data, quad));
    const rows = [
      ['Segments', count(facts.segments)],
      ['Layers', count(layers.length)],
      ...(maps.length ? [['Paints', count(maps.reduce((sum, { quad }) => sum + headOf(data.texels, quad).used, 0))]] : []),
      ['Quads', count(found.reduce((sum, { quads }) => sum + quads, 0))],
      ['Curves', count(found.reduce((sum, { curves }) => sum + curves, 0))],
      ['Deepest leaf', count(Math.max(...found.map(({ depth }) => depth)) + 1)],
      ['File', bytes(facts.bytes ?? opened.manifest.bytes)],
      ['GPU memory', bytes(drawing.texture.nbytes)],
      ['Conversion', milliseconds(facts.milliseconds)],
      ['Tolerance, of side', distance(Math.max(...layers.map(({ tolerance }) => tolerance)))],
      ['Deviation, of side', distance(facts.distance)],
    ];
    list.replaceChildren(...rows.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
    const said = (facts.notes ?? []).filter(({ kind }) => kind === 'remark'); // the badge says the others
    remarks.hidden = said.length === 0;
    remarks.replaceChildren(...said.map(({ message }) => element('li', {}, message)));
  }

  engine.addEventListener('shape', () => {
    frame.value = 'not measured';
    update();
  });
  update();
  const made = section('Facts', list, element('div', { class: 'row measure' }, element('span', {}, 'Frame time'),
    element('span', { class: 'measured' }, frame, button)), remarks);
  made.setAttribute('role', 'region');
  return made;
}

/**
 * Median frame time in milliseconds, from the call until the pixels can be read.
 *
 * @param {Engine} engine
 */
async function measure(engine) {
  const gl = engine.renderer.getContext();
  const pixel = new Uint8Array(4);
  const times = [];
  for (let i = 0; i < FRAMES; i++) {
    await new Promise((next) => requestAnimationFrame(next));
    const begin = performance.now();
    engine.render();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits for the frame
    times.push(performance.now() - begin);
  }
  return median(times);
}
