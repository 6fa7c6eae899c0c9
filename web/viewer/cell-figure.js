/**
 * A cell drawn with its curves, their control points and filled sides, and the solutions at a point (thesis Figure 4.9).
 *
 * @typedef {import('../src/walk.js').Cell} Cell
 * @typedef {[number, number]} Point
 *
 * @typedef {object} Found
 * @property {Cell} cell
 * @property {Point} point in the unit square
 * @property {boolean} inside
 * @property {import('./solutions.js').Solution[]} solutions
 * @property {number} nearest index of the curve nearest to the point; -1 without curves
 * @property {import('../src/walk-map.js').Painted | null} painted what is at the point of a planar map
 * @property {(paint: number) => string} colorOf colour of a map's paint, for CSS
 */
import { coordinateAt, filledStrip } from './solutions.js';
import { cellRect, svgElement } from './svg.js';

/** CSS pixels: width of the strip on a filled side; from a point to its name; the smallest curve whose points have names. */
const STRIP = 7;
const ASIDE = 14;
const LEGIBLE = 48;

/**
 * @param {Found} found
 * @param {(u: number, v: number) => Point} toScreen
 */
export function drawCell({ cell, point, inside, solutions, nearest, colorOf }, toScreen) {
  const screens = cell.curves.map((curve) => [0, 1, 2, 3].map((k) => toScreen(curve[2 * k], curve[2 * k + 1])));
  const [x, y] = toScreen(...point);
  const [, bottom] = toScreen(cell.x, cell.y);
  const [, top] = toScreen(cell.x, cell.y + cell.size);
  const dots = solutions.flatMap(({ curve, t, height }) => {
    const at = toScreen(point[0], height);
    const dot = svgElement('circle', { class: 'solution', cx: at[0], cy: at[1], r: 4.5 });
    const named = curve === nearest && isLegible(screens[curve]);
    return named ? [dot, label(at, `t = ${t.toFixed(3)}`, 'solution-label', asideOf(screens[curve], 2.4))] : [dot];
  });
  const curves = screens.map((points, index) => curveGroup(points, index, index === nearest, cell.paints?.sides[index].map(colorOf)));
  if (nearest >= 0) curves.push(...curves.splice(nearest, 1)); // above the others
  return [
    cellRect(toScreen, cell, 'inspected-cell'),
    ...curves,
    ...['upright-casing', 'upright'].map((name) => svgElement('line', { class: name, x1: x, x2: x, y1: bottom, y2: top })),
    ...dots,
    svgElement('circle', { class: inside ? 'point inside' : 'point outside', cx: x, cy: y, r: 5 }),
  ];
}

/** @param {Point[]} points */
function isLegible(points) {
  const [dx, dy] = [points[3][0] - points[0][0], points[3][1] - points[0][1]];
  return Math.hypot(dx, dy) >= LEGIBLE;
}

/**
 * Direction from a curve to its filled side.
 *
 * @param {Point[]} points P0 to P3 on the screen, y down
 * @param {number} [times] factor of its length
 * @returns {Point}
 */
function asideOf([p0, , , p3], times = 1) {
  const [dx, dy] = [p3[0] - p0[0], p3[1] - p0[1]];
  const scale = (times * ASIDE) / (Math.hypot(dx, dy) || 1);
  return [dy * scale, -dx * scale];
}

/**
 * @param {Point[]} points P0 to P3 on the screen
 * @param {number} index
 * @param {boolean} isNearest whether its points have names
 * @param {string[]} [sides] colours on its left and its right, of a planar map
 */
function curveGroup(points, index, isNearest, sides) {
  const text = points.map((at) => at.join(' '));
  const group = svgElement('g', { class: isNearest ? 'curve nearest' : 'curve' },
    ...(sides ? [strip(points, STRIP, sides[0]), strip(points, -STRIP, sides[1])] : [strip(points, STRIP)]),
    svgElement('polyline', { class: 'control-polygon', points: text.join(' ') }),
    svgElement('path', { class: 'outline', d: `M ${text[0]} C ${text.slice(1).join(' ')}` }),
    ...points.map(([cx, cy], k) => svgElement('circle', { class: k % 3 ? 'control' : 'end', cx, cy, r: 3.5 })));
  if (!isLegible(points)) return group;
  if (isNearest) points.forEach((at, k) => group.append(label(at, `P${k}`, 'point-label', asideOf(points, -1))));
  const flat = points.flat();
  const middle = /** @type {Point} */ ([coordinateAt(flat, 0, 0.5), coordinateAt(flat, 1, 0.5)]);
  group.append(label(middle, String(index + 1), 'curve-label', asideOf(points, 1.2)));
  return group;
}

/** @param {Point[]} points @param {number} width of it, negative on the right @param {string} [color] */
function strip(points, width, color) {
  const corners = filledStrip(points, width).map((at) => at.join(',')).join(' ');
  return svgElement('polygon', { class: 'filled-side', points: corners, ...(color ? { style: `fill: ${color}; fill-opacity: 0.9` } : {}) });
}

/** @param {Point} at @param {string} text @param {string} name @param {Point} aside */
function label([x, y], text, name, [dx, dy]) {
  return svgElement('text', { class: name, x: x + dx, y: y + dy }, text);
}
