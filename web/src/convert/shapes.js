// Outlines of the basic shapes and paths of SVG (SVG 2, 9 and 10).
import { LARGEST } from '../../generated/svg-reader.js';
import { arcCubics, ellipseCubics, sides } from './arcs.js';
import { reachOf, rectangle } from './contours.js';
import { TooLargeError, diagonal, exponential, lengthOf } from './lengths.js';
import { pathOutlines, readSets } from './path-data.js';

/** @typedef {import('./contours.js').Outline} Outline */

/**
 * @typedef {object} Shape a shape element, with the context of its geometry
 * @property {any} element
 * @property {import('./page-engine.js').Style} style
 * @property {import('./lengths.js').Viewport} view reference of percentages
 * @property {number} tolerance largest distance of a cubic from its arc, in user units
 * @property {import('./report.js').Report} report
 */

const CSS_PATH = /^path\(\s*(?:(?:nonzero|evenodd)\s*,\s*)?(['"])(.*)\1\s*\)$/s;
const HORIZONTAL = new Set(['x', 'cx', 'rx', 'width', 'x1', 'x2']);
const VERTICAL = new Set(['y', 'cy', 'ry', 'height', 'y1', 'y2']);

/** @param {Shape} shape @param {string} name determines the reference of percentages @param {string} text */
export function readLength({ view, style }, name, text) {
  const whole = HORIZONTAL.has(name) ? view.width : VERTICAL.has(name) ? view.height : diagonal(view);
  return lengthOf(view, text, whole, style.fontSize);
}

/**
 * @param {Shape} shape
 * @param {string} name
 * @returns {number | null} the length that a property sets; null for "auto"
 */
export const propertyLength = (shape, name) => readLength(shape, name, shape.style.get(name));

/** @param {Shape} shape @param {string} name @returns {number} the length in an attribute; 0 without the attribute */
function attributeLength(shape, name) {
  const text = shape.report.engine.attribute(shape.element, name);
  const length = text === null ? 0 : readLength(shape, name, text);
  if (length === null) shape.report.invalid(name, text ?? '', shape.element);
  return length ?? 0;
}

/**
 * @param {Shape} shape
 * @returns {Outline[]} in its user units
 * @throws {VextureError} if a coordinate exceeds `LARGEST`
 */
export function shapeOutlines(shape) {
  const outlines = SHAPES[shape.report.engine.name(shape.element) ?? ''](shape);
  for (const { cubics } of outlines) checkSize(cubics);
  return outlines;
}

/** @param {Float64Array} coordinates @throws {VextureError} if they are too large to compute with */
export function checkSize(coordinates) {
  const largest = reachOf(coordinates);
  if (largest <= LARGEST) return;
  const limit = exponential(LARGEST);
  throw new TooLargeError(
    `it has a coordinate of ${exponential(largest)}; the limit is ${limit}; correct it`,
    'coordinate',
  );
}

/** @param {Shape} shape @returns {string} the path data of `<path>` */
export function pathData(shape) {
  const data = shape.style.get('d');
  return CSS_PATH.exec(data)?.[2] ?? (data === 'none' ? '' : data);
}

/** @param {Shape} shape */
function path(shape) {
  const data = pathData(shape);
  const { outlines, valid } = pathOutlines(data, shape.tolerance);
  if (valid < data.length) shape.report.invalid('d', `...${data.slice(valid)}`, shape.element);
  return outlines;
}

/** @param {Shape} shape clockwise on the screen, from the right end of its top left corner */
function rect(shape) {
  const [x, y, width, height] = ['x', 'y', 'width', 'height'].map((name) => propertyLength(shape, name) ?? 0);
  if (!(width > 0 && height > 0)) return [];
  let [rx, ry] = cornerRadii(shape);
  [rx, ry] = [Math.min(rx, width / 2), Math.min(ry, height / 2)];
  const [right, bottom] = [x + width, y + height];
  if (!(rx > 0 && ry > 0)) return [rectangle(x, y, width, height)];
  /** @type {import('./arcs.js').Point} */
  let at = [x + rx, y];
  const cubics = [];
  /** @type {import('./arcs.js').Point[][]} */
  const corners = [
    [[right - rx, y], [right, y + ry]],
    [[right, bottom - ry], [right - rx, bottom]],
    [[x + rx, bottom], [x, bottom - ry]],
    [[x, y + ry], [x + rx, y]],
  ];
  for (const [side, corner] of corners) {
    const line = arcCubics(at, [0, 0], 0, false, true, side, shape.tolerance);
    for (const step of [...line, ...arcCubics(side, [rx, ry], 0, false, true, corner, shape.tolerance)]) {
      cubics.push(...at, ...step);
      at = [step[4], step[5]];
    }
  }
  return [{ cubics: Float64Array.from(cubics), closed: true }];
}

/** @param {Shape} shape @returns {[number, number]} `rx` and `ry`; "auto" takes the value of the other */
function cornerRadii(shape) {
  const [rx, ry] = [propertyLength(shape, 'rx'), propertyLength(shape, 'ry')];
  return [rx ?? ry ?? 0, ry ?? rx ?? 0];
}

/** @param {Shape} shape @param {[number, number]} radii */
function round(shape, [rx, ry]) {
  if (!(rx > 0 && ry > 0)) return [];
  /** @type {[number, number]} */
  const center = [propertyLength(shape, 'cx') ?? 0, propertyLength(shape, 'cy') ?? 0];
  return [{ cubics: ellipseCubics(center, [rx, ry], shape.tolerance), closed: true }];
}

/** @param {Shape} shape */
function circle(shape) {
  const radius = propertyLength(shape, 'r') ?? 0;
  return round(shape, [radius, radius]);
}

/** @param {Shape} shape */
function line(shape) {
  const ends = ['x1', 'y1', 'x2', 'y2'].map((name) => attributeLength(shape, name));
  return [{ cubics: sides(ends, false), closed: false }];
}

/** @param {Shape} shape @param {boolean} closed straight sides through `points`, up to the first error in them */
function corners(shape, closed) {
  const text = shape.report.engine.attribute(shape.element, 'points') ?? '';
  const { sets, end } = readSets('nn', text, 0);
  const rest = text.slice(end);
  if (rest.trim()) shape.report.invalid('points', `...${rest.trimStart()}`, shape.element);
  const points = sets.flat();
  checkSize(Float64Array.from(points));
  return sets.length > 1 ? [{ cubics: sides(points, closed), closed }] : [];
}

/** @type {Readonly<Record<string, (shape: Shape) => Outline[]>>} */
export const SHAPES = {
  path, rect, circle, line,
  ellipse: (shape) => round(shape, cornerRadii(shape)),
  polyline: (shape) => corners(shape, false),
  polygon: (shape) => corners(shape, true),
};
