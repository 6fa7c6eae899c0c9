// Paint servers, and the paints of shapes at their places.
import { MOST_STOPS, MOST_TILED, UNKNOWN_SERVERS } from '../../generated/svg-reader.js';
import { GRADIENTS, rampPaint, readRamp, readStops } from './gradients.js';
import { stopsInLinearLight } from './linear-light.js';
import { fadePaint } from './paints.js';
import { fadeTiling, readPattern, tilingOn } from './patterns.js';
import { isInside } from './space.js';

/** @typedef {import('./space.js').Place} Place */
/** @typedef {import('./contours.js').Outline} Outline */
/** @typedef {import('./paints.js').Paint} Paint */
/** @typedef {import('./patterns.js').Tiling} Tiling */

/** @type {readonly [number, number, number, number]} */
const GREY = [0.5, 0.5, 0.5, 1];

/** Largest error of a gradient in linear light that no note tells. */
const MOST_ERROR = 1 / 255;
const LINK = /^\s*url\(\s*(['"]?)(.*?)\1\s*\)\s*$/s;
const PAINT = /^url\(\s*(['"]?)(.*?)\1\s*\)\s*(.*)$/is;

/** @type {Readonly<Record<string, string>>} */
const CONTEXT = { 'context-fill': 'fill', 'context-stroke': 'stroke' };

/** @param {Paint | Tiling} paint @returns {paint is Tiling} */
export const isTiling = (paint) => 'pattern' in paint;

/** Paints that shapes refer to. */
export class PaintServers {
  /** @param {import('./page-engine.js').Engine} engine @param {import('./report.js').Report} report */
  constructor(engine, report) {
    this.engine = engine;
    this.report = report;
    /** @type {Map<any, import('./gradients.js').Ramp | null>} */
    this.ramps = new Map();
    /** @type {Map<any, import('./patterns.js').Pattern | null>} */
    this.patterns = new Map();
    /** @type {Map<string, import('./tiles.js').FirstTile>} */
    this.tiles = new Map();
    /** @type {Record<string, number>} */
    this.spent = { elements: 0, segments: 0, gradients: 0 };
  }

  /** A number that identifies a pattern. @param {import('./patterns.js').Pattern} pattern */
  numberOf(pattern) {
    return [...this.patterns.values()].indexOf(pattern);
  }

  /**
   * Whether a pattern may use these numbers of parts; if not, add a note.
   *
   * @param {any} pattern
   * @param {Record<string, number>} counts
   */
  affords(pattern, counts) {
    for (const [name, count] of Object.entries(counts)) {
      if (this.spent[name] + count <= MOST_TILED[name]) continue;
      const [here, most] = [count, MOST_TILED[name]].map((value) => value.toLocaleString('en-US'));
      const text = `here it has ${here} ${name} in its tiles; all patterns of a drawing may have ${most}`;
      this.report.simplified(`${this.report.describe(pattern)} read as solid: ${text}`);
      return false;
    }
    for (const [name, count] of Object.entries(counts)) this.spent[name] += count;
    return true;
  }

  /**
   * The element of a kind that a property refers to; null, with a note, if missing or an ancestor.
   *
   * @param {string} name
   * @param {string} kind
   * @param {Place} place
   */
  referenced(name, kind, place) {
    const value = place.style.get(name);
    if (value === 'none') return null;
    const link = LINK.exec(value);
    const target = link ? this.engine.target(link[2]) : null;
    if (!target || this.engine.name(target) !== kind) this.report.leftOut(`${name} '${value.replaceAll('"', '').slice(0, 40)}'`);
    else if (isInside(place, target, this.engine.original)) {
      this.report.leftOut(`${name} that refers to itself, of ${this.report.describe(target)}`);
    } else return target;
    return null;
  }

  /**
   * The paint of "fill" or "stroke" for outlines at a place; null if nothing is painted.
   *
   * @param {'fill' | 'stroke'} name
   * @param {Place} place
   * @param {Outline[]} outlines
   * @returns {Paint | Tiling | null}
   */
  paint(name, place, outlines) {
    const found = this.found(name, place, () => outlines);
    if (!found) return null;
    const opacity = place.style.opacity(`${name}-opacity`);
    const paint = isTiling(found) ? fadeTiling(found, opacity) : fadePaint(found, opacity);
    return paint.opacity > 0 ? paint : null;
  }

  /** @param {string} name @param {Place} place @param {() => Outline[]} outlines @returns {Paint | Tiling | null} */
  found(name, place, outlines) {
    const text = place.style.get(name).trim();
    if (text === 'none') return null;
    if (text in CONTEXT) {
      if (place.context) return this.found(CONTEXT[text], place.context.place, place.context.outlines);
      this.report.leftOut(`${text}, which has no value`);
      return null;
    }
    const match = PAINT.exec(text);
    if (!match) return this.flat(text);
    const fallback = match[3] && match[3] !== 'none' ? match[3] : null;
    return this.ofReference(match[2], fallback, place, outlines());
  }

  /** @param {string | null} text @returns {Paint | null} the paint of a flat colour */
  flat(text) {
    const color = text === null ? null : this.engine.color(text);
    return color ? { color: [color[0], color[1], color[2]], opacity: color[3], gradient: null } : null;
  }

  /**
   * The paint of a reference; its fallback if the server is missing or has no area.
   *
   * @param {string} link
   * @param {string | null} fallback
   * @param {Place} place
   * @param {Outline[]} outlines
   * @returns {Paint | Tiling | null}
   */
  ofReference(link, fallback, place, outlines) {
    const server = this.engine.target(link);
    const name = server ? this.engine.name(server) ?? '' : '';
    let found = null;
    if (server && GRADIENTS.includes(name)) {
      const ramp = this.ramp(server);
      if (!ramp) return null;
      found = rampPaint(ramp, place, outlines);
    } else if (server && name === 'pattern') found = this.tiling(server, fallback, place, outlines);
    else {
      const where = server ? 'which is no gradient or pattern' : 'which is not in the drawing';
      this.report.leftOut(UNKNOWN_SERVERS[name] ?? `paint '${link.slice(0, 40)}', ${where}`);
    }
    return found ?? this.flat(fallback);
  }

  /**
   * @param {any} server
   * @param {string | null} fallback
   * @param {Place} place
   * @param {Outline[]} outlines
   * @returns {Tiling | null}
   */
  tiling(server, fallback, place, outlines) {
    if (!this.patterns.has(server)) this.patterns.set(server, readPattern(this.chain(server, ['pattern']), this.report));
    const pattern = this.patterns.get(server);
    if (!pattern) return null;
    if (isInside(place, pattern.holder, this.engine.original)) {
      this.report.leftOut(`pattern that refers to itself, of ${this.report.describe(pattern.holder)}`);
      return null;
    }
    const solid = fallback ? this.flat(fallback) : { color: [GREY[0], GREY[1], GREY[2]], opacity: 1, gradient: null };
    return solid && tilingOn(pattern, place, outlines, /** @type {Paint} */ (solid));
  }

  /**
   * @param {any} first
   * @param {readonly string[]} kinds
   * @returns {any[]} an element, the one it refers to, and so on
   */
  chain(first, kinds) {
    /** @type {any[]} */
    const chain = [];
    for (let one = first; one && !chain.includes(one) && kinds.includes(this.engine.name(one) ?? '');) {
      chain.push(one);
      one = this.engine.target(this.engine.link(one) ?? '');
    }
    return chain;
  }

  /** @param {any} gradient @returns {import('./gradients.js').Ramp | null} null if it has no stops */
  ramp(gradient) {
    const known = this.ramps.get(gradient);
    if (known !== undefined) return known;
    const chain = this.chain(gradient, GRADIENTS);
    let stops = chain.map((one) => readStops(one, this.report)).find((list) => list.length);
    if (stops && this.engine.style(gradient).get('color-interpolation').toLowerCase() === 'linearrgb') {
      const linear = stopsInLinearLight(stops, MOST_STOPS);
      stops = linear.stops;
      if (linear.error > MOST_ERROR) {
        const error = Number((255 * linear.error).toPrecision(6));
        this.report.simplified(`gradient in linear light (color-interpolation) of many stops, up to ${error}/255`);
      }
    }
    const ramp = stops ? readRamp(chain, stops, this.report) : null;
    this.ramps.set(gradient, ramp);
    return ramp;
  }
}
