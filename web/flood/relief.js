/** Heights of the ground, and its intersection with rays. */

/** How high the relief stands in the world at first, from its deepest to its highest. */
const STANDING = 10;
const MOST_EXAGGERATION = 60;

/** Steps of a ray through the box. */
const MARCH = 400;
const HALVINGS = 20;

/** @typedef {{x: number, y: number, z: number}} Vector */

export class Relief {
  /**
   * @param {{columns: number, rows: number}} size
   * @param {Float32Array} heights metres above the water level, northernmost row first
   */
  constructor({ columns, rows }, heights) {
    this.columns = columns;
    this.rows = rows;
    this.heights = heights;
    this.lowest = heights.reduce((least, height) => Math.min(least, height), 0);
    this.highest = heights.reduce((most, height) => Math.max(most, height), 0);
  }

  /**
   * From the scene.
   *
   * @param {import('./page-data.js').ReliefFacts} facts
   * @param {ArrayBuffer} bytes
   */
  static read({ columns, rows, unit }, bytes) {
    if (bytes.byteLength !== columns * rows * 2) {
      const wanted = columns * rows * 2;
      throw new Error(`The relief has ${bytes.byteLength} bytes; ${columns} x ${rows} heights have ${wanted}.`);
    }
    const view = new DataView(bytes);
    const heights = Float32Array.from({ length: columns * rows }, (_, at) => view.getInt16(2 * at, true) * unit);
    return new Relief({ columns, rows }, heights);
  }

  /**
   * Metres above the water level at a place of the box; beyond it, as at its border.
   *
   * @param {number} s eastwards, 0..1
   * @param {number} t northwards, 0..1
   */
  at(s, t) {
    const x = Math.min(Math.max(s, 0), 1) * (this.columns - 1);
    const y = (1 - Math.min(Math.max(t, 0), 1)) * (this.rows - 1);
    const column = Math.min(Math.floor(x), this.columns - 2);
    const row = Math.min(Math.floor(y), this.rows - 2);
    const [right, down] = [x - column, y - row];
    const first = row * this.columns + column;
    const { heights, columns } = this;
    const upper = heights[first] * (1 - right) + heights[first + 1] * right;
    const lower = heights[first + columns] * (1 - right) + heights[first + columns + 1] * right;
    return upper * (1 - down) + lower * down;
  }

  /**
   * Vertical exaggeration at which the relief is visible from high above.
   *
   * @param {number} scale world units to a metre
   */
  exaggeration(scale) {
    const range = (this.highest - this.lowest) * scale;
    if (range === 0) return 1;
    return Math.min(Math.max(STANDING / range, 1), MOST_EXAGGERATION);
  }
}

/** The visible surface: the ground, and the water where the ground is below its level. */
export class Surface {
  /**
   * @param {Relief} relief
   * @param {import('./place.js').Places} places
   */
  constructor(relief, places) {
    this.relief = relief;
    this.places = places;
    this.exaggeration = relief.exaggeration(places.scale);
  }

  /** World units to a metre of height. */
  get rise() {
    return this.places.scale * this.exaggeration;
  }

  /** Height of the surface in the world. @param {number} x @param {number} z */
  height(x, z) {
    return Math.max(0, this.relief.at(...this.places.toBox(x, z))) * this.rise;
  }

  /**
   * Intersection of a ray with the surface, in the box's coordinates; null without one.
   *
   * @param {Vector} from
   * @param {Vector} along
   * @returns {[number, number] | null}
   */
  meets(from, along) {
    const { width, depth } = this.places;
    let [near, far] = [0, Infinity];
    for (const [start, step, half] of [[from.x, along.x, width / 2], [from.z, along.z, depth / 2]]) {
      if (step === 0 && Math.abs(start) > half) return null;
      const ends = step === 0 ? [0, Infinity] : [(-half - start) / step, (half - start) / step].sort((a, b) => a - b);
      [near, far] = [Math.max(near, ends[0]), Math.min(far, ends[1])];
    }
    if (along.y < 0) far = Math.min(far, -from.y / along.y + 1e-6); // no surface is lower than the water
    if (!(near < far) || far === Infinity) return null;
    const above = (/** @type {number} */ at) =>
      from.y + at * along.y - this.height(from.x + at * along.x, from.z + at * along.z);
    if (above(near) < 0) return null; // it enters through a side
    let before = near;
    for (let step = 1; step <= MARCH; step++) {
      let at = near + ((far - near) * step) / MARCH;
      if (above(at) > 0) {
        before = at;
        continue;
      }
      for (let half = 0; half < HALVINGS; half++) {
        const middle = (before + at) / 2;
        if (above(middle) > 0) before = middle;
        else at = middle;
      }
      return this.places.toBox(from.x + at * along.x, from.z + at * along.z);
    }
    return null;
  }
}
