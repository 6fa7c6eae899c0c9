// Lines, arcs and ellipses as cubics; the same steps as in Python's `vexture.bezier.convert`.

/** Largest distance between a cubic and a quarter of the unit circle. */
const QUARTER_ERROR = 2.7253e-4;

/** Shortest cubic, as a part of a quarter turn. */
const FINEST = 1e-3;

/** Ratio of half the chord to the radius; a short arc below it becomes a line. */
const FLAT = 1e-7;

/** @typedef {[number, number]} Point */

/** @param {number} angle @param {number} radius @param {number} tolerance @returns {number} */
function turnSteps(angle, radius, tolerance) {
  const quarter = radius === 0 ? 1 : Math.min(1, (tolerance / (QUARTER_ERROR * radius)) ** (1 / 6));
  return Math.max(1, Math.ceil(Math.abs(angle) / ((Math.PI / 2) * Math.max(quarter, FINEST)) - 1e-9));
}

/**
 * Equal cubics along center + u cos a + v sin a.
 *
 * @param {Point} center
 * @param {Point} u
 * @param {Point} v
 * @param {number} start radians
 * @param {number} angle radians
 * @param {number} steps
 * @returns {number[][]} P1, P2 and P3 of each cubic
 */
function turnCubics(center, u, v, start, angle, steps) {
  const step = angle / steps;
  const handle = (4 / 3) * Math.tan(step / 4);
  const found = [];
  let c0 = Math.cos(start);
  let s0 = Math.sin(start);
  for (let k = 1; k <= steps; k++) {
    const c1 = Math.cos(start + k * step);
    const s1 = Math.sin(start + k * step);
    const [a1, b1, a2, b2] = [c0 - handle * s0, s0 + handle * c0, c1 + handle * s1, s1 - handle * c1];
    found.push([
      center[0] + u[0] * a1 + v[0] * b1, center[1] + u[1] * a1 + v[1] * b1,
      center[0] + u[0] * a2 + v[0] * b2, center[1] + u[1] * a2 + v[1] * b2,
      center[0] + u[0] * c1 + v[0] * s1, center[1] + u[1] * c1 + v[1] * s1,
    ]);
    [c0, s0] = [c1, s1];
  }
  return found;
}

/**
 * Cubics of an elliptical arc between two points (SVG 2, B.2.4 and B.2.5); none from a point to itself.
 *
 * @param {Point} start
 * @param {Point} radii
 * @param {number} rotation degrees
 * @param {boolean} large
 * @param {boolean} sweep
 * @param {Point} end
 * @param {number} tolerance largest distance from the true arc
 * @returns {number[][]} P1, P2 and P3 of each cubic
 */
export function arcCubics([x0, y0], radii, rotation, large, sweep, [x3, y3], tolerance) {
  let rx = Math.abs(radii[0]);
  let ry = Math.abs(radii[1]);
  if (x0 === x3 && y0 === y3) return [];
  const line = [[x0 + (x3 - x0) / 3, y0 + (y3 - y0) / 3, x3 + (x0 - x3) / 3, y3 + (y0 - y3) / 3, x3, y3]];
  if (rx === 0 || ry === 0) return line;
  const turn = rotation * (Math.PI / 180);
  const c = Math.cos(turn);
  const s = Math.sin(turn);
  const hx = (x0 - x3) / 2;
  const hy = (y0 - y3) / 2;
  let px = (c * hx + s * hy) / rx;
  let py = (c * hy - s * hx) / ry;
  let length = Math.hypot(px, py);
  if (length === 0 || (length < FLAT && !large)) return line;
  if (length > 1) {
    [rx, ry, px, py] = [rx * length, ry * length, px / length, py / length];
    length = 1;
  }
  const height = (Math.sqrt((1 - length) * (1 + length)) / length) * (large !== sweep ? 1 : -1);
  const [qx, qy] = [height * py, -height * px];
  /** @type {Point[]} */
  const [u, v] = [[c * rx, s * rx], [-s * ry, c * ry]];
  /** @type {Point} */
  const center = [(x0 + x3) / 2 + u[0] * qx + v[0] * qy, (y0 + y3) / 2 + u[1] * qx + v[1] * qy];
  const first = Math.atan2(py - qy, px - qx);
  let angle = Math.atan2(-py - qy, -px - qx) - first;
  if (sweep !== angle > 0 || angle === 0) angle += sweep ? 2 * Math.PI : -2 * Math.PI;
  const found = turnCubics(center, u, v, first, angle, turnSteps(angle, Math.max(rx, ry), tolerance));
  found[found.length - 1].splice(4, 2, x3, y3);
  return found;
}

/**
 * Ellipse as a closed contour, from its rightmost point towards +y.
 *
 * @param {Point} center
 * @param {Point} radii
 * @param {number} tolerance
 * @returns {Float64Array}
 */
export function ellipseCubics(center, radii, tolerance) {
  let steps = turnSteps(2 * Math.PI, Math.max(...radii), tolerance);
  steps += (4 - (steps % 4)) % 4; // cubics end exactly where the ellipse turns
  const quarter = turnCubics([0, 0], [1, 0], [0, 1], 0, Math.PI / 2, steps / 4);
  quarter[quarter.length - 1].splice(3, 3, 1, 0, 1);
  const unit = [];
  let start = [1, 0];
  for (const step of quarter) {
    unit.push(...start, ...step);
    start = step.slice(4);
  }
  const cubics = new Float64Array(4 * unit.length);
  for (let k = 0; k < unit.length; k += 2) {
    const [x, y] = [unit[k], unit[k + 1]];
    [[x, y], [-y, x], [-x, -y], [y, -x]].forEach((point, turned) => {
      cubics[turned * unit.length + k] = point[0] * radii[0] + center[0];
      cubics[turned * unit.length + k + 1] = point[1] * radii[1] + center[1];
    });
  }
  return cubics;
}

/**
 * @param {number[]} points x and y of each corner
 * @param {boolean} closed
 * @returns {Float64Array} straight sides as cubics
 */
export function sides(points, closed) {
  const ends = closed || points.length === 2 ? [...points, points[0], points[1]] : points;
  const cubics = new Float64Array(4 * (ends.length - 2));
  for (let k = 0; k + 2 < ends.length; k += 2) writeLine(cubics, 4 * k, ends[k], ends[k + 1], ends[k + 2], ends[k + 3]);
  return cubics;
}

/**
 * Write a straight line as a cubic whose inner points are at one and two thirds.
 *
 * @param {Float64Array} cubics
 * @param {number} at
 * @param {number} x0
 * @param {number} y0
 * @param {number} x3
 * @param {number} y3
 */
export function writeLine(cubics, at, x0, y0, x3, y3) {
  const dx = x3 - x0;
  const dy = y3 - y0;
  const values = [x0, y0, x0 + dx / 3, y0 + dy / 3, x0 + dx * (2 / 3), y0 + dy * (2 / 3), x3, y3];
  for (let k = 0; k < 8; k++) cubics[at + k] = values[k];
}
