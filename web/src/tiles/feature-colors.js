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

export class FeatureColors {
  /** Rises with every change. */
  version = 0;
  /** @type {Map<string, FeaturePaint>} */
  #paints = new Map();
  /** @type {PaintFunction | null} */
  #byFunction = null;
  /** @type {((id: string) => boolean) | null} */
  #isShown = null;
  /** @type {Times | null} */
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

  /** @param {Iterable<string> | ((id: string) => boolean) | null} shown ids, or whether one is shown; null: all */
  setFilter(shown) {
    if (shown === null || typeof shown === 'function') this.#isShown = shown;
    else {
      const ids = new Set(shown);
      this.#isShown = (id) => ids.has(id);
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
  #isHidden(id) {
    return !(this.#isShown?.(id) ?? true);
  }

  /** Whether a feature has a colour now, so that it can be picked. @param {string} id */
  isSeen(id) {
    const place = this.#times?.places.get(id) ?? -1;
    if (!this.#times || place < 0 || this.#isHidden(id)) return this.paintOf(id) !== null;
    const [one, other, share] = this.#step();
    return one[4 * place + 3] > 0 || (share > 0 && other[4 * place + 3] > 0);
  }

  /** The steps of times before and after the time, and how far it is from one to the other. @returns {[Float32Array, Float32Array, number]} */
  #step() {
    const steps = /** @type {Times} */ (this.#times).steps;
    const held = Math.min(Math.max(this.#time, 0), steps.length - 1);
    return [steps[Math.floor(held)], steps[Math.ceil(held)], held - Math.floor(held)];
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
    return data.roots.flatMap(({ style }, root) => {
      const named = style ? namedOf(style.elements) : null;
      if (!named?.names.length) return [];
      this.#fill(named);
      return mapParts().recolored(data, root, named);
    });
  }

  /** No array for each feature: all of them may change in every frame. @param {Named} named */
  #fill(named) {
    const { names, parts: filled, places } = named;
    const times = this.#times;
    if (named.times !== times) {
      named.times = times;
      names.forEach((name, k) => (places[k] = times?.places.get(name) ?? -1));
    }
    const [one, other, share] = times?.steps.length ? this.#step() : [null, null, 0];
    for (let k = 0; k < names.length; k++) {
      const at = 4 * places[k];
      if (!one || !other || at < 0 || this.#isHidden(names[k])) write(this.paintOf(names[k]), filled, 4 * k);
      else for (let c = 0; c < 4; c++) filled[4 * k + c] = one[at + c] + share * (other[at + c] - one[at + c]);
    }
  }

  /** The colour of a feature that no time gives one, or 'own'. @param {string} id */
  paintOf(id) {
    if (this.#isHidden(id)) return null;
    const paint = this.#paints.has(id) ? this.#paints.get(id) : this.#byFunction?.(id);
    return paint === undefined ? 'own' : paint;
  }
}

/**
 * @typedef {object} Named The features of a tile, each once, and what they are given.
 * @property {string[]} names
 * @property {Float64Array} parts four for each
 * @property {Int32Array} places of the features in a table of times, or -1
 * @property {Times | null} times that table
 *
 * @typedef {{ places: Map<string, number>, steps: Float32Array[] }} Times
 */

/** @type {WeakMap<readonly object[], Named>} */
const NAMED = new WeakMap();

/** @param {import('../style.js').Style['elements']} elements @returns {Named} */
function namedOf(elements) {
  const known = NAMED.get(elements);
  if (known) return known;
  const names = [...new Set(elements.flatMap(({ name }) => name || []))];
  const made = { names, parts: new Float64Array(4 * names.length), places: new Int32Array(names.length).fill(-1), times: null };
  NAMED.set(elements, made);
  return made;
}

/**
 * @param {FeaturePaint | 'own'} paint
 * @param {Float64Array} filled
 * @param {number} at
 */
function write(paint, filled, at) {
  if (paint === 'own') filled.fill(NaN, at, at + 4);
  else filled.set(parts(paint), at);
}

/** @param {TimeTable} table @returns {Times} */
function read({ ids, colors }) {
  const wrong = colors.findIndex((step) => step.length !== ids.length);
  if (wrong >= 0 || !colors.length) {
    throw new VextureError(`step ${Math.max(wrong, 0)} has ${colors[wrong]?.length ?? 0} colours; give ${ids.length}, one for each id`, 'times');
  }
  const steps = colors.map((step) => {
    const filled = new Float32Array(4 * ids.length);
    step.forEach((paint, place) => filled.set(parts(paint), 4 * place));
    return filled;
  });
  return { places: new Map(ids.map((id, place) => [id, place])), steps };
}
