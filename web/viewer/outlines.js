/**
 * The outlines of a shape, restored from its leaves, as `src/vexture/texture/outlines.py` does, which says why it holds:
 * the boundaries of the filled parts of all leaves, of which stretches between neighbours cancel. Plain data.
 *
 * @typedef {[number, number]} Point
 * @typedef {number[]} Cubic x0 y0 x1 y1 x2 y2 x3 y3
 *
 * @typedef {object} Part of a boundary
 * @property {Cubic} cubic in units of the finest lattice, which are integers below 2^53
 * @property {boolean} isLine
 *
 * @typedef {{x: number, y: number, change: number}} Event on an upright line: `change` is added above y
 */
import { COVERAGE_ONE, LATTICE, MOST_DEPTH, QUAD_FLAG, COUNT_SHIFT, STRAIGHT, WINDING_OFFSET } from '../generated/layout.js';
import { curvesOf, leafOf } from '../src/leaf.js';

const WINDING_MASK = (1 << COUNT_SHIFT) - 1;
/** Side of the unit square, in units of the finest lattice. */
const SIDE = LATTICE * 2 ** MOST_DEPTH;

/** @param {number} x0 @param {number} y0 @param {number} x3 @param {number} y3 @returns {Cubic} */
function line(x0, y0, x3, y3) {
  const [dx, dy] = [x3 - x0, y3 - y0];
  return [x0, y0, x0 + dx / 3, y0 + dy / 3, x0 + (dx * 2) / 3, y0 + (dy * 2) / 3, x3, y3];
}

/** Whether a cubic is a line that was rounded. @param {Cubic} cubic in lattice units of its leaf */
function isRoundedLine(cubic) {
  const ideal = line(cubic[0], cubic[1], cubic[6], cubic[7]);
  return cubic.every((at, i) => Math.abs(at - ideal[i]) <= STRAIGHT);
}

/**
 * Closed contours of a shape that is no planar map, with the filled side on their left, in units of the unit square.
 *
 * @param {import('../src/data.js').PackedData} data
 * @param {number} quad index of its root quad
 * @returns {Part[][]}
 */
export function outlines(data, quad) {
  /** @type {Event[]} */
  const events = [];
  const parts = piecesOf(data, quad, events);
  const add = (/** @type {number} */ x0, /** @type {number} */ y0, /** @type {number} */ x3, /** @type {number} */ y3) =>
    parts.push({ cubic: line(x0, y0, x3, y3), isLine: true });
  stretches(events, (x, y0, y1) => add(x, y0, x, y1));
  const closing = parts.flatMap(({ cubic: [x0, y0, , , , , x3, y3] }) => [
    { x: y3, y: x3, change: 1 }, { x: y0, y: x0, change: -1 }]); // a line starts where another part ends
  stretches(closing, (y, x0, x1) => add(x0, y, x1, y));
  return cycles(parts).map(merged);
}

/**
 * The pieces of a shape that climb or fall; collects where its leaves' edges bound it.
 *
 * @param {import('../src/data.js').PackedData} data
 * @param {number} root
 * @param {Event[]} events
 */
function piecesOf({ texels }, root, events) {
  /** @type {Part[]} */
  const parts = [];
  let level = [{ quad: root, x: 0, y: 0 }];
  for (let unit = SIDE / LATTICE / 2; level.length; unit /= 2) {
    const side = LATTICE * unit;
    const below = [];
    for (const { quad, x, y } of level) {
      for (let k = 0; k < 4; k++) {
        const leaf = leafOf(texels, quad, k, false);
        const [left, bottom] = [x + side * (k & 1), y + side * (k >> 1)];
        if (leaf.byte === QUAD_FLAG) below.push({ quad: leaf.below, x: left, y: bottom });
        else if (leaf.byte) {
          const curves = curvesOf(texels, leaf);
          const corner = (leaf.byte & WINDING_MASK) - WINDING_OFFSET;
          edges(curves.map((curve) => curve.map((at, i) => at * unit + (i % 2 ? bottom : left))), left, bottom, side, corner, events);
          for (const curve of curves) {
            if (curve[1] === curve[7]) continue; // changes no winding
            parts.push({ cubic: curve.map((at, i) => at * unit + (i % 2 ? bottom : left)), isLine: isRoundedLine(curve) });
          }
        } else if (2 * leaf.coverage > COVERAGE_ONE) edges([], left, bottom, side, 1, events);
      }
    }
    level = below;
  }
  return parts;
}

/**
 * Where the left and the right edge of a leaf bound its filled part.
 *
 * @param {Cubic[]} curves
 * @param {number} left @param {number} bottom @param {number} side
 * @param {number} corner winding
 * @param {Event[]} events
 */
function edges(curves, left, bottom, side, corner, events) {
  const [right, top] = [left + side, bottom + side];
  const at = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ change) => events.push({ x, y, change });
  let last = corner;
  at(left, bottom, -corner);
  at(right, bottom, corner);
  for (const [x0, y0, , , , , x3, y3] of curves) {
    for (const [x, y, sign] of [[x0, y0, 1], [x3, y3, -1]]) {
      if (x !== left) continue;
      at(left, y, -sign);
      at(right, y, sign);
      last += sign;
    }
    const sign = Math.sign(y3 - y0);
    at(right, Math.min(y0, y3), -sign);
    at(right, Math.max(y0, y3), sign);
  }
  at(left, top, last);
  at(right, top, -last);
}

/**
 * Parts of upright lines, as often and in the direction that the sum of the changes demands; they add up to 0 on each.
 *
 * @param {Event[]} events
 * @param {(x: number, from: number, to: number) => void} found
 */
function stretches(events, found) {
  events.sort((one, other) => one.x - other.x || one.y - other.y);
  let times = 0;
  for (let i = 0; i + 1 < events.length; i++) {
    times += events[i].change;
    const [{ x, y: low }, { y: high }] = [events[i], events[i + 1]];
    if (low === high || times === 0) continue;
    for (let k = 0; k < Math.abs(times); k++) found(x, ...(times > 0 ? /** @type {Point} */ ([low, high]) : /** @type {Point} */ ([high, low])));
  }
}

/** The parts in closed cycles: each starts where the one before it ends. @param {Part[]} parts */
function cycles(parts) {
  const order = (/** @type {number} */ from) => parts.map((_, i) => i).sort((one, other) => {
    const [a, b] = [parts[one].cubic, parts[other].cubic];
    return a[from + 1] - b[from + 1] || a[from] - b[from];
  });
  const [starting, ending] = [order(0), order(6)]; // as many parts end in a point as start there
  const after = new Array(parts.length);
  ending.forEach((part, i) => (after[part] = starting[i]));
  const done = new Uint8Array(parts.length);
  const found = [];
  for (let first = 0; first < parts.length; first++) {
    const cycle = [];
    for (let part = first; !done[part]; part = after[part]) {
      done[part] = 1;
      cycle.push(parts[part]);
    }
    if (cycle.length) found.push(cycle);
  }
  return found;
}

/**
 * A contour in units of the unit square, in which each upright or level line is one part.
 *
 * @param {Part[]} cycle
 * @returns {Part[]}
 */
function merged(cycle) {
  const way = (/** @type {Part} */ { cubic, isLine }) => {
    const [dx, dy] = [Math.sign(cubic[6] - cubic[0]), Math.sign(cubic[7] - cubic[1])];
    return isLine && (dx === 0 || dy === 0) ? 3 * dx + dy : null;
  };
  const ways = cycle.map(way);
  const begins = ways.map((one, i) => one === null || one !== ways.at(i - 1));
  const turn = Math.max(begins.indexOf(true), 0);
  const kept = cycle.map((_, i) => (i + turn) % cycle.length).filter((i) => begins[i]).map((i) => cycle[i]);
  return kept.map(({ cubic, isLine }, i) => {
    const { cubic: next } = kept[(i + 1) % kept.length];
    const whole = isLine ? line(cubic[0], cubic[1], next[0], next[1]) : cubic;
    return { cubic: whole.map((at) => at / SIDE), isLine };
  });
}
