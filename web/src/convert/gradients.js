// SVG gradients: their elements, and their position on the painted shapes (SVG 2, 14.2).
import { LARGEST, MOST_STOPS } from '../../generated/svg-reader.js';
import { IDENTITY, aboutOrigin, multiply, parseAttribute, parseTransform, translate } from './affine.js';
import { boundsOf } from './contours.js';
import { along, diagonal, fraction, lengthOf, number, viewport } from './lengths.js';
import { isSingular, paintInDrawing, rowsOf } from './paints.js';
import { SMALLEST } from './space.js';

/** @typedef {import('./paints.js').Stop} Stop */
/** @typedef {import('./paints.js').Gradient} Gradient */
/** @typedef {import('./lengths.js').Viewport} Viewport */

/**
 * Attributes of the geometry, with their initial values.
 *
 * @type {Readonly<Record<string, Readonly<Record<string, string>>>>}
 */
const LENGTHS = {
  linearGradient: { x1: '0%', y1: '0%', x2: '100%', y2: '0%' },
  radialGradient: { cx: '50%', cy: '50%', r: '50%', fx: '', fy: '', fr: '0%' },
};

export const GRADIENTS = Object.keys(LENGTHS);
const SPREADS = ['pad', 'reflect', 'repeat'];

/** @type {Readonly<Record<string, boolean>>} */
export const BOXED = { objectBoundingBox: true, userSpaceOnUse: false };

/** Viewport for percentages in `objectBoundingBox` units. */
export const WHOLE = viewport(1, 1);

/** Shortest ramp and tile: shorter ones have one colour and no area. */
export const SHORTEST = 1 / LARGEST;

/** Distance, relative to the outer radius, at which circles count as touching, as in Skia. */
const TOUCHING = 1 / 4096;

/**
 * @param {number} radius
 * @returns {[number, number]} centre distance and radius of a focal circle that touches, in float32
 */
function touching(radius) {
  if (radius < 0.5) {
    const away = Math.fround(1 - radius);
    return [away, 1 - away];
  }
  const focal = Math.fround(radius);
  return [Math.abs(1 - focal), focal];
}

/**
 * @typedef {object} Ramp a gradient without a position yet
 * @property {boolean} isRadial
 * @property {Record<string, string>} lengths
 * @property {boolean} isBoxed true for parts of the bounding box
 * @property {import('./affine.js').Affine} moved `gradientTransform`
 * @property {string} origin of the transform
 * @property {number} spread
 * @property {Stop[]} stops at least one
 * @property {number} fontSize
 */

/**
 * The paint of outlines at a place, in the drawing's coordinates; null if it has no area there.
 *
 * @param {Ramp} ramp
 * @param {import('./space.js').Place} place
 * @param {import('./contours.js').Outline[]} outlines
 * @returns {import('./paints.js').Paint | null}
 */
export function rampPaint(ramp, place, outlines) {
  let { whole } = place.space;
  if (ramp.isBoxed) {
    const [left, top, right, bottom] = boundsOf(outlines.map(({ cubics }) => cubics));
    whole = multiply(whole, [right - left, 0, 0, bottom - top, left, top]);
  }
  const view = ramp.isBoxed ? WHOLE : place.view;
  whole = multiply(whole, aboutOrigin(ramp.moved, ramp.origin, along(view, ramp.fontSize)));
  if (isSingular(whole, SMALLEST)) return null;
  const last = ramp.stops[ramp.stops.length - 1];
  const gradient = ramp.stops.length === 1 ? null : ramp.isRadial ? radial(ramp, view) : linear(ramp, view);
  return gradient ? paintInDrawing(gradient, whole) : { color: last.color, opacity: last.opacity, gradient: null };
}

/** @param {Ramp} ramp @param {string} name @param {Viewport} view @returns {number} */
function lengthIn({ lengths, fontSize }, name, view) {
  const axis = name.replace(/[cf12]/g, '');
  const whole = axis === 'x' ? view.width : axis === 'y' ? view.height : diagonal(view);
  return lengthOf(view, lengths[name], whole, fontSize) ?? 0;
}

/** @param {Ramp} ramp @param {Viewport} view @returns {Gradient | null} null if only the last stop's colour shows */
function linear(ramp, view) {
  const [x1, y1, x2, y2] = ['x1', 'y1', 'x2', 'y2'].map((name) => lengthIn(ramp, name, view));
  const [x, y] = [x2 - x1, y2 - y1];
  if (Math.hypot(x, y) < SHORTEST) return null;
  const square = x * x + y * y;
  const toRamp = translate([x / square, -y / square, y / square, x / square, 0, 0], -x1, -y1);
  return { toRamp: rowsOf(toRamp), stops: ramp.stops, spread: ramp.spread, focus: null };
}

/** @param {Ramp} ramp @param {Viewport} view @returns {Gradient | null} */
function radial(ramp, view) {
  const [cx, cy, r, fr] = ['cx', 'cy', 'r', 'fr'].map((name) => lengthIn(ramp, name, view));
  if (r < SHORTEST) return null;
  const x = (ramp.lengths.fx ? lengthIn(ramp, 'fx', view) - cx : 0) / r;
  const y = (ramp.lengths.fy ? lengthIn(ramp, 'fy', view) - cy : 0) / r;
  let away = Math.hypot(x, y);
  let focal = fr / r;
  const [cos, sin] = away ? [x / away, y / away] : [1, 0];
  const toRamp = rowsOf(translate([cos / r, -sin / r, sin / r, cos / r, 0, 0], -cx, -cy));
  if (Math.max(away, Math.abs(1 - focal)) <= TOUCHING) { // a single circle: the first colour inside, the last one outside
    const stops = [ramp.stops[0], ramp.stops[ramp.stops.length - 1]].map((stop) => ({ ...stop, offset: 1 }));
    return { toRamp, stops, spread: 0, focus: [0, 0] };
  }
  if (Math.abs(away - Math.abs(1 - focal)) <= TOUCHING) [away, focal] = touching(focal);
  return { toRamp, stops: ramp.stops, spread: ramp.spread, focus: [away, focal] };
}

/**
 * Read the first of some gradient elements, each of which refers to the next.
 *
 * @param {any[]} chain
 * @param {Stop[]} stops
 * @param {import('./report.js').Report} report
 * @returns {Ramp}
 */
export function readRamp(chain, stops, report) {
  const { engine } = report;
  const [first] = chain;
  const name = engine.name(first) ?? '';
  const lengths = { ...LENGTHS[name] };
  /** @type {Record<string, string>} */
  const words = { gradientUnits: '', spreadMethod: '', gradientTransform: '' };
  for (const element of [...chain].reverse()) {
    if (engine.name(element) === name) Object.assign(lengths, ownLengths(element, name, report));
    for (const key of Object.keys(words)) words[key] = engine.attribute(element, key) ?? words[key];
  }
  const style = engine.style(first);
  const own = serverTransform(style);
  const moved = own ? parseTransform(own, number) : parseAttribute(words.gradientTransform);
  const isBoxed = BOXED[words.gradientUnits.trim()];
  const spread = SPREADS.indexOf(words.spreadMethod.trim());
  if (words.gradientUnits && isBoxed === undefined) report.invalid('gradientUnits', words.gradientUnits, first);
  if (words.spreadMethod && spread < 0) report.invalid('spreadMethod', words.spreadMethod, first);
  if (!moved) report.invalid('gradientTransform', own ?? words.gradientTransform, first);
  return {
    isRadial: name === 'radialGradient', lengths, isBoxed: isBoxed !== false, moved: moved ?? IDENTITY,
    origin: style.get('transform-origin') || '0 0', spread: Math.max(spread, 0), stops, fontSize: style.fontSize,
  };
}

/**
 * @param {import('./page-engine.js').Style} style
 * @returns {string | null} the CSS transform of a paint server, if any
 */
export function serverTransform(style) {
  const text = style.declared('transform');
  return text && text !== 'none' ? text : null;
}

/**
 * @param {any} element
 * @param {string} name
 * @param {import('./report.js').Report} report
 * @returns {Record<string, string>}
 */
function ownLengths(element, name, report) {
  /** @type {Record<string, string>} */
  const found = {};
  for (const key of Object.keys(LENGTHS[name])) {
    const text = report.engine.attribute(element, key);
    if (text === null) continue;
    const value = lengthOf(WHOLE, text, 1, 1);
    const isNegative = (key === 'r' || key === 'fr') && value !== null && value < 0;
    if (value === null || isNegative) report.invalid(key, text, element);
    if (value !== null) found[key] = isNegative ? '0' : text;
  }
  return found;
}

/**
 * The stops that a gradient itself contains.
 *
 * @param {any} gradient
 * @param {import('./report.js').Report} report
 * @returns {Stop[]}
 */
export function readStops(gradient, report) {
  const { engine } = report;
  let least = 0;
  const stops = engine.children(gradient).filter((child) => engine.name(child) === 'stop').map((child) => {
    const text = engine.attribute(child, 'offset') ?? '0';
    const offset = fraction(text);
    if (offset === null) report.invalid('offset', text, child);
    least = Math.max(least, offset ?? 0);
    const style = engine.style(child);
    const [red, green, blue, alpha] = engine.color(style.get('stop-color')) ?? [0, 0, 0, 1];
    const color = /** @type {import('./paints.js').Color} */ ([red, green, blue]);
    return { offset: least, color, opacity: alpha * style.opacity('stop-opacity') };
  });
  if (stops.length <= MOST_STOPS) return stops;
  report.simplified(`gradient of more than ${MOST_STOPS} stops, of which as many are kept`);
  return Array.from({ length: MOST_STOPS }, (_, k) => stops[Math.floor(((stops.length - 1) * k) / (MOST_STOPS - 1))]);
}
