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
   * @param {{invented?: boolean, still?: number}} [facts] still: metres of the still water above the zero of their source
   */
  constructor({ columns, rows }, heights, { invented = false, still = 0 } = {}) {
    this.invented = invented;
    this.still = still;
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
  static read({ columns, rows, unit, invented, still }, bytes) {
    if (bytes.byteLength !== columns * rows * 2) {
      const wanted = columns * rows * 2;
      throw new Error(`The relief has ${bytes.byteLength} bytes; ${columns} x ${rows} heights have ${wanted}.`);
    }
    const view = new DataView(bytes);
    const heights = Float32Array.from({ length: columns * rows }, (_, at) => view.getInt16(2 * at, true) * unit);
    return new Relief({ columns, rows }, heights, { invented, still });
  }

  /**
   * Metres above the water level at a place of the box; beyond it, as at its border.
   *
   * @param {number} s eastwards, 0..1
   * @param {number} t northwards, 0..1
   */
  at(s, t) {
    return this.of(this.heights, s, t);
  }

  /**
   * The same of other values on this grid.
   *
   * @param {Float32Array} values
   * @param {number} s @param {number} t
   */
  of(values, s, t) {
    const x = Math.min(Math.max(s, 0), 1) * (this.columns - 1);
    const y = (1 - Math.min(Math.max(t, 0), 1)) * (this.rows - 1);
    const column = Math.min(Math.floor(x), this.columns - 2);
    const row = Math.min(Math.floor(y), this.rows - 2);
    const [right, down] = [x - column, y - row];
    const first = row * this.columns + column;
    const { columns } = this;
    const upper = values[first] * (1 - right) + values[first + 1] * right;
    const lower = values[first + columns] * (1 - right) + values[first + columns + 1] * right;
    return upper * (1 - down) + lower * down;
  }

  /**
   * Vertical exaggeration at first: that at which invented heights are visible from high above.
   *
   * @param {number} scale world units to a metre
   */
  exaggeration(scale) {
    const range = (this.highest - this.lowest) * scale;
    if (range === 0 || !this.invented) return 1; // real heights are shown as they are
    return Math.min(Math.max(STANDING / range, 1), MOST_EXAGGERATION);
  }
}

/** The visible surface: the ground, and the water where the ground is below its level. */
export class Surface {
  /** Heights of the surface in metres above the still water, on the relief's grid. @type {Float32Array} */
  tops;
  /** Levels of the water, NaN where there is none; null: it is still everywhere. @type {Float32Array | null} */
  #levels = null;

  /**
   * @param {Relief} relief
   * @param {import('./place.js').Places} places
   */
  constructor(relief, places) {
    this.relief = relief;
    this.places = places;
    this.exaggeration = relief.exaggeration(places.scale);
    this.tops = this.#raised();
  }

  get levels() {
    return this.#levels;
  }

  set levels(/** @type {Float32Array | null} */ levels) {
    this.#levels = levels;
    this.tops = this.#raised();
  }

  /** The water stands on the ground, and is as high as it where it has no level. */
  #raised() {
    const { heights } = this.relief;
    const levels = this.#levels;
    if (!levels) return heights.map((height) => Math.max(height, 0));
    return heights.map((height, at) => (levels[at] > height ? levels[at] : height));
  }

  /**
   * Level of the water at a place of the box or, where there is none, of the nearest water; metres above the still water.
   *
   * @param {number} s @param {number} t
   */
  levelNear(s, t) {
    const { columns, rows } = this.relief;
    const levels = this.#levels;
    if (!levels) return 0;
    const column = Math.round(Math.min(Math.max(s, 0), 1) * (columns - 1));
    const row = Math.round((1 - Math.min(Math.max(t, 0), 1)) * (rows - 1));
    let [nearest, found] = [Infinity, 0];
    for (let at = 0; at < levels.length; at++) {
      if (Number.isNaN(levels[at])) continue;
      const away = (at % columns - column) ** 2 + (Math.floor(at / columns) - row) ** 2;
      if (away < nearest) [nearest, found] = [away, levels[at]];
    }
    return found;
  }

  /** The lowest and the highest top, in metres above the still water. */
  get range() {
    let [low, high] = [Infinity, -Infinity];
    for (const top of this.tops) [low, high] = [Math.min(low, top), Math.max(high, top)];
    return { low, high };
  }

  /** World units to a metre of height. */
  get rise() {
    return this.places.scale * this.exaggeration;
  }

  /** Height of the surface in the world. @param {number} x @param {number} z */
  height(x, z) {
    return this.relief.of(this.tops, ...this.places.toBox(x, z)) * this.rise;
  }

  /** Height of the ground in the world, under water too. @param {number} x @param {number} z */
  ground(x, z) {
    return this.relief.at(...this.places.toBox(x, z)) * this.rise;
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
    const lowest = this.range.low * this.rise;
    if (along.y < 0) far = Math.min(far, (lowest - from.y) / along.y + 1e-6); // no surface is lower
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
