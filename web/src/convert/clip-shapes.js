// Clips by basic shapes of CSS (CSS Masking 1, 5.1; CSS Shapes 1, 3).
import { ROUND } from '../../generated/svg-reader.js';
import { IDENTITY, parseOrigin, stretch, translate } from './affine.js';
import { arcCubics, ellipseCubics, sides } from './arcs.js';
import { loopOf, mapPoints, rectangle } from './contours.js';
import { along, diagonal, lengthOf, viewport, words } from './lengths.js';
import { pathOutlines } from './path-data.js';

/** @typedef {import('./contours.js').Rectangle} Rectangle */
/** @typedef {import('./arcs.js').Point} Point */
/**
 * @typedef {{ left: number, top: number, view: import('./lengths.js').Viewport, fontSize: number, tolerance: number }}
 *   Box
 */

/** Outlines of a basic shape, and its rectangle if it is an upright one. */
export class ClipShape {
  /** @param {Float64Array[]} contours @param {number} rule @param {Rectangle | null} [box] */
  constructor(contours, rule, box = null) {
    this.contours = contours;
    this.rule = rule;
    this.rectangle = box;
  }
}

/** Reference boxes, with the box that each one means for SVG elements. @type {Readonly<Record<string, string>>} */
const BOXES = {
  'content-box': 'fill', 'padding-box': 'fill', 'fill-box': 'fill', 'view-box': 'view',
  'border-box': 'stroke', 'margin-box': 'stroke', 'stroke-box': 'stroke',
};

/**
 * Indices of the second to fourth of four values, by the number of values.
 *
 * @type {Readonly<Record<number, number[]>>}
 */
const SIDES_OF = { 1: [0, 0, 0], 2: [1, 0, 1], 3: [1, 2, 1], 4: [1, 2, 3] };

const SPACES = /\s+/;

/** @type {Readonly<Record<string, (text: string, box: Box) => ClipShape | null>>} */
const MAKERS = { circle, ellipse, inset, rect, xywh, polygon, path };

/**
 * The clip by a basic shape of an element; null if there is none, or it is not supported.
 *
 * @param {import('./scene.js').Scene} scene
 * @param {any} element
 * @param {import('./space.js').Place} place
 * @returns {import('./pace.js').Steps<ClipShape | null>}
 */
export function* clipShape(scene, element, place) {
  const value = place.style.get('clip-path');
  if (element === scene.root || ['clipPath', 'mask'].includes(scene.engine.name(element) ?? '')) return null;
  const match = /^(.*?)(?:([a-z]+)\((.*)\))?([^()]*)$/is.exec(value.trim());
  const make = match?.[2] ? MAKERS[match[2].toLowerCase()] : null;
  const names = `${match?.[1]} ${match?.[4]}`.toLowerCase().split(/\s+/).filter(Boolean);
  if (!match || (match[2] && !make) || names.length > 1 || !names.every((name) => name in BOXES)) return null;
  const kind = names.length ? BOXES[names[0]] : 'stroke';
  const [left, top, width, height] = kind === 'view'
    ? [0, 0, place.view.width, place.view.height]
    : (yield* scene.around(element, place, kind === 'stroke')) ?? [0, 0, 0, 0];
  const tolerance = ROUND * scene.size / stretch(place.space.whole);
  const box = { left, top, view: viewport(width, height, place.view.rem), fontSize: place.style.fontSize, tolerance };
  return make ? make(match[3], box) : upright(left, top, width, height);
}

/** @param {number} x @param {number} y @param {number} width @param {number} height @returns {ClipShape} */
function upright(x, y, width, height) {
  return new ClipShape(width > 0 && height > 0 ? [rectangle(x, y, width, height).cubics] : [], 0, [x, y, width, height]);
}

/**
 * @param {string} text
 * @param {Box} box
 * @param {readonly number[]} axes
 * @returns {number[] | null} one to four lengths as four
 */
function four(text, { view, fontSize }, axes) {
  const parts = words(text, SPACES);
  if (parts.length < 1 || parts.length > 4) return null;
  const all = [parts[0], ...SIDES_OF[parts.length].map((k) => parts[k])];
  const found = all.map((part, k) => along(view, fontSize)(part, axes[k]));
  return found.includes(null) ? null : /** @type {number[]} */ (found);
}

/** @param {string} text @param {Box} box @returns {[number, number] | null} relative to the box's corner */
function position(text, { view, fontSize }) {
  const length = along(view, fontSize);
  const parts = words(text, SPACES);
  if (parts.length < 3) return parseOrigin(text || 'center', length);
  if (parts.length !== 4) return null;
  const found = [NaN, NaN];
  for (const [edge, distance] of [parts.slice(0, 2), parts.slice(2)]) {
    const axis = edge === 'top' || edge === 'bottom' ? 1 : 0;
    const value = length(distance, axis) ?? NaN;
    if (edge === 'right' || edge === 'bottom') found[axis] = (axis ? view.height : view.width) - value;
    else if (edge === 'left' || edge === 'top') found[axis] = value;
  }
  return found.some(Number.isNaN) ? null : [found[0], found[1]];
}

/** @param {string} text @param {Box} box @param {number} most @returns {{ radii: string[], centre: Point } | null} */
function radiiAndCentre(text, box, most) {
  const [before, ...places] = text.toLowerCase().split(/\bat\b/);
  const radii = words(before, SPACES);
  const centre = places.length < 2 ? position((places[0] ?? '').trim(), box) : null;
  if (!centre || ![0, most].includes(radii.length)) return null;
  return { radii: radii.length ? radii : Array(most).fill('closest-side'), centre };
}

/** @param {string} word @param {number[]} distances @param {() => number | null} length @returns {number | null} */
function radiusOf(word, distances, length) {
  if (word === 'closest-side') return Math.min(...distances.map(Math.abs));
  if (word === 'farthest-side') return Math.max(...distances.map(Math.abs));
  const radius = length();
  return radius === null || radius < 0 ? null : radius;
}

/** @param {Box} box @param {Point} centre @param {number | null} rx @param {number | null} ry */
function round({ left, top, tolerance }, [x, y], rx, ry) {
  if (rx === null || ry === null) return null;
  return new ClipShape(rx > 0 && ry > 0 ? [ellipseCubics([left + x, top + y], [rx, ry], tolerance)] : [], 0);
}

/** @param {string} text @param {Box} box */
function circle(text, box) {
  const found = radiiAndCentre(text, box, 1);
  if (!found) return null;
  const [x, y] = found.centre;
  const { view } = box;
  const distances = [x, view.width - x, y, view.height - y];
  const r = radiusOf(found.radii[0], distances, () => lengthOf(view, found.radii[0], diagonal(view), box.fontSize));
  return round(box, found.centre, r, r);
}

/** @param {string} text @param {Box} box */
function ellipse(text, box) {
  const found = radiiAndCentre(text, box, 2);
  if (!found) return null;
  const [rx, ry] = found.centre.map((at, axis) => {
    const whole = axis ? box.view.height : box.view.width;
    return radiusOf(found.radii[axis], [at, whole - at], () => along(box.view, box.fontSize)(found.radii[axis], axis));
  });
  return round(box, found.centre, rx, ry);
}

/** @param {string} text @returns {[string, string]} the parts before and after "round" */
function splitRound(text) {
  const [edges, corners] = text.toLowerCase().split(/\bround\b(?!\()/);
  return [edges, corners ?? '0'];
}

/** @param {string} text @param {Box} box distances from the sides */
function inset(text, box) {
  const [edges, corners] = splitRound(text);
  const found = four(edges, box, [1, 0, 1, 0]);
  return found && rounded([found[3], found[0], box.view.width - found[1], box.view.height - found[2]], corners, box);
}

/** @param {string} text @param {Box} box positions of the sides from the top and the left */
function rect(text, box) {
  const [edges, corners] = splitRound(text);
  const parts = words(edges, SPACES).map((part, k) => (part === 'auto' ? ['0%', '100%', '100%', '0%'][k] : part));
  const found = parts.length === 4 ? four(parts.join(' '), box, [1, 0, 1, 0]) : null;
  return found && rounded([found[3], found[0], Math.max(found[3], found[1]), Math.max(found[0], found[2])], corners, box);
}

/** @param {string} text @param {Box} box a corner and two sides */
function xywh(text, box) {
  const [edges, corners] = splitRound(text);
  const found = words(edges, SPACES).length === 4 ? four(edges, box, [0, 1, 0, 1]) : null;
  if (!found || Math.min(found[2], found[3]) < 0) return null;
  return rounded([found[0], found[1], found[0] + found[2], found[1] + found[3]], corners, box);
}

/** @param {[number, number, number, number]} edges left, top, right, bottom @param {string} corners @param {Box} box */
function rounded([west, north, east, south], corners, box) {
  const [width, height] = [Math.max(east - west, 0), Math.max(south - north, 0)];
  const parts = words(corners, /\//);
  const rx = four(parts[0] ?? '', box, [0, 0, 0, 0]);
  const ry = four(parts[parts.length - 1] ?? '', box, [1, 1, 1, 1]);
  if (!rx || !ry || parts.length > 2 || Math.min(...rx, ...ry) < 0) return null;
  const [left, top] = [box.left + west, box.top + north];
  const pairs = [[width, rx[0] + rx[1]], [width, rx[2] + rx[3]], [height, ry[0] + ry[3]], [height, ry[1] + ry[2]]];
  const factor = Math.min(1, ...pairs.filter(([, sum]) => sum > 0).map(([side, sum]) => side / sum));
  const radii = rx.map((x, k) => (x > 0 && ry[k] > 0 ? [factor * x, factor * ry[k]] : [0, 0]));
  if (!width || !height || radii.every(([x, y]) => !x || !y)) return upright(left, top, width, height);
  const [right, bottom] = [left + width, top + height];
  const [[ax, ay], [bx, by], [cx, cy], [dx, dy]] = radii;
  /** @type {[Point, Point, Point][]} */
  const turns = [
    [[right - bx, top], [bx, by], [right, top + by]],
    [[right, bottom - cy], [cx, cy], [right - cx, bottom]],
    [[left + dx, bottom], [dx, dy], [left, bottom - dy]],
    [[left, top + ay], [ax, ay], [left + ax, top]],
  ];
  /** @type {Point} */
  let at = [left + ax, top];
  const cubics = [];
  for (const [side, radius, corner] of turns) {
    const line = arcCubics(at, [0, 0], 0, false, true, side, box.tolerance);
    for (const step of [...line, ...arcCubics(side, radius, 0, false, true, corner, box.tolerance)]) {
      cubics.push(...at, ...step);
      at = [step[4], step[5]];
    }
  }
  return new ClipShape([Float64Array.from(cubics)], 0);
}

/** @param {string} text @param {Box} box */
function polygon(text, box) {
  const match = /^\s*(?:(nonzero|evenodd)\s*,)?(.*)$/is.exec(text);
  const points = [];
  for (const point of words(match?.[2] ?? '', /,/)) {
    const parts = words(point, SPACES).map((part, axis) => along(box.view, box.fontSize)(part, axis));
    const [x, y] = parts;
    if (parts.length !== 2 || x === null || y === null) return null;
    points.push(box.left + x, box.top + y);
  }
  if (!points.length) return null;
  return new ClipShape(points.length > 2 ? [sides(points, true)] : [], ruleOf(match?.[1]));
}

/** @param {string} text @param {Box} box */
function path(text, box) {
  const match = /^\s*(?:(nonzero|evenodd)\s*,)?\s*(['"])(.*)\2\s*$/is.exec(text);
  if (!match) return null;
  const moved = translate(IDENTITY, box.left, box.top);
  const { outlines } = pathOutlines(match[3], box.tolerance);
  return new ClipShape(outlines.map((outline) => mapPoints(loopOf(outline), moved)), ruleOf(match[1]));
}

/** @param {string | undefined} word @returns {number} */
const ruleOf = (word) => Number(word?.toLowerCase() === 'evenodd');

