/** The cell under the pointer: its curves with their control points, and the containment test of a point. */
import { paintAt, paintColor } from '../src/walk-map.js';
import { cellAt, contains } from '../src/walk.js';
import { chosenLayer } from './chosen-layer.js';
import { drawCell } from './cell-figure.js';
import { element, section } from './dom.js';
import { paintCss } from './overlay-palette.js';
import { watchPointer } from './pointer.js';
import { nearestCurve, solutionsAt } from './solutions.js';
import { svgElement, svgLayer } from './svg.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 * @typedef {[number, number]} Point
 * @typedef {import('./cell-figure.js').Found} Found
 */

/** Least milliseconds between two announcements to screen readers. */
const QUIET = 300;
/** Size of the plot in the panel and its margin around the cell, in CSS pixels. */
const PLOT = 280;
const MARGIN = 34;

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
  const plot = svgElement('svg', { class: 'plot', viewBox: `0 0 ${PLOT} ${PLOT}`, 'aria-hidden': 'true' });
  const text = element('div', { class: 'inspected', 'aria-live': 'polite' });
  /** @type {Point | null} */
  let pointer = null;
  let timer = 0;

  /** The inspected point: the pointer's, or the middle of the view when it moves by keys. */
  function asked() {
    const { width, height } = engine.size;
    return engine.toUnit(...(pointer ?? /** @type {Point} */ ([width / 2, height / 2])));
  }

  /** @returns {Found | null} */
  function find() {
    const { data, root } = chosen;
    const point = asked();
    const cell = data && root && point ? cellAt(data, root.quad, ...point) : null;
    if (!data || !root || !point || !cell) return null;
    return {
      cell, point, inside: contains(data, root.quad, ...point), solutions: solutionsAt(cell, point[0]),
      nearest: nearestCurve(cell.curves, point), painted: root.isMap ? paintAt(data, root.quad, ...point) : null,
      colorOf: (paint) => paintCss(paintColor(data, root.quad, paint, ...point)),
    };
  }

  function write() {
    timer = 0;
    const found = state.overlays.inspect && state.value.mode === 'flat' ? find() : null;
    const hint = state.value.mode === 'flat' ? 'There is no cell here.' : 'Cells are inspected in the flat view.';
    const parts = found ? described(found) : state.overlays.inspect ? [element('p', { class: 'hint' }, hint)] : [];
    const said = parts.map((part) => part.textContent).join('');
    if (said !== text.textContent) text.replaceChildren(...parts); // avoids a repeated announcement
  }

  /** @param {Point | null} at */
  function point(at) {
    pointer = at;
    if (state.overlays.inspect) update();
  }

  function update() {
    const { inspect } = state.overlays;
    button.setAttribute('aria-pressed', String(inspect));
    const middle = inspect && pointer === null ? asked() : null;
    if (middle) chosen.point(...middle);
    const found = inspect && state.value.mode === 'flat' ? find() : null;
    layer.replaceChildren(...(found ? drawCell(found, (u, v) => engine.toScreen(u, v)) : []));
    plot.toggleAttribute('hidden', !found);
    plot.replaceChildren(...(found ? drawCell(found, plotted(found.cell)) : []));
    timer ||= window.setTimeout(write, QUIET);
  }

  watchPointer(engine, (px, py) => point([px, py])); // the last point stays when it leaves
  engine.canvas.parentElement?.addEventListener('keydown', () => point(null));
  state.addEventListener('change', update);
  chosen.addEventListener('change', update);
  for (const event of ['view', 'shape']) engine.addEventListener(event, update);
  update();
  return section('Cell', element('div', { class: 'buttons' }, button), plot, text);
}

/**
 * From the unit square to the plot, in which every cell has the same size.
 *
 * @param {Found['cell']} cell
 * @returns {(u: number, v: number) => Point}
 */
function plotted({ x, y, size }) {
  const scale = (PLOT - 2 * MARGIN) / size;
  return (u, v) => [MARGIN + (u - x) * scale, PLOT - MARGIN - (v - y) * scale];
}

/**
 * The texts of the panel.
 *
 * @param {Found} found
 */
function described({ cell, point, inside, solutions, painted, colorOf }) {
  const { paints, curves } = cell;
  const own = paints
    ? [['Mean colour', paintCss(paints.mean)], ['Base paint', paints.base === null ? 'none: a mean only' : `${paints.base}: ${colorOf(paints.base)}`]]
    : [['Coverage', cell.coverage.toFixed(3)], ['Corner winding', curves.length ? String(cell.winding) : 'none: constant']];
  const rows = [
    ['x', point[0].toFixed(8)],
    ['y', point[1].toFixed(8)],
    ['Depth', String(cell.depth)],
    ['Side', `1/${2 ** cell.depth}`],
    ...own,
    ['Curves', String(curves.length)],
  ];
  const list = element('dl', {}, ...rows.flatMap(([name, value]) => [
    element('dt', {}, name), element('dd', {}, value)]));
  const verdict = element('p', { class: 'verdict' }, painted ? paintVerdict(painted)
    : inside ? 'The point is inside.' : 'The point is outside.');
  if (!solutions.length) return [list, verdict];
  const lines = solutions.map(({ curve, t, height, filledAbove }) => {
    const sides = paints?.sides[curve];
    const said = sides ? (filledAbove ? sides : [...sides].reverse()).join(' over ') : filledAbove ? 'above' : 'below';
    return element('tr', {}, element('td', {}, String(curve + 1)), element('td', {}, t.toFixed(5)),
      element('td', {}, height.toFixed(8)), element('td', {}, said));
  });
  const head = ['Curve', 't', 'Height', paints ? 'Paints' : 'Filled'].map((name) => element('th', { scope: 'col' }, name));
  return [list, element('table', {}, element('caption', {}, 'Curves at the x of the point'),
    element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...lines)), verdict];
}

/** @param {import('../src/walk-map.js').Painted} painted */
function paintVerdict({ paint, color }) {
  return paint === null ? `The point has no paint of its own: ${paintCss(color)}.` : `The point has paint ${paint}: ${paintCss(color)}.`;
}
