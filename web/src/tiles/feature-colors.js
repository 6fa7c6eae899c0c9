// The colours of features by their ids: paints, a filter, steps of time. Each tile takes from it what it shows.
import { VextureError, line, shortened } from '../errors.js';
import { mapParts } from '../maps.js';
import { parts } from './css-color.js';

/**
 * @typedef {import('./css-color.js').Parts} Parts
 *
 * @typedef {string | number} FeatureId a number stands for its text
 *
 * @typedef {string | number | readonly number[] | null} FeaturePaint a colour of CSS, 0xrrggbb, or sRGB components and
 *   opacity, 0..1; null hides the feature
 *
 * @typedef {Readonly<Record<FeatureId, FeaturePaint | undefined>> | ReadonlyMap<FeatureId, FeaturePaint | undefined>} FeaturePaints
 *   by the features' ids; undefined removes an earlier paint
 *
 * @typedef {(id: string) => FeaturePaint | undefined} PaintFunction undefined keeps the colour of the tile
 *
 * @typedef {object} TimeTable The colours of features at each step of time.
 * @property {readonly FeatureId[]} ids of the features, without repeats
 * @property {readonly (readonly FeaturePaint[])[]} colors for each step, the colours of all features
 */

/** @type {Parts} */
const HIDDEN = [0, 0, 0, 0];

/** As it is in the tile. @type {Parts} */
const OWN = [NaN, NaN, NaN, NaN];

/**
 * The colour of a feature is that of the table of paints, if it has one; else that of the time; else that of the paint
 * function; else the tile's own. What the filter leaves out has none.
 */
export class FeatureColors {
  /** Rises with every change. */
  version = 0;
  /** Hears of each function of the page that throws, once. @type {(error: unknown) => void} */
  onError = console.error;
  /** @type {Map<string, Parts>} */
  #paints = new Map();
  /** @type {((id: string) => Parts) | null} */
  #byFunction = null;
  /** @type {((id: string) => boolean) | null} */
  #isShown = null;
  /** Functions that have thrown. @type {WeakSet<Function>} */
  #told = new WeakSet();
  /** @type {Times | null} */
  #times = null;
  #time = 0;

  /**
   * @param {FeaturePaints | PaintFunction | null} paints those of a table join those before, undefined takes one back; null: all
   *   as in the tiles
   * @throws {VextureError} if they are neither, or one is no colour: then nothing is changed
   */
  setPaint(paints) {
    if (typeof paints === 'function') this.#byFunction = (id) => partsOf(paints(id), id) ?? OWN;
    else if (paints === null) {
      this.#paints.clear();
      this.#byFunction = null;
    } else {
      const isTable = paints instanceof Map || (isObject(paints) && !(Symbol.iterator in paints));
      if (!isTable) throw new VextureError(`the paints are ${line(paints)}; give an object or a Map of ids and colours, a function, or null`, 'paints');
      /** @type {[FeatureId, FeaturePaint | undefined][]} */
      const listed = paints instanceof Map ? [...paints] : Object.entries(paints);
      const read = listed.map(([given, paint]) => [textOf(given, 'the paints'), partsOf(paint, String(given))]);
      for (const [id, paint] of /** @type {[string, Parts | undefined][]} */ (read)) {
        if (paint) this.#paints.set(id, paint);
        else this.#paints.delete(id);
      }
    }
    this.version++;
  }

  /**
   * @param {Iterable<FeatureId> | ((id: string) => boolean) | null} shown ids, or whether one is shown; null: all
   * @throws {VextureError} if it is none of these
   */
  setFilter(shown) {
    if (shown === null || typeof shown === 'function') this.#isShown = shown;
    else {
      if (!isObject(shown) || !(Symbol.iterator in shown)) {
        throw new VextureError(`the filter is ${line(shown)}; give a list of ids, a function, or null`, 'filter');
      }
      const ids = new Set([...shown].map((id) => textOf(id, 'the filter')));
      this.#isShown = (id) => ids.has(id);
    }
    this.version++;
  }

  /** @param {TimeTable | null} table */
  setTimes(table) {
    this.#times = table === null ? null : read(table);
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

  /**
   * What a function of the page says of a feature, or what else is taken where it throws: a frame goes on.
   *
   * @template Answer
   * @param {(id: string) => Answer} asked
   * @param {string} id
   * @param {string} what names the function
   * @param {Answer} otherwise
   */
  #answer(asked, id, what, otherwise) {
    try {
      return asked(id);
    } catch (error) {
      if (!this.#told.has(asked)) { // later: who hears of it may change the colours
        const said = `${what} throws for "${shortened(id)}" (${line(error)}); mend it; such features are drawn without it`;
        const told = error instanceof VextureError ? error : new VextureError(said, what, { cause: error });
        queueMicrotask(() => this.onError(told));
      }
      this.#told.add(asked);
      return otherwise;
    }
  }

  /** The colour of a feature that comes before that of the time. @param {string} id @returns {Parts | undefined} */
  #above(id) {
    if (this.#isShown && !this.#answer(this.#isShown, id, 'the filter', true)) return HIDDEN;
    return this.#paints.get(id);
  }

  /** The colour of a feature that no time gives one. @param {string} id @returns {Parts} */
  #below(id) {
    return this.#byFunction ? this.#answer(this.#byFunction, id, 'the paint function', OWN) : OWN;
  }

  /** Whether a feature has a colour now, so that it can be picked. @param {string} id */
  isSeen(id) {
    const paint = this.#above(id);
    const at = 4 * (this.#times?.places.get(id) ?? -1) + 3;
    if (paint || at < 0) return !((paint ?? this.#below(id))[3] <= 0);
    const [one, other, share] = this.#step();
    return one[at] > 0 || (share > 0 && other[at] > 0);
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
    const [one, other, share] = times ? this.#step() : [null, null, 0];
    for (let k = 0; k < names.length; k++) {
      const at = 4 * places[k];
      const paint = this.#above(names[k]);
      if (paint || !one || !other || at < 0) filled.set(paint ?? this.#below(names[k]), 4 * k);
      else for (let c = 0; c < 4; c++) filled[4 * k + c] = one[at + c] + share * (other[at + c] - one[at + c]);
    }
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

/** @param {unknown} value @returns {value is object} */
const isObject = (value) => typeof value === 'object' && value !== null;

/** @param {unknown} id @param {string} where */
function textOf(id, where) {
  if (typeof id === 'string' || Number.isFinite(id)) return String(id);
  throw new VextureError(`an id of ${where} is ${line(id)}; give a text or a number`, 'id');
}

/** @param {string} id @param {string} [when] */
const paintOf = (id, when = '') => `the paint of "${shortened(id)}"${when}`;

/** @param {FeaturePaint | undefined} paint @param {string} id @returns {Parts | undefined} */
const partsOf = (paint, id) => (paint === undefined ? paint : paint === 'own' ? OWN : parts(paint, () => paintOf(id)));

/** @param {TimeTable} table @returns {Times} */
function read(table) {
  const { ids, colors } = table ?? {};
  if (![ids, colors, ...(Array.isArray(colors) ? colors : [])].every(Array.isArray)) {
    throw new VextureError(`the times are ${line(table)}; give { ids, colors }, a list and one for each step, or null`, 'times');
  }
  const wrong = colors.findIndex((step) => step.length !== ids.length);
  if (wrong >= 0 || !colors.length) {
    throw new VextureError(`step ${Math.max(wrong, 0)} has ${colors[wrong]?.length ?? 0} colours; give ${ids.length}, one for each id`, 'times');
  }
  /** @type {Map<string, number>} */
  const places = new Map();
  ids.forEach((given, place) => {
    const id = textOf(given, 'the times');
    if (places.has(id)) throw new VextureError(`the times have the id "${shortened(id)}" twice; give it once`, 'times');
    places.set(id, place);
  });
  const steps = colors.map((step, number) => {
    const filled = new Float32Array(4 * ids.length);
    ids.forEach((id, place) => filled.set(parts(step[place], () => paintOf(String(id), ` in step ${number}`)), 4 * place));
    return filled;
  });
  return { places, steps };
}
