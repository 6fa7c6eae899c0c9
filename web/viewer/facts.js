/** Facts about the shape, and its frame time. */
import { headOf } from '../src/planar-map.js';
import { counts } from '../src/walk.js';
import { element, section } from './dom.js';
import { median } from './median.js';
import { UNKNOWN, countText } from './numbers.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 */

const FRAMES = 30;

/** What each fact means, as people read it under the pointer. @type {Readonly<Record<string, string>>} */
const MEANINGS = Object.freeze({
  Segments: 'Lines and curves of the drawing',
  Layers: 'Shapes that are drawn one over the other',
  Paints: 'Different colours and gradients',
  Quads: 'Squares that are divided into four',
  Curves: 'Pieces of outline in the texture',
  'Deepest leaf': 'How often the smallest square comes from dividing the largest',
  Conversion: 'How long the texture of this page took to make',
  'Tolerance, of side': 'How far merged curves may be from those of the drawing, as a part of its longer side',
  'Deviation, of side': 'How far the outline is from the drawing at most, as a part of its longer side',
});

/** @param {number | null | undefined} value */
const milliseconds = (value) => (value === null || value === undefined ? UNKNOWN : `${value.toPrecision(3)} ms`);

/** @param {number | null | undefined} value parts of the unit square's side */
function distance(value) {
  if (value === null || value === undefined) return UNKNOWN;
  return value === 0 ? 'exact' : `1/${countText(Math.round(1 / value))}`;
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
      ['Segments', countText(facts.segments)],
      ['Layers', countText(layers.length)],
      ...(maps.length ? [['Paints', countText(maps.reduce((sum, { quad }) => sum + headOf(data.texels, quad).used, 0))]] : []),
      ['Quads', countText(found.reduce((sum, { quads }) => sum + quads, 0))],
      ['Curves', countText(found.reduce((sum, { curves }) => sum + curves, 0))],
      ['Deepest leaf', countText(Math.max(...found.map(({ depth }) => depth)) + 1)],
      ['Conversion', milliseconds(facts.milliseconds)],
      ['Tolerance, of side', distance(Math.max(...layers.map(({ tolerance }) => tolerance)))],
      ['Deviation, of side', distance(facts.distance)],
    ];
    list.replaceChildren(...rows.flatMap(([name, value]) => [
      element('dt', { title: MEANINGS[name] }, name), element('dd', {}, value)]));
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
