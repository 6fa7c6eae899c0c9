// Markers on the vertices of a shape, turned along its outline (SVG 2, 9.4 and 13.7).
import { ROUND } from '../../generated/svg-reader.js';
import { IDENTITY, KEYWORDS, angle, rotate, scale, translate } from './affine.js';
import { addMasks } from './masks.js';
import { diagonal, lengthOf, viewport } from './lengths.js';
import { PathPen } from './path-data.js';
import { checkSize, pathData, propertyLength, shapeOutlines } from './shapes.js';
import { contentPlace, deeper, within, withTransform } from './space.js';
import { veilOf } from './veils.js';

/** @typedef {import('./space.js').Place} Place */
/** @typedef {import('./space.js').Placed} Placed */
/** @typedef {import('./shapes.js').Shape} Shape */
/** @typedef {import('./scene.js').Scene} Scene */
/** @typedef {import('./arcs.js').Point} Point */
/** @template Result @typedef {import('./pace.js').Steps<Result>} Steps */

const MARKED = ['line', 'path', 'polygon', 'polyline'];
const MARKERS = ['marker-start', 'marker-mid', 'marker-end'];
const DEFAULT_SIZE = '3';
const REVERSED = 'auto-start-reverse';

/**
 * @param {string} name
 * @param {import('./page-engine.js').Style} style
 * @returns {boolean} whether an element can have markers
 */
export const hasMarkers = (name, style) => MARKED.includes(name) && MARKERS.some((end) => style.get(end) !== 'none');

/**
 * @typedef {object} Marker a marker, resolved for a shape
 * @property {any} element
 * @property {import('./page-engine.js').Style} style
 * @property {import('./space.js').ContentWindow} window
 * @property {number[]} anchor the point that lies on the vertex, in the units around the window
 * @property {number} scale
 * @property {number} angle radians
 * @property {boolean} follows true if the angle is relative to the outline
 */

/**
 * The content of each marker of a shape, in painting order; within a marker, the last is painted first.
 *
 * @param {Scene} scene
 * @param {any} element
 * @param {Place} place
 * @returns {Steps<Placed[][]>}
 */
export function* markersOf(scene, element, place) {
  const { engine, report } = scene;
  const shape = { element, style: place.style, view: place.view, tolerance: ROUND * diagonal(place.view), report };
  const found = MARKERS.map((name) => readMarker(scene, name, shape, place));
  if (!found.some(Boolean)) return [];
  const context = { place, outlines: () => shapeOutlines(shape) };
  const { points, angles } = vertices(shape);
  const masks = deeper(place);
  const drawn = found.flatMap((marker, k) => {
    if (!marker || !engine.children(marker.element).length) return [];
    const [first, last] = k === 0 ? [0, 1] : k === 1 ? [1, points.length - 1] : [points.length - 1, points.length];
    return [{ marker, first: Math.max(first, 0), last: Math.min(last, points.length) }];
  });
  const count = drawn.reduce((sum, { marker, first, last }) => {
    return sum + engine.children(marker.element).length * Math.max(last - first, 0);
  }, 0);
  scene.checkUsed(masks * count, masks);
  const shown = [];
  for (const { marker, first, last } of drawn) {
    for (let k = first; k < last; k++) shown.push(yield* contentOf(scene, marker, points[k], angles[k], place, context));
  }
  return shown;
}

/**
 * @param {Scene} scene
 * @param {Marker} marker
 * @param {Point} point
 * @param {number} direction
 * @param {Place} place
 * @param {Place['context']} context
 * @returns {Steps<Placed[]>} the content of a marker on one vertex
 */
function* contentOf(scene, marker, point, direction, place, context) {
  const turn = marker.angle + (marker.follows ? direction : 0);
  const turned = scale(rotate(translate(IDENTITY, ...point), turn), marker.scale);
  const matrix = translate(turned, -marker.anchor[0], -marker.anchor[1]);
  const outer = contentPlace(place, marker.element, {
    space: withTransform(place.space, matrix), style: marker.style, veil: veilOf(marker.style, place.veil),
    name: place.name, context,
  });
  const { place: inner, shown } = yield* addMasks(scene, marker.element, within(marker.window, outer));
  const content = scene.engine.children(marker.element).reverse().map((child) => /** @type {Placed} */ ([child, inner]));
  return [...content, ...shown.reverse()];
}

/** @param {Scene} scene @param {string} name @param {Shape} shape @param {Place} place @returns {Marker | null} */
function readMarker(scene, name, shape, place) {
  const { engine, report } = scene;
  const element = scene.servers.referenced(name, 'marker', place);
  if (!element) return null;
  const style = engine.style(element);
  if (!scene.noteEffects(element, style)) return null;
  const isFixed = engine.attribute(element, 'markerUnits') === 'userSpaceOnUse';
  const unit = isFixed ? 1 : propertyLength(shape, 'stroke-width') ?? 0;
  const own = { element, style, view: place.view, tolerance: shape.tolerance, report };
  const sizes = ['markerWidth', 'markerHeight'].map((key, k) => side(own, key, k ? place.view.height : place.view.width));
  const window = scene.window(element, style, [0, 0, sizes[0], sizes[1]]);
  if (!window || unit === 0) return null;
  const { content } = window;
  const [x, y] = ['refX', 'refY'].map((key, k) => anchor(own, key, window.size[k]));
  const text = (engine.attribute(element, 'orient') ?? '0').trim();
  const follows = text === 'auto' || text === REVERSED;
  const turn = follows ? (text === REVERSED && name === MARKERS[0] ? Math.PI : 0) : angle(text);
  if (turn === null) report.invalid('orient', text, element);
  return {
    element, style, window, scale: unit, angle: turn ?? 0, follows,
    anchor: [content[0] * x + content[4], content[3] * y + content[5]],
  };
}

/** @param {Shape} marker @param {string} name @param {number} whole @returns {number} width or height of a marker */
function side({ element, style, view, report }, name, whole) {
  const text = report.engine.attribute(element, name) ?? DEFAULT_SIZE;
  const length = lengthOf(view, text, whole, style.fontSize);
  if (length !== null && length >= 0) return length;
  report.invalid(name, text, element);
  return Number(DEFAULT_SIZE);
}

/**
 * @param {Shape} marker
 * @param {string} name
 * @param {number} whole
 * @returns {number} a coordinate of its reference point
 */
function anchor({ element, style, view, report }, name, whole) {
  const text = report.engine.attribute(element, name) ?? '0';
  const word = KEYWORDS[text.trim()];
  const within = word ? viewport(whole, whole) : view;
  const length = lengthOf(within, word ?? text, name === 'refX' ? within.width : within.height, style.fontSize);
  if (length === null) report.invalid(name, text, element);
  return length ?? 0;
}

/** @param {Shape} shape @returns {{ points: Point[], angles: number[] }} all vertices and directions, in order */
function vertices(shape) {
  /** @type {Subpath[]} */
  let parts;
  if (shape.report.engine.name(shape.element) === 'path') {
    const pen = new Segments(Infinity);
    pen.follow(pathData(shape));
    parts = pen.parts;
  } else {
    parts = shapeOutlines(shape).map(({ cubics, closed }) => ({
      start: [cubics[0], cubics[1]], cubics: [...cubics], closed, isJoined: false,
    }));
  }
  const points = /** @type {Point[]} */ ([]);
  const angles = [];
  for (const part of parts) {
    const skipped = Number(part.isJoined);
    if (!skipped) points.push(part.start);
    for (let k = 0; k < part.cubics.length; k += 8) points.push([part.cubics[k + 6], part.cubics[k + 7]]);
    angles.push(...anglesOf(part).slice(skipped));
  }
  checkSize(Float64Array.from(points.flat()));
  return { points, angles };
}

/**
 * @typedef {{ start: Point, cubics: number[], closed: boolean, isJoined: boolean }} Subpath with one curve for each
 *   segment
 */

/**
 * @param {Subpath} part
 * @returns {number[]} direction at each vertex: halfway between those of the adjacent segments
 */
function anglesOf({ cubics, closed }) {
  const n = cubics.length / 8;
  if (!n) return [0];
  const { leaving, arriving } = directions(cubics);
  const [first, last] = [leaving[0], arriving[n - 1]];
  const before = [closed ? last : first, ...arriving];
  const after = [...leaving, closed ? first : last];
  return before.map((from, k) => {
    const turn = after[k] - from;
    return (from + 2 * Math.PI * (Number(turn > Math.PI) - Number(turn < -Math.PI)) + after[k]) / 2;
  });
}

/**
 * @param {number[]} cubics
 * @returns {{ leaving: number[], arriving: number[] }} angles along the start and the end of each segment
 */
function directions(cubics) {
  /** @type {(number | null)[]} */
  const leaving = [];
  /** @type {(number | null)[]} */
  const arriving = [];
  const point = (/** @type {number} */ k, /** @type {number} */ p) => [cubics[8 * k + 2 * p], cubics[8 * k + 2 * p + 1]];
  const toward = (/** @type {number[]} */ [x0, y0], /** @type {number[]} */ [x1, y1]) => {
    return x0 === x1 && y0 === y1 ? null : Math.atan2(y1 - y0, x1 - x0);
  };
  for (let k = 0; k < cubics.length / 8; k++) {
    const points = [0, 1, 2, 3].map((p) => point(k, p));
    leaving.push(toward(points[0], points[1]) ?? toward(points[0], points[2]) ?? toward(points[0], points[3]));
    arriving.push(toward(points[2], points[3]) ?? toward(points[1], points[3]) ?? toward(points[0], points[3]));
  }
  // a segment of zero length takes the end direction of the one before, and the start direction of the next
  const near = (/** @type {number} */ k, /** @type {boolean} */ prefersNext) => {
    if (leaving[k] !== null) return prefersNext ? /** @type {number} */ (arriving[k]) : leaving[k];
    let [before, after] = [k, k];
    while (before >= 0 && leaving[before] === null) before--;
    while (after < leaving.length && leaving[after] === null) after++;
    const fromBefore = before >= 0 ? arriving[before] : null;
    const fromAfter = after < leaving.length ? leaving[after] : null;
    return (prefersNext ? fromAfter ?? fromBefore : fromBefore ?? fromAfter) ?? 0;
  };
  return { leaving: leaving.map((_, k) => near(k, false)), arriving: arriving.map((_, k) => near(k, true)) };
}

/** Pen that keeps each segment as one curve with its end directions, including segments that paint nothing. */
class Segments extends PathPen {
  /** @param {number} tolerance */
  constructor(tolerance) {
    super(tolerance);
    /** @type {Subpath[]} */
    this.parts = [];
    this.isJoined = false;
  }

  /** All commands but a move continue a closed part from its start. @param {string} letter @param {number[][]} sets */
  draw(letter, sets) {
    super.draw(letter, sets);
    this.isJoined &&= letter !== 'M' && letter !== 'm';
  }

  /**
   * @param {number} rx
   * @param {number} ry
   * @param {number} rotation
   * @param {boolean} large
   * @param {boolean} sweep
   * @param {Point} end
   */
  arcTo(rx, ry, rotation, large, sweep, end) {
    const first = this.cubics.length;
    super.arcTo(rx, ry, rotation, large, sweep, end);
    if (this.cubics.length > first) {
      this.cubics.splice(first, Infinity, ...this.cubics.slice(first, first + 4), ...this.cubics.slice(-4));
    }
  }

  close() {
    if (this.down && this.isBack) this.cubics.push(...this.start, ...this.start, ...this.start, ...this.start);
    super.close();
  }

  /** @param {boolean} closed */
  finish(closed) {
    if (!this.down) return;
    this.parts.push({ start: this.start, cubics: this.cubics, closed, isJoined: this.isJoined });
    [this.cubics, this.isJoined] = [[], closed];
  }
}
