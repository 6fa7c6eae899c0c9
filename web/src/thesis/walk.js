// Descends the tree of a validated thesis texture on the CPU (FORMAT.md, part A).
import {
  CONSTANT_ROWS,
  CONTROL_MAX,
  CONTROL_MIN,
  CURVE_WIDTH,
  FULL_ROW,
  QUAD_WIDTH,
  THRESHOLD_CORNER,
  THRESHOLD_QUAD,
  CELL_ORDER,
} from '../../generated/thesis-layout.js';
import { xAt } from '../winding.js';

/** @typedef {import('./read.js').ThesisData} ThesisData */

/**
 * A cell: a quad (`row` of quads), or a constant, curve or corner (`row` of curves).
 *
 * @param {ThesisData} data
 * @param {number} quad
 * @param {number} k its place: (right half) + 2 (upper half)
 * @returns {{ isQuad: boolean, isCorner: boolean, row: number }}
 */
export function thesisCell(data, quad, k) {
  const one = 2 ** data.bits - 1;
  const at = 3 * (QUAD_WIDTH * quad + CELL_ORDER[k]);
  const red = data.quads[at] / one;
  const isQuad = red > THRESHOLD_QUAD;
  const last = (isQuad ? data.quadCount : data.curveCount) - 1;
  return { isQuad, isCorner: !isQuad && red > THRESHOLD_CORNER, row: Math.round((data.quads[at + 1] / one) * last) };
}

/**
 * Point on a cell's edge.
 *
 * @param {number} edge distance clockwise from the top left corner, divided by 4
 * @returns {[number, number]}
 */
function edgePoint(edge) {
  const s = 4 * edge;
  if (s < 1) return [s, 1];
  if (s < 2) return [1, 2 - s];
  return s < 3 ? [3 - s, 0] : [0, s - 3];
}

/**
 * Closed outline around the filled part of a leaf: its curve or corner, and the cell's edge clockwise from its end
 * to its start.
 *
 * @param {ThesisData} data
 * @param {number} row of the curve
 * @param {boolean} isCorner
 * @returns {number[][]} cubics, each monotone in y
 */
function outline(data, row, isCorner) {
  const one = 2 ** data.bits - 1;
  const at = 3 * CURVE_WIDTH * row;
  const [e0, g0, b0, e3, g3, b3] = Array.from(data.curves.subarray(at, at + 6), (channel) => channel / one);
  const [start, end] = [edgePoint(e0), edgePoint(e3)];
  const cubics = isCorner
    ? [straight(start, [g0, g3]), straight([g0, g3], end)]
    : monotone([...start, ...[g0, g3, b0, b3].map((at) => CONTROL_MIN + (CONTROL_MAX - CONTROL_MIN) * at), ...end]);
  let from = end;
  const until = e0 > e3 ? e0 : e0 + 1;
  for (let corner = (Math.floor(4 * e3) + 1) / 4; corner < until; corner += 0.25) {
    const to = edgePoint(corner % 1);
    cubics.push(straight(from, to));
    from = to;
  }
  cubics.push(straight(from, start));
  return cubics;
}

/**
 * @param {number[]} a
 * @param {number[]} b
 */
function straight([x0, y0], [x3, y3]) {
  return [x0, y0, (2 * x0 + x3) / 3, (2 * y0 + y3) / 3, (x0 + 2 * x3) / 3, (y0 + 2 * y3) / 3, x3, y3];
}

/**
 * Split a cubic into pieces that are monotone in y. Adjacent pieces share their ends bit for bit.
 *
 * @param {number[]} cubic
 */
function monotone(cubic) {
  const [, y0, , y1, , y2, , y3] = cubic;
  const [a, b, c] = [y3 - 3 * y2 + 3 * y1 - y0, 2 * (y2 - 2 * y1 + y0), y1 - y0]; // a t^2 + b t + c is y' / 3
  const root = Math.sqrt(b * b - 4 * a * c);
  const larger = b < 0 ? (root - b) / 2 : -(root + b) / 2;
  const turns = [larger / a, c / larger].filter((t) => t > 0 && t < 1).sort((one, other) => one - other);
  const pieces = [];
  let [rest, before] = [cubic, 0];
  for (const turn of turns) {
    const [first, second] = split(rest, (turn - before) / (1 - before));
    pieces.push(first);
    [rest, before] = [second, turn];
  }
  return [...pieces, rest];
}

/**
 * Split a cubic at t, by de Casteljau's algorithm.
 *
 * @param {number[]} p
 * @param {number} t
 */
function split(p, t) {
  const mix = (/** @type {number[]} */ q) => Array.from({ length: q.length - 2 }, (_, i) => q[i] + t * (q[i + 2] - q[i]));
  const q = mix(p);
  const r = mix(q);
  const s = mix(r);
  return [
    [p[0], p[1], q[0], q[1], r[0], r[1], s[0], s[1]],
    [s[0], s[1], r[2], r[3], q[4], q[5], p[6], p[7]],
  ];
}

/**
 * Whether a point is inside the shape (FORMAT.md, A.6).
 *
 * @param {ThesisData} data
 * @param {number} u
 * @param {number} v upwards
 * @returns {boolean}
 */
export function containsThesis(data, u, v) {
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return false;
  let quad = 0;
  for (;;) {
    const right = u >= 0.5 ? 1 : 0;
    const upper = v >= 0.5 ? 1 : 0;
    u = 2 * u - right;
    v = 2 * v - upper;
    const { isQuad, isCorner, row } = thesisCell(data, quad, right + 2 * upper);
    if (isQuad) quad = row; // larger each time: the data are checked
    else if (row < CONSTANT_ROWS) return row === FULL_ROW;
    else return isOdd(outline(data, row, isCorner), u, v);
  }
}

/**
 * Whether the winding number of closed outlines at a point is odd. Their pieces are monotone in y.
 *
 * @param {number[][]} cubics
 * @param {number} x
 * @param {number} y
 */
function isOdd(cubics, x, y) {
  let odd = false;
  for (const cubic of cubics) {
    if (cubic[1] <= y !== cubic[7] <= y && xAt(cubic, y) <= x) odd = !odd;
  }
  return odd;
}

