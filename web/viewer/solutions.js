/**
 * Where the outline in a cell meets the upright line through a point (thesis Figure 4.9); plain data.
 *
 * @typedef {import('../src/walk.js').Cell} Cell
 *
 * @typedef {object} Solution
 * @property {number} curve which of the cell's, from 0
 * @property {number} t of the point on it
 * @property {number} height of that point, in the unit square
 * @property {boolean} filledAbove whether its filled side lies above it
 */

const HALVINGS = 60;
const SAMPLES = 24;

/**
 * One coordinate of a point of a curve.
 *
 * @param {number[]} curve x0 y0 x1 y1 x2 y2 x3 y3
 * @param {number} axis 0 for x, 1 for y
 * @param {number} t
 */
export function coordinateAt(curve, axis, t) {
  const s = 1 - t;
  return s * s * s * curve[axis] + 3 * s * t * (s * curve[axis + 2] + t * curve[axis + 4]) + t * t * t * curve[axis + 6];
}

/**
 * Solutions of x(t) = u on each curve of a cell, the lowest first. Curves are monotone: each has one, or none. Upright
 * ones have none.
 *
 * @param {Pick<Cell, 'curves'>} cell
 * @param {number} u
 * @returns {Solution[]}
 */
export function solutionsAt(cell, u) {
  /** @type {Solution[]} */
  const found = [];
  cell.curves.forEach((curve, index) => {
    const [x0, x3] = [curve[0], curve[6]];
    if (x0 === x3 || u < Math.min(x0, x3) || u > Math.max(x0, x3)) return;
    const rising = x3 > x0;
    let [low, high] = [0, 1];
    for (let i = 0; i < HALVINGS; i++) {
      const t = (low + high) / 2;
      if (coordinateAt(curve, 0, t) > u === rising) high = t;
      else low = t;
    }
    const t = u === x0 ? 0 : u === x3 ? 1 : (low + high) / 2;
    found.push({ curve: index, t, height: coordinateAt(curve, 1, t), filledAbove: rising });
  });
  return found.sort((one, other) => one.height - other.height);
}

/**
 * Which of some curves is the nearest one to a point; -1 without curves.
 *
 * @param {number[][]} curves
 * @param {readonly [number, number]} point
 */
export function nearestCurve(curves, [u, v]) {
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
 * Outline of the strip beside a curve that is on its filled side, as points: along the curve and back beside it.
 *
 * @param {[number, number][]} points P0 to P3 on the screen, y down
 * @param {number} width of the strip
 * @param {number} [steps]
 * @returns {[number, number][]}
 */
export function filledStrip(points, width, steps = 16) {
  const flat = points.flat();
  /** @type {[number, number][]} */
  const along = [];
  /** @type {[number, number][]} */
  const beside = [];
  for (let i = 0; i <= steps; i++) {
    const t = i / steps;
    const [x, y] = [coordinateAt(flat, 0, t), coordinateAt(flat, 1, t)];
    const near = [Math.max(t - 1e-3, 0), Math.min(t + 1e-3, 1)];
    const dx = coordinateAt(flat, 0, near[1]) - coordinateAt(flat, 0, near[0]);
    const dy = coordinateAt(flat, 1, near[1]) - coordinateAt(flat, 1, near[0]);
    const scale = width / (Math.hypot(dx, dy) || 1);
    along.push([x, y]);
    beside.push([x + dy * scale, y - dx * scale]); // the left hand of someone going along it, where y points down
  }
  return [...along, ...beside.reverse()];
}
