// The colours of features by their ids: paints, a filter, steps of time. Each tile takes from it what it shows.
import { VextureError, line } from '../errors.js';
import { mapParts } from '../maps.js';
import { parts } from './css-color.js';

/**
 * @typedef {string | number | readonly number[] | null} FeaturePaint a colour of CSS, 0xrrggbb, or sRGB components and
 *   opacity, 0..1; null hides
 *
 * @typedef {Readonly<Record<string, FeaturePaint | undefined>> | ReadonlyMap<string, FeaturePaint | undefined>} FeaturePaints
 *   by the features' ids; undefined: as before they were given one
 *
 * @typedef {(id: string) => FeaturePaint | undefined} PaintFunction undefined: as it is in the tile
 *
 * @typedef {object} TimeTable The colours of features at each step of time.
 * @property {string[]} ids of the features
 * @property {FeaturePaint[][]} colors of each step, those of all features
 */

/** Colours come as numbers, so three.js is not needed to read them. */
const NO_COLORS = /** @type {any} */ ({ Color: class {} });

export class FeatureColors {
  /** Rises with every change. */
  version = 0;
  /** @type {Map<string, FeaturePaint>} */
  #paints = new Map();
  /** @type {PaintFunction | null} */
  #byFunction = null;
  /** @type {((id: string) => boolean) | null} */
  #isHidden = null;
  /** @type {{ places: Map<string, number>, steps: Float32Array[] } | null} */
  #times = null;
  #time = 0;

  /**
   * @param {FeaturePaints | PaintFunction | null} paints those of a table join those before, undefined takes one back; null: all
   *   as in the tiles
   */
  setPaint(paints) {
    if (typeof paints === 'function') this.#byFunction = paints;
    else if (paints === null) {
      this.#paints.clear();
      this.#byFunction = null;
    } else {
      const listed = paints instanceof Map ? [...paints] : Object.entries(paints);
      for (const [, paint] of listed) if (paint !== 'own' && paint !== undefined) parts(paint); // all or nothing
      for (const [id, paint] of listed) {
        if (paint === undefined) this.#paints.delete(id);
        else this.#paints.set(id, paint);
      }
    }
    this.version++;
  }

  /** @param {Iterable<string> | ((id: string) => boolean) | null} hidden ids, or whether one is hidden; null: none */
  setFilter(hidden) {
    if (hidden === null || typeof hidden === 'function') this.#isHidden = hidden;
    else {
      const ids = new Set(hidden);
      this.#isHidden = (id) => ids.has(id);
    }
    this.version++;
  }

  /** @param {TimeTable | null} table */
  setTimes(table) {
    this.#times = table && read(table);
    this.version++;
  }

  /** @param {number} time in steps; between two of them colours are mixed */
  setTime(time) {
    if (!Number.isFinite(time)) throw new VextureError(`the time is ${line(time)}; give the number of a step`, 'time');
    if (time === this.#time) return;
    this.#time = time;
    this.version++;
  }

  /** The time, in steps. */
  get time() {
    return this.#time;
  }

  /** @param {string} id */
  isHidden(id) {
    return this.#isHidden?.(id) ?? false;
  }

  /**
   * Colour the features of a tile, in its texels.
   *
   * @param {import('./client.js').LoadedTile} loaded
   * @returns {[number, number][]} runs of rows that have changed: the first, and that after the last
   */
  apply(loaded) {
    const { data } = loaded;
    if (!data || loaded.colors === this.version) return [];
    loaded.colors = this.version;
    /** @type {[number, number][]} */
    const rows = [];
    data.roots.forEach(({ style }, root) => {
      if (!style) return;
      const paints = new Map();
      for (const { name } of style.elements) if (name && !paints.has(name)) paints.set(name, this.paintOf(name));
      if (paints.size) rows.push(...mapParts().recolored(data, root, paints, NO_COLORS));
    });
    return rows;
  }

  /** The colour of a feature, or 'own'. @param {string} id */
  paintOf(id) {
    if (this.isHidden(id)) return null;
    const place = this.#times?.places.get(id);
    if (this.#times && place !== undefined) return mixed(this.#times.steps, this.#time, 4 * place);
    const paint = this.#paints.has(id) ? this.#paints.get(id) ?? null : this.#byFunction?.(id);
    if (paint === undefined) return 'own';
    return paint === 'own' ? paint : parts(paint);
  }
}

/** @param {TimeTable} table */
function read({ ids, colors }) {
  const wrong = colors.findIndex((step) => step.length !== ids.length);
  if (wrong >= 0 || !colors.length) {
    throw new VextureError(`step ${Math.max(wrong, 0)} has ${colors[wrong]?.length ?? 0} colours; give ${ids.length}, one for each id`, 'times');
  }
  return { places: new Map(ids.map((id, place) => [id, place])), steps: colors.map((step) => Float32Array.from(step.flatMap(parts))) };
}

/**
 * @param {Float32Array[]} steps
 * @param {number} time
 * @param {number} at place of the colour in each
 */
function mixed(steps, time, at) {
  const held = Math.min(Math.max(time, 0), steps.length - 1);
  const one = steps[Math.floor(held)];
  const other = steps[Math.ceil(held)];
  const share = held - Math.floor(held);
  return [0, 1, 2, 3].map((k) => one[at + k] + share * (other[at + k] - one[at + k]));
}
