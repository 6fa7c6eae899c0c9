/** The cell under the pointer: its curves with their control points, and how a point's being inside is found. */
import { cellAt, contains } from '../src/walk.js';
import { chosenLayer } from './chosen-layer.js';
import { element, section } from './dom.js';
import { coordinateAt, filledStrip, solutionsAt } from './solutions.js';
import { cellRect, svgElement, svgLayer } from './svg.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 * @typedef {import('../src/walk.js').Cell} Cell
 * @typedef {import('./solutions.js').Solution} Solution
 * @typedef {[number, number]} Point
 *
 * @typedef {object} Found
 * @property {Cell} cell
 * @property {Point} point in the unit square
 * @property {boolean} inside
 * @property {Solution[]} solutions
 * @property {number} nearest which curve is the nearest one to the point; -1 without curves
 */

/** Milliseconds between two texts that a screen reader is given. */
const QUIET = 300;
const STRIP = 7; // CSS pixels
const SAMPLES = 24;

/**
 * @param {Engine} engine
 * @param {State} state
 */
export function create(engine, state) {
  const chosen = chosenLayer(engine);
  const layer = svgLayer(engine, 'inspector-layer');
  const button = element('button', {
    type: 'button', title: 'The cell under the pointer, or in the middle of the picture, and its curves',
    onclick: () => state.updateOverlays({ inspect: !state.overlays.inspect }),
  }, 'Inspect cell');
  const text = element('div', { class: 'inspected', 'aria-live': 'polite' });
  /** @type {Point | null} */
  let pointer = null;
  let timer = 0;

  /** @returns {Found | null} */
  function find() {
    const { data, root } = chosen;
    const { width, height } = engine.size;
    const point = engine.toUnit(...(pointer ?? /** @type {Point} */ ([width / 2, height / 2])));
    const cell = data && root && point ? cellAt(data, root.quad, ...point) : null;
    if (!data || !root || !point || !cell) return null;
    return {
      cell, point, inside: contains(data, root.quad, ...point), solutions: solutionsAt(cell, point[0]),
      nearest: nearestCurve(cell.curves, point),
    };
  }

  function write() {
    timer = 0;
    const found = state.overlays.inspect && state.value.mode === 'flat' ? find() : null;
    text.replaceChildren(...(found ? described(found) : []));
    if (!found && state.overlays.inspect) {
      text.append(element('p', { class: 'hint' },
        state.value.mode === 'flat' ? 'There is no cell here.' : 'Cells are inspected in the flat view.'));
    }
  }

  function update() {
    const { inspect } = state.overlays;
    button.setAttribute('aria-pressed', String(inspect));
    const found = inspect && state.value.mode === 'flat' ? find() : null;
    layer.replaceChildren(...(found ? drawn(engine, found) : []));
    timer ||= window.setTimeout(write, QUIET);
  }

  engine.canvas.addEventListener('pointermove', ({ offsetX, offsetY }) => {
    pointer = [offsetX, offsetY];
    if (state.overlays.inspect) update();
  });
  engine.canvas.addEventListener('pointerleave', () => {
    pointer = null;
    if (state.overlays.inspect) update();
  });
  engine.canvas.parentElement?.addEventListener('keydown', () => {
    pointer = null; // whoever moves the picture by keys looks at its middle
  });
  state.addEventListener('change', update);
  chosen.addEventListener('change', update);
  for (const event of ['view', 'shape']) engine.addEventListener(event, update);
  update();
  return section('Cell', element('div', { class: 'buttons' }, button), text);
}

/**
 * @param {number[][]} curves
 * @param {Point} point
 */
function nearestCurve(curves, [u, v]) {
  let [best, nearest] = [Infinity, -1];
  curves.forEach((curve, index) => {
    for (let i = 0; i <= SAMPLES; i++) {
      const t = i / SAMPLES;
      const distance = Math.hypot(coordinateAt(curve, 0, t) - u, coordinateAt(curve, 1, t) - v);
      if (distance < best) [best, nearest] = [distance, index];
    }
  });
  return nearest;
}

/**
 * The texts of the panel.
 *
 * @param {Found} found
 */
function described({ cell, point, inside, solutions }) {
  const rows = [
    ['Point', point.map((part) => part.toFixed(7)).join(', ')],
    ['Depth', String(cell.depth)],
    ['Side', `1/${2 ** cell.depth}`],
    ['Coverage', cell.coverage.toFixed(3)],
    ['Winding at the corner', cell.curves.length ? String(cell.winding) : 'none: constant'],
    ['Curves', String(cell.curves.length)],
  ];
  const list = element('dl', {}, ...rows.flatMap(([name, value]) => [
    element('dt', {}, name), element('dd', {}, value)]));
  const verdict = element('p', { class: 'verdict' }, inside ? 'The point is inside.' : 'The point is outside.');
  if (!solutions.length) return [list, verdict];
  const lines = solutions.map(({ curve, t, height, filledAbove }) => element('tr', {},
    element('td', {}, String(curve + 1)), element('td', {}, t.toFixed(5)), element('td', {}, height.toFixed(7)),
    element('td', {}, filledAbove ? 'above' : 'below')));
  const head = ['Curve', 't', 'Height', 'Filled'].map((name) => element('th', { scope: 'col' }, name));
  return [list, element('table', {}, element('caption', {}, 'Curves at the x of the point'),
    element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...lines)), verdict];
}

/**
 * What lies over the picture.
 *
 * @param {Engine} engine
 * @param {Found} found
 */
function drawn(engine, { cell, point, inside, solutions, nearest }) {
  const screens = cell.curves.map((curve) => [0, 1, 2, 3].map((k) => engine.toScreen(curve[2 * k], curve[2 * k + 1])));
  const [x, y] = engine.toScreen(...point);
  const [, bottom] = engine.toScreen(cell.x, cell.y);
  const [, top] = engine.toScreen(cell.x, cell.y + cell.size);
  const curves = screens.map((points, index) => curveGroup(points, index, index === nearest));
  const dots = solutions.flatMap(({ curve, t, height }) => {
    const at = engine.toScreen(point[0], height);
    const dot = svgElement('circle', { class: 'solution', cx: at[0], cy: at[1], r: 4.5 });
    return curve === nearest ? [dot, label(at, `t ${t.toFixed(3)}`, 'solution-label')] : [dot];
  });
  return [
    cellRect(engine, cell, 'inspected-cell'),
    ...curves,
    svgElement('line', { class: 'upright', x1: x, x2: x, y1: bottom, y2: top }),
    ...dots,
    svgElement('circle', { class: inside ? 'point inside' : 'point outside', cx: x, cy: y, r: 5 }),
  ];
}

/**
 * @param {Point[]} points P0 to P3 on the screen
 * @param {number} index
 * @param {boolean} isNearest whether its points have names
 */
function curveGroup(points, index, isNearest) {
  const text = points.map((at) => at.join(' '));
  const group = svgElement('g', { class: isNearest ? 'curve nearest' : 'curve' },
    svgElement('polygon', { class: 'filled-side', points: filledStrip(points, STRIP).map((at) => at.join(',')).join(' ') }),
    svgElement('polyline', { class: 'control-polygon', points: text.join(' ') }),
    svgElement('path', { class: 'outline', d: `M ${text[0]} C ${text.slice(1).join(' ')}` }),
    ...points.map(([cx, cy], k) => svgElement('circle', { class: k % 3 ? 'control' : 'end', cx, cy, r: 3.5 })));
  if (isNearest) points.forEach((at, k) => group.append(label(at, `P${k}`, 'point-label')));
  const flat = points.flat();
  group.append(label([coordinateAt(flat, 0, 0.5), coordinateAt(flat, 1, 0.5)], String(index + 1), 'curve-label'));
  return group;
}

/** @param {Point} at @param {string} text @param {string} name */
function label([x, y], text, name) {
  return svgElement('text', { class: name, x: x + 8, y: y - 7 }, text);
}
