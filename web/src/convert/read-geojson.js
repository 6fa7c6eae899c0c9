// Reads GeoJSON (RFC 7946) and TopoJSON: the areas of their polygons, with their simplestyle colours.
import { VextureError, line, shortened } from '../errors.js';
import { sides } from './arcs.js';
import { EVENODD, boxOf, fitSource } from './drawing.js';
import { Notes } from './notes.js';
import { Pace } from './pace.js';
import { LONGEST } from './parse.js';

/** @import { Drawing, Path, Paint } from './drawing.js' */

/**
 * @typedef {object} GeojsonLook What `readGeojson` takes of a source.
 * @property {string} [name] name of the shape; `drawing` by default
 * @property {string} [names] property of the features that names the paths, in place of `id`
 *
 * @typedef {GeojsonLook & import('./pace.js').PaceOptions} GeojsonOptions Options of `readGeojson`, and its limits.
 *
 * @typedef {[number, number]} Position
 *
 * @typedef {object} Area A polygon.
 * @property {Position[][]} rings the first position of each is not repeated at its end
 * @property {Paint} paint
 * @property {string} element name of its feature
 */

const MOST_POSITIONS = 20_000_000;

/** Levels of nested geometry collections. */
const MOST_NESTED = 32;

/** Refusal of values in one another by the thousand. */
const TOO_DEEP = 'its lists are nested too deeply; GeoJSON needs no more than a few levels';

/** Largest coordinate. */
const LARGEST = 1e300;

/** Reference system without the member `crs`: longitude and latitude in degrees (RFC 7946, 4). */
const WORLD = 'OGC:CRS84';

const WITHOUT_AREA = ['Point', 'MultiPoint', 'LineString', 'MultiLineString'];
const COLOR = /^#?([0-9a-f]{3}|[0-9a-f]{6})$/i;
const URN = /^urn:ogc:def:crs:(\w+):[^:]*:(\w+)$/i;

/**
 * Read the polygons of GeoJSON or TopoJSON with their holes, one path for each polygon.
 *
 * Their bounding box is fitted into the unit square at its own aspect ratio. The properties `fill` and `fill-opacity` of a
 * feature give its paint, black by default. Its `id`, or else its property `name`, names its paths. Points and lines have no
 * area; they are left out and noted.
 *
 * @param {string | object} source the text, or its parsed value
 * @param {GeojsonOptions} [options]
 * @returns {Promise<Drawing>}
 * @throws {VextureError} if it is not GeoJSON, or holds no polygon
 */
export async function readGeojson(source, { signal, maxSeconds, ...look } = {}) {
  return readPacedGeojson(source, look, new Pace({ signal, maxSeconds }));
}

/**
 * Read GeoJSON as `readGeojson` does, with limits of time that others share.
 *
 * @param {string | object} source
 * @param {GeojsonLook} look
 * @param {Pace} pace
 * @returns {Promise<Drawing>}
 */
export async function readPacedGeojson(source, look, pace) {
  const value = await geojsonOf(typeof source === 'string' ? parsed(source) : source);
  return pace.run(drawingOf(value, look, pace));
}

/**
 * @param {any} value the outermost object
 * @param {GeojsonLook} look
 * @param {Pace} pace
 * @returns {import('./pace.js').Steps<Drawing>}
 */
function* drawingOf(value, { name = 'drawing', names }, pace) {
  const notes = new Notes();
  const reader = new Reader(notes, names);
  const areas = [];
  try {
    for (const area of reader.areas(value)) {
      if (pace.isDue()) yield;
      areas.push(area);
    }
  } catch (error) {
    if (isTooDeep(error)) refuse(TOO_DEEP);
    throw error;
  }
  if (!areas.length) {
    const list = notes.inOrder.map(({ message, count }) => (count > 1 ? `${message} (${count})` : message)).join(', ');
    refuse(`it holds no polygon to fill${list && ` (left out: ${list})`}; give Polygon or MultiPolygon geometries`);
  }
  reader.checkNames();
  const paths = [];
  for (const area of areas) {
    if (pace.isDue()) yield;
    paths.push(pathOf(area));
  }
  const drawing = yield* fitSource(paths, boxOf(paths.flatMap(({ contours }) => contours)), name, pace);
  if (!drawing.paths.length) refuse('its polygons enclose no area; correct their coordinates');
  const [a, b, c, d, e, f] = drawing.toSource; // y down
  return { ...drawing, toSource: [a, -b || 0, c, -d || 0, e, -f || 0], crs: systemOf(value.crs), notes: notes.inOrder };
}

/** @param {string} text */
function parsed(text) {
  if (text.length > LONGEST) {
    const [count, most] = [text.length, LONGEST].map((value) => value.toLocaleString('en-US'));
    refuse(`the text has ${count} letters; a page reads ${most}; simplify or split it, or convert it with the program vexture`);
  }
  try {
    return JSON.parse(text.replace(/^\ufeff/, ''));
  } catch (error) {
    if (isTooDeep(error)) refuse(TOO_DEEP);
    return refuse(`not JSON (${line(error)}); correct it`);
  }
}

/**
 * GeoJSON, or what a TopoJSON of it holds.
 *
 * @param {any} value
 */
async function geojsonOf(value) {
  if (!isObject(value)) refuse(`its outermost value is ${line(value)}, not an object; this is not GeoJSON`);
  if (value.type === undefined) refuse('its outermost object has no "type", so it is not GeoJSON; give GeoJSON or TopoJSON');
  if (value.type !== 'Topology') return value;
  const { feature } = await import('topojson-client');
  try {
    const collections = Object.values(value.objects).map((object) => /** @type {any} */ (feature(value, object)));
    return { type: 'FeatureCollection', features: collections.flatMap((one) => one.features ?? [one]), crs: value.crs };
  } catch (error) {
    if (isTooDeep(error)) refuse(TOO_DEEP);
    return refuse(`its topology is damaged (${line(error)}); write it again`);
  }
}

/** Reader of one file, which collects notes and counts positions. */
class Reader {
  #notes;
  #names;
  #known = new Set();
  #positions = 0;

  /**
   * @param {Notes} notes
   * @param {string} [names]
   */
  constructor(notes, names) {
    this.#notes = notes;
    this.#names = names;
  }

  /**
   * Yield the areas of the outermost object.
   *
   * @param {any} value
   * @returns {Generator<Area>}
   */
  *areas(value) {
    if (value.type === 'Feature') yield* this.#feature(value, 'the feature');
    else if (value.type !== 'FeatureCollection') yield* this.#geometry(value, '', plain());
    else if (!Array.isArray(value.features)) refuse('the FeatureCollection has no list of features; correct it');
    else for (const [k, feature] of value.features.entries()) yield* this.#feature(feature, `feature ${k + 1}`);
  }

  /** Refuse the option `names` if no feature has such a property. */
  checkNames() {
    if (this.#names === undefined || this.#known.has(this.#names)) return;
    const known = [...this.#known].sort().slice(0, 10).map((name) => `'${name}'`).join(', ') || 'none';
    refuse(`no feature has the property '${this.#names}' of \`names\`; there are ${known}`);
  }

  /**
   * @param {any} value
   * @param {string} place
   * @returns {Generator<Area>}
   */
  *#feature(value, place) {
    if (!isObject(value) || value.type !== 'Feature') refuse(`${place} is not of the type Feature; correct it`);
    if ((value.geometry ?? null) === null) {
      this.#notes.leftOut('feature without geometry'); // RFC 7946, 3.2: an unlocated feature
      return;
    }
    const properties = isObject(value.properties) ? value.properties : {};
    yield* this.#geometry(value.geometry, place, { paint: this.#paint(properties), element: this.#element(value.id, properties) });
  }

  /**
   * @param {any} value
   * @param {string} place of it in messages
   * @param {{ paint: Paint, element: string }} look
   * @param {number} [depth]
   * @returns {Generator<Area>}
   */
  *#geometry(value, place, look, depth = 0) {
    if (!isObject(value)) refuse(`${at(place, 'the geometry')} is ${line(value)}, not an object; correct it`);
    const { type } = value;
    const content = type === 'GeometryCollection' ? value.geometries : value.coordinates;
    if (WITHOUT_AREA.includes(type)) {
      this.#notes.leftOut(type);
      return;
    }
    if (!['Polygon', 'MultiPolygon', 'GeometryCollection'].includes(type)) {
      refuse(`${at(place, 'type')} ${line(type)} is none that GeoJSON knows; see RFC 7946, 1.4`);
    }
    if (!Array.isArray(content)) refuse(`${at(place, type)} has no list of its parts; correct it`);
    if (type === 'Polygon') yield* this.#polygon(content, place, look);
    else if (type === 'MultiPolygon') {
      for (const [k, rings] of content.entries()) yield* this.#polygon(rings, at(place, `polygon ${k + 1}`), look);
    } else if (depth === MOST_NESTED) refuse(`${shortened(at(place, type))} is nested more than ${MOST_NESTED} deep; flatten it`);
    else for (const [k, part] of content.entries()) yield* this.#geometry(part, at(place, `geometry ${k + 1}`), look, depth + 1);
  }

  /**
   * @param {any} rings
   * @param {string} place
   * @param {{ paint: Paint, element: string }} look
   * @returns {Generator<Area>}
   */
  *#polygon(rings, place, look) {
    if (!Array.isArray(rings)) refuse(`${at(place, 'the polygon')} is ${line(rings)}, not a list of rings; correct it`);
    const read = rings.map((ring, k) => this.#ring(ring, at(place, `ring ${k + 1}`)));
    const enclosing = read.filter((ring) => ring !== null);
    if (enclosing.length) yield { rings: enclosing, ...look };
  }

  /**
   * @param {any} ring
   * @param {string} place
   * @returns {Position[] | null} null if it has fewer than three positions
   */
  #ring(ring, place) {
    if (!Array.isArray(ring)) refuse(`${place} is ${line(ring)}, not a list of positions; correct it`);
    this.#positions += ring.length;
    if (this.#positions > MOST_POSITIONS) {
      refuse(`${place} is beyond the limit of ${MOST_POSITIONS} positions; simplify or split it`);
    }
    for (const [k, position] of ring.entries()) {
      if (!Array.isArray(position) || ![position[0], position[1]].every((one) => Math.abs(one) <= LARGEST && typeof one === 'number')) {
        refuse(`${place}, position ${k + 1} is ${line(position)}; it must be two finite numbers`);
      }
    }
    const [first, last] = [ring[0], ring[ring.length - 1]];
    const closed = ring.length > 1 && first[0] === last[0] && first[1] === last[1];
    const points = closed ? ring.slice(0, -1) : ring;
    if (points.length >= 3) return points;
    this.#notes.leftOut('ring of fewer than three positions');
    return null;
  }

  /**
   * @param {any} id
   * @param {Record<string, any>} properties
   * @returns {string}
   */
  #element(id, properties) {
    for (const key of Object.keys(properties)) this.#known.add(key);
    const chosen = this.#names === undefined ? [id, properties.name] : [properties[this.#names], id];
    return String(chosen.find((value) => typeof value === 'string' || typeof value === 'number') ?? '');
  }

  /**
   * @param {Record<string, any>} properties
   * @returns {Paint}
   */
  #paint(properties) {
    const { fill = '#000', 'fill-opacity': opacity = 1 } = properties;
    const digits = typeof fill === 'string' ? COLOR.exec(fill)?.[1] : undefined;
    if (digits === undefined) this.#notes.leftOut(`fill ${line(fill)} (colours are #rgb or #rrggbb)`);
    if ('stroke' in properties) this.#notes.leftOut('stroke of a feature');
    const isOpacity = typeof opacity === 'number' && opacity >= 0 && opacity <= 1;
    if (!isOpacity) this.#notes.leftOut(`fill-opacity ${line(opacity)}`);
    return { ...plain().paint, color: colorOf(digits ?? '000'), opacity: isOpacity ? opacity : 1 };
  }
}

/**
 * @param {string} digits three or six
 * @returns {[number, number, number]}
 */
function colorOf(digits) {
  const step = digits.length / 3;
  const part = (/** @type {number} */ k) => parseInt(digits.slice(k * step, (k + 1) * step).repeat(3 - step), 16) / 255;
  return [part(0), part(1), part(2)];
}

/** @returns {{ paint: Paint, element: string }} */
function plain() {
  return { paint: { color: [0, 0, 0], opacity: 1, gradient: null }, element: '' };
}

/**
 * Path of an area in the units of the file, y down.
 *
 * @param {Area} area
 * @returns {Path}
 */
function pathOf({ rings, paint, element }) {
  return { contours: rings.map(contourOf), fillRule: EVENODD, paint, group: -1, element };
}

/** @param {Position[]} ring */
const contourOf = (ring) => sides(ring.flatMap(([x, y]) => [x, -y]), true);

/**
 * Name the reference system by the member `crs` that GeoJSON had before RFC 7946.
 *
 * @param {any} member
 */
function systemOf(member) {
  const name = member?.properties?.name;
  if (typeof name !== 'string' || !name || name.length > 200) return WORLD;
  const urn = URN.exec(name);
  return urn ? `${urn[1].toUpperCase()}:${urn[2]}` : name;
}

/** @param {unknown} error @returns {boolean} whether the stack is too small for values in one another; engines name it variously */
const isTooDeep = (error) => error instanceof RangeError || (error instanceof Error && error.name === 'InternalError');

/** @param {string} place @param {string} part */
const at = (place, part) => (place ? `${place}, ${part}` : part);

/** @param {unknown} value */
const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/**
 * @param {string} message
 * @returns {never}
 */
function refuse(message) {
  throw new VextureError(message, 'source');
}
