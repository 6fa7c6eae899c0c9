/** Steps of the flood: those embedded in the page, or those of a server, whose list may grow. */
import { listen } from '../src/event-stream.js';
import { LiveVectorTexture } from '../src/live-vector-texture.js';
import { readPacked } from '../src/packed.js';
import { backOff } from '../src/patience.js';
import { VectorTexture } from '../src/vector-texture.js';
import { bytesOf } from '../viewer/library.js';
import { Depths, Ranks } from './depths.js';

/**
 * @typedef {import('./page-data.js').Manifest} Manifest
 *
 * @typedef {object} Step
 * @property {string} name
 * @property {VectorTexture} texture
 * @property {Manifest} manifest of the data in place
 * @property {string} base what its addresses are relative to
 */

/**
 * The picture of levels of a step and the facts to read it; null if it has none.
 *
 * @param {Step} step
 */
export async function levelsOf({ manifest, base }) {
  const [url, facts] = [manifest.views?.level, manifest.facts?.level];
  return url && facts ? { png: new Uint8Array(await bytesOf(url, base)), facts } : null;
}

/**
 * The picture of the hazard of a step and the facts to read it; null if its speeds are not known.
 *
 * @param {Step} step
 */
export async function hazardOf({ manifest, base }) {
  const [url, facts] = [manifest.views?.hazard, manifest.facts?.hazard];
  return url && facts ? { png: new Uint8Array(await bytesOf(url, base)), facts } : null;
}

/**
 * Depths of a step, or classes of them; null if it has neither.
 *
 * @param {Step} step
 */
export async function depthsOf({ manifest, base }) {
  const { views, facts } = manifest;
  const bytes = async (/** @type {string} */ url) => new Uint8Array(await bytesOf(url, base));
  if (views?.depth && facts?.depth) return new Depths(await bytes(views.depth), facts.depth);
  return views?.ranks && facts?.ranges ? new Ranks(await bytes(views.ranks), facts.ranges) : null;
}

/** @type {WeakMap<Manifest, Promise<VectorTexture | null>>} */
const maps = new WeakMap();

/**
 * The planar map of the classes of depth of a step, loaded once; null if it has none.
 *
 * @param {Step} step
 */
export function classesOf({ name, manifest, base }) {
  const load = async (/** @type {string} */ url) => new VectorTexture(await readPacked(await bytesOf(url, base), name));
  const found = maps.get(manifest) ?? (manifest.views?.classes ? load(manifest.views.classes) : Promise.resolve(null));
  maps.set(manifest, found);
  return found;
}

/** Names are sorted by the numbers in them. The prefix alone is the name of the newest step. */
const IN_ORDER = new Intl.Collator('en', { numeric: true });

/**
 * Whether a shape is a step.
 *
 * @param {string} name @param {string} prefix
 */
export const isStep = (name, prefix) => name === prefix || name.startsWith(`${prefix}/`);

/**
 * Steps among the shapes of a server, in their order.
 *
 * @param {Iterable<string>} names @param {string} prefix
 */
export function stepsAmong(names, prefix) {
  const newest = (/** @type {string} */ name) => Number(name === prefix);
  return [...new Set(names)].filter((name) => isStep(name, prefix))
    .sort((one, other) => newest(one) - newest(other) || IN_ORDER.compare(one, other));
}

/** Dispatches `names` when the list changes, and `changed` when the water of a step that is loaded does. */
export class Steps extends EventTarget {
  /** @type {Map<string, Manifest>} */
  #embedded = new Map();
  /** @type {Map<string, Promise<Step>>} */
  #opened = new Map();
  #prefix;
  #server;

  /** @param {import('./page-data.js').Scene} scene */
  constructor({ server, flood }) {
    super();
    this.#prefix = flood.prefix;
    this.#server = server ? new URL(server, document.baseURI).href : null;
    /** @type {string[]} */
    this.names = flood.steps.map((step) => (typeof step === 'string' ? step : step.name));
    for (const step of flood.steps) if (typeof step !== 'string') this.#embedded.set(step.name, step);
  }

  /** Listen for added and removed steps. */
  follow() {
    if (this.#server) this.#listen(this.#server);
  }

  /** @param {string} server */
  #listen(server, failures = 0) {
    let failed = failures;
    const leave = listen(new URL('events', server), false, {
      opened: (wasOpen) => {
        failed = 0;
        if (wasOpen) this.#ask(server).catch(() => {}); // the shown step reports the lost connection
      },
      heard: (kind, data) => {
        if (kind === 'hello') this.#setNames(Object.keys(data.versions));
        else if (kind === 'shape') this.#setNames([...this.names, data.name]);
        else if (kind === 'gone') this.#setNames(this.names.filter((name) => name !== data.name));
      },
      failed: () => {
        leave();
        setTimeout(() => this.#listen(server, failed + 1), backOff(failed + 1));
      },
    });
  }

  /** @param {string} server */
  async #ask(server) {
    this.#setNames(JSON.parse(new TextDecoder().decode(await bytesOf('shapes', server))).shapes);
  }

  /** @param {string[]} names */
  #setNames(names) {
    const wanted = stepsAmong(names, this.#prefix);
    if (wanted.length === 0 || wanted.join('\n') === this.names.join('\n')) return; // the last step stays
    for (const name of this.names) if (!wanted.includes(name)) this.#close(name);
    this.names = wanted;
    this.dispatchEvent(new Event('names'));
  }

  /** @param {string} name */
  #close(name) {
    this.#opened.get(name)?.then(({ texture }) => texture instanceof LiveVectorTexture && texture.close(), () => {});
    this.#opened.delete(name);
  }

  /**
   * Load a step; the same object as long as the step exists.
   *
   * @param {string} name
   * @returns {Promise<Step>}
   */
  open(name) {
    const known = this.#opened.get(name);
    if (known) return known;
    const opening = this.#load(name);
    this.#opened.set(name, opening);
    opening.catch(() => this.#opened.get(name) === opening && this.#opened.delete(name)); // so that it is tried again
    return opening;
  }

  /** @param {string} name @returns {Promise<Step>} */
  async #load(name) {
    const manifest = this.#embedded.get(name);
    if (manifest) {
      const base = document.baseURI;
      const texture = new VectorTexture(await readPacked(await bytesOf(manifest.texture, base), name));
      return { name, texture, manifest, base };
    }
    if (!this.#server) throw new Error(`There is no step ${name}.`);
    const base = new URL(`shapes/${encodeURIComponent(name)}`, this.#server).href;
    const texture = await LiveVectorTexture.connect(base);
    texture.addEventListener('change', () => this.dispatchEvent(new Event('changed')));
    const current = () => /** @type {Manifest} */ (/** @type {unknown} */ (texture.manifest));
    return { name, texture, base, get manifest() { return current(); } };
  }
}

/**
 * Label of a step's time.
 *
 * @param {Manifest | undefined} manifest
 * @param {string} name
 */
export function labelOf(manifest, name) {
  const { label, time } = manifest?.facts ?? {};
  if (label) return label;
  return time ? time.replace('T', ' ').replace(/:00(\.0+)?(Z|$)/, '$2').replace('Z', ' UTC') : name;
}
