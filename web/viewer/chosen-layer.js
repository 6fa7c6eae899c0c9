/** The layer that the overlays show: the user's choice, or the topmost layer under the pointer. */
import { contains } from '../src/walk.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('../src/data.js').PackedData} PackedData
 */

/** Dispatches `change` when the layer changes. */
export class ChosenLayer extends EventTarget {
  #engine;
  /** @type {PackedData | null} */
  #data = null;
  #index = 0;
  #follows = true;

  /** @param {Engine} engine */
  constructor(engine) {
    super();
    this.#engine = engine;
    engine.addEventListener('shape', () => this.#reset());
    this.#reset();
  }

  /** Data of the texture; null while there is none. */
  get data() {
    return this.#data;
  }

  /** Which of the texture's roots. */
  get index() {
    return this.#index;
  }

  /** Whether it follows the pointer. */
  get follows() {
    return this.#follows;
  }

  get root() {
    return this.#data?.roots[this.#index] ?? null;
  }

  /** Numbers of the drawing's layers, the lowest first. */
  get layers() {
    const { drawing } = this.#engine;
    return drawing ? Array.from({ length: drawing.count }, (_, i) => drawing.first + i) : [];
  }

  /** @param {number | null} index null: follow the pointer */
  choose(index) {
    this.#follows = index === null;
    if (index !== null) this.#set(index);
  }

  /**
   * Follow the pointer to a point of the unit square; the layer stays where the drawing is empty.
   *
   * @param {number} u @param {number} v
   */
  point(u, v) {
    const data = this.#data;
    if (!this.#follows || !data) return;
    const top = this.layers.findLast((layer) => contains(data, data.roots[layer].quad, u, v));
    if (top !== undefined) this.#set(top);
  }

  #reset() {
    const data = this.#engine.drawing?.texture.data;
    this.#data = data ?? null;
    const { layers } = this;
    const stays = !this.#follows && layers.includes(this.#index);
    if (!stays) this.#index = layers.at(-1) ?? 0;
    this.#follows = !stays;
    this.dispatchEvent(new CustomEvent('change'));
  }

  /** @param {number} index */
  #set(index) {
    if (index === this.#index) return;
    this.#index = index;
    this.dispatchEvent(new CustomEvent('change'));
  }
}

/** @type {WeakMap<Engine, ChosenLayer>} */
const CHOSEN = new WeakMap();

/**
 * The instance shared by all parts of a page.
 *
 * @param {Engine} engine
 */
export function chosenLayer(engine) {
  const chosen = CHOSEN.get(engine) ?? new ChosenLayer(engine);
  CHOSEN.set(engine, chosen);
  return chosen;
}
