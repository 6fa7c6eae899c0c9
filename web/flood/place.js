// Conversions between four coordinate systems: the box (0..1 to the east and to the north), the unit square, the world
// of the scene (x east, y up, z south), and the source's reference system.

/** @typedef {import('./page-data.js').FrameFacts} FrameFacts */

/** Length of the longer side of the box in the world. */
export const SIDE = 100;

/** Decimals of degrees: a metre. */
const DECIMALS = 5;

export class Places {
  #frame;

  /** @param {FrameFacts} frame */
  constructor(frame) {
    this.#frame = frame;
    const [width, height] = frame.metres;
    /** World units to a metre. */
    this.scale = SIDE / Math.max(width, height);
    /** From west to east, in the world. */
    this.width = width * this.scale;
    /** From north to south, in the world. */
    this.depth = height * this.scale;
  }

  /** @param {number} s @param {number} t @returns {[number, number]} x and z */
  toWorld(s, t) {
    return [(s - 0.5) * this.width, (0.5 - t) * this.depth];
  }

  /** @param {number} x @param {number} z @returns {[number, number]} s and t */
  toBox(x, z) {
    return [x / this.width + 0.5, 0.5 - z / this.depth];
  }

  /** @param {number} s @param {number} t @returns {[number, number]} u and v */
  toUnit(s, t) {
    const [u0, v0, u1, v1] = this.#frame.box;
    return [u0 + s * (u1 - u0), v0 + t * (v1 - v0)];
  }

  /** @param {number} u @param {number} v @returns {[number, number]} s and t */
  fromUnit(u, v) {
    const [u0, v0, u1, v1] = this.#frame.box;
    return [(u - u0) / (u1 - u0), (v - v0) / (v1 - v0)];
  }

  /** @param {number} u @param {number} v @returns {[number, number]} in the reference system */
  toSource(u, v) {
    const [a, b, c, d, e, f] = this.#frame.to_source;
    return [a * u + b * v + c, d * u + e * v + f];
  }

  /**
   * Coordinates for people.
   *
   * @param {number} u @param {number} v
   */
  text(u, v) {
    const [x, y] = this.toSource(u, v);
    if (this.#frame.geographic) return `${degrees(y, 'N', 'S')}, ${degrees(x - 360 * Math.round(x / 360), 'E', 'W')}`;
    return `${whole(x)} E, ${whole(y)} N`;
  }

  /**
   * Longitude and latitude for people; null where they are unknown, or are the coordinates themselves.
   *
   * @param {number} s @param {number} t
   */
  geodetic(s, t) {
    const { geodetic } = this.#frame;
    if (!geodetic) return null;
    const { columns, rows, places } = geodetic;
    const [x, y] = [Math.min(Math.max(s, 0), 1) * (columns - 1), (1 - Math.min(Math.max(t, 0), 1)) * (rows - 1)];
    const [column, row] = [Math.min(Math.floor(x), columns - 2), Math.min(Math.floor(y), rows - 2)];
    const at = (/** @type {number} */ right, /** @type {number} */ down, /** @type {number} */ part) =>
      places[2 * ((row + down) * columns + column + right) + part];
    const [east, south] = [x - column, y - row];
    const [longitude, latitude] = [0, 1].map((part) =>
      (at(0, 0, part) * (1 - east) + at(1, 0, part) * east) * (1 - south)
      + (at(0, 1, part) * (1 - east) + at(1, 1, part) * east) * south);
    return `${degrees(latitude, 'N', 'S')}, ${degrees(longitude, 'E', 'W')}`;
  }

  /** The reference system's name. */
  get crs() {
    const { crs } = this.#frame;
    return crs.length <= 24 ? crs : /^\w+\["([^"]+)"/.exec(crs)?.[1] ?? 'own reference system';
  }
}

/** @param {number} value @param {string} above @param {string} below */
function degrees(value, above, below) {
  return `${Math.abs(value).toFixed(DECIMALS)}° ${value < 0 ? below : above}`;
}

/** @param {number} value */
const whole = (value) => Math.round(value).toLocaleString('en');
