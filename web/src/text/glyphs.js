// The glyphs of a page: a worker that sets texts, and the texture that holds the shapes of what they show.
import { VextureError, givenOptions, line, shortened, unfit } from '../errors.js';
import { loadMaps } from '../maps.js';
import { chooseFaces, facesOf } from './faces.js';
import { GrowingTexture } from './growing-texture.js';

/** @import { Added } from './growing-texture.js' */
/** @import { Face, FontSource } from './faces.js' */
/** @import { Outcome, Request, TextLayout } from './layout.js' */

/**
 * @typedef {object} GlyphsOptions Where glyphs are made, and how much memory they may take.
 * @property {import('../convert/kernel-modules.js').KernelSources} [kernels] addresses or contents of the modules
 *   `silhouettes`, `maps` and `strokes`; by default those of this package
 * @property {string | URL | BufferSource} [harfbuzz] address or content of `harfbuzz.wasm`, for pages; by default that beside the
 *   worker's script
 * @property {(() => Worker) | false} [worker] starts the worker, for pages with their own way to load one; false sets texts in
 *   this thread, in Node.js
 * @property {number} [budget] bytes of the texture above which glyphs that no text shows are forgotten; 32 MiB by default
 *
 * @typedef {object} GlyphUser What shows glyphs.
 * @property {() => Iterable<number>} shapesInUse indices of their shapes
 * @property {(places: ReadonlyMap<number, number>) => void} renumber shapes have got other indices; those without one are
 *   forgotten
 *
 * @typedef {object} Waiting A request that is not answered yet.
 * @property {(answer: any) => void} resolve
 * @property {(error: unknown) => void} reject
 *
 * @typedef {{ postMessage: (message: any) => void, terminate: () => void }} Endpoint
 */

const BUDGET = 32 * 2 ** 20;

/** Bytes of a texel. */
const TEXEL = 16;

/** Shapes above which glyphs are forgotten, too: a texture has room for a quarter more. */
const MANY = 12_288;

/** Time in ms after which a worker that did not start is tried again. */
const PATIENCE = 10_000;

/** Glyphs are forgotten if that leaves at most this share of them. */
const WORTHWHILE = 0.75;

const startWorker = () => new Worker(new URL('../typeset/worker.js', import.meta.url), { type: 'module', name: 'vexture-text' });

/** @type {Glyphs | null} */
let own = null;

/** One worker and one texture, for any number of texts in any fonts. */
export class Glyphs {
  #options;
  /** @type {Promise<Endpoint> | null} */
  #endpoint = null;
  /** @type {Map<number, Waiting>} */
  #waiting = new Map();
  #count = 0;
  /** @type {{ request: Request, waiting: Waiting }[]} */
  #queue = [];
  /** @type {Map<unknown, number>} ids of fonts by their address or content */
  #fonts = new Map();
  /** @type {Set<WeakRef<GlyphUser>>} */
  #users = new Set();
  /** Why the worker did not start, and when. @type {{ error: VextureError, time: number } | null} */
  #failure = null;
  /** Whether the worker has answered. */
  #isRunning = false;
  #isRestarting = false;
  /** Whether an answer had more shapes than there is room for: the worker counts others than the texture has. */
  #isFull = false;
  /** @type {Promise<void> | null} */
  #maps = null;
  #hasMaps = false;
  /** @type {Set<string>} */
  #characters = new Set();
  /** The texture with the shapes of all glyphs. @internal */
  texture = new GrowingTexture();

  /** @param {GlyphsOptions} [options] */
  constructor(options) {
    this.#options = givenOptions(options);
  }

  /** Where its worker and its kernels are. */
  get options() {
    return { ...this.#options };
  }

  /** Those of the page, which texts use unless they are given others. Others can be set, for the texts that are made after. */
  static get shared() {
    own ??= new Glyphs();
    return own;
  }

  static set shared(glyphs) {
    if (!(glyphs instanceof Glyphs)) throw unfit('glyphs', glyphs, 'give new Glyphs({ ... })');
    own = glyphs;
  }

  /**
   * Set a text. Those that are requested at once are answered at once.
   *
   * @internal
   * @param {Omit<Request, 'fonts'>} request
   * @param {{ font: FontSource | null, weight: number, isItalic: boolean }} wanted
   * @returns {Promise<TextLayout>}
   * @throws {VextureError} if it cannot be set
   */
  typeset(request, { font, weight, isItalic }) {
    return new Promise((resolve, reject) => {
      const faces = chooseFaces(facesOf(font), weight, isItalic); // throws, which rejects
      for (const character of request.text) this.#characters.add(character);
      const full = { ...request, fonts: faces.map((face) => this.#fontId(face)) };
      if (!this.#queue.length) queueMicrotask(() => this.#flush());
      this.#queue.push({ request: full, waiting: { resolve, reject } });
    });
  }

  /**
   * Load fonts, and make the shapes of characters, before a text shows them.
   *
   * @param {{ font?: FontSource | null, characters?: string }} [options] without characters the fonts are loaded only
   */
  async preload({ font = null, characters = '' } = {}) {
    const fonts = facesOf(font).map((face) => this.#fontId(face));
    const { results } = await this.#ask({ preload: { fonts, characters: characters || ' ' } });
    const failed = results.find((/** @type {any} */ result) => 'error' in result);
    if (failed) throw new VextureError(failed.error, failed.field);
  }

  /** Characters of all texts so far, for `bakeFont`. */
  get characters() {
    return [...this.#characters].sort().join('');
  }

  /** Let something be told when its shapes get other indices. @internal @param {GlyphUser} user @returns {() => void} ends it */
  follow(user) {
    const reference = new WeakRef(user);
    this.#users.add(reference);
    return () => this.#users.delete(reference);
  }

  /** End the worker, and free the GPU memory. Texts keep what they show; another text starts another worker. */
  dispose() {
    this.#fail(new VextureError('the glyphs were disposed of; give the text others', 'glyphs'));
    this.texture.dispose();
  }

  /** @param {Face} face */
  #fontId({ source, unicodeRange }) {
    const key = typeof source === 'string' ? `${source} ${unicodeRange ?? ''}` : source;
    let id = this.#fonts.get(key);
    if (id === undefined) {
      id = this.#fonts.size;
      this.#fonts.set(key, id);
      this.#send({ font: { id, source, unicodeRange } });
    }
    return id;
  }

  async #flush() {
    const queue = this.#queue;
    this.#queue = [];
    try {
      /** @type {{ results: Outcome[] }} */
      const { results } = await this.#ask({ texts: queue.map(({ request }) => request) });
      results.forEach((result, place) => {
        const { resolve, reject } = queue[place].waiting;
        if ('error' in result) reject(new VextureError(result.error, result.field));
        else resolve(result);
      });
    } catch (error) {
      for (const { waiting } of queue) waiting.reject(error);
    }
  }

  /** @param {Record<string, unknown>} message @returns {Promise<any>} */
  #ask(message) {
    return new Promise((resolve, reject) => {
      const id = this.#count++;
      this.#waiting.set(id, { resolve, reject });
      this.#send({ id, ...message });
    });
  }

  /** @param {Record<string, unknown>} message */
  async #send(message) {
    if (this.#failure && Date.now() - this.#failure.time < PATIENCE) {
      this.#fail(this.#failure.error);
      return;
    }
    try {
      this.#endpoint ??= this.#open();
      (await this.#endpoint).postMessage(message);
    } catch (error) {
      this.#fail(withoutWorker(line(error)), true);
    }
  }

  /** @returns {Promise<Endpoint>} */
  async #open() {
    const { kernels, harfbuzz, worker = startWorker } = this.#options;
    const receive = (/** @type {any} */ data) => this.#receiveInTurn(data);
    const hasWorkers = typeof Worker === 'function';
    this.#isRunning = false;
    const endpoint = worker && hasWorkers ? worker() : await openHere(receive);
    if (hasWorkers && endpoint instanceof Worker) {
      endpoint.onmessage = ({ data }) => receive(data);
      endpoint.onerror = (event) => {
        event.preventDefault?.();
        this.#fail(withoutWorker(event.message || 'it cannot be loaded'), true);
      };
    }
    endpoint.postMessage({ kernels: absolute(kernels), ...absolute({ harfbuzz }) });
    return endpoint;
  }

  /**
   * Receive an answer; from the first with glyphs in colours of their own on, when the module for planar maps is loaded.
   *
   * @param {{ id: number, added?: Added }} answer
   */
  #receiveInTurn(answer) {
    if (!this.#maps && answer.added?.shapes.some(({ isMap }) => isMap)) {
      this.#maps = loadMaps().then(() => {
        this.#hasMaps = true;
      });
    }
    if (this.#maps && !this.#hasMaps) this.#maps.then(() => this.#receive(answer), (error) => this.#receive({ ...answer, error }));
    else this.#receive(answer);
  }

  /** @param {{ id: number, added?: Added, error?: { message: string, field: string } }} answer */
  #receive({ id, added, error, ...answer }) {
    const waiting = this.#waiting.get(id);
    this.#isRunning = true;
    this.#waiting.delete(id);
    if (error) {
      waiting?.reject(new VextureError(error.message, error.field));
      return;
    }
    try {
      if ('restarted' in answer) this.#renumber(/** @type {Added} */ (added));
      else if (added) this.texture.append(added);
      waiting?.resolve(answer);
    } catch (problem) {
      this.#isFull = true;
      waiting?.reject(problem);
    }
    this.#forget();
  }

  /** Start again with the glyphs that are shown, if those of the past take too much memory. */
  async #forget() {
    const { budget = BUDGET } = this.#options;
    const isLarge = this.texture.length * TEXEL > budget || this.texture.roots.length > MANY;
    if (this.#isRestarting || !(isLarge || this.#isFull)) return;
    const living = new Set([...this.#present()].flatMap((user) => [...user.shapesInUse()]));
    const { roots } = this.texture;
    if (!this.#isFull && living.size > WORTHWHILE * roots.length) return;
    const shown = [...living].filter((shape) => shape < roots.length).sort((a, b) => a - b);
    this.#isRestarting = true;
    try {
      await this.#ask({ restart: { keys: shown.map((shape) => roots[shape].name) } });
      this.#isFull = false;
    } catch {
      // disposed of meanwhile, or the worker has failed: those who wait are told
    } finally {
      this.#isRestarting = false;
    }
  }

  /** @param {Added} added */
  #renumber(added) {
    const before = this.texture.roots;
    const places = new Map(added.shapes.map(({ key }, place) => [key, place]));
    const moved = new Map();
    before.forEach(({ name }, shape) => {
      const place = places.get(name);
      if (place !== undefined) moved.set(shape, place);
    });
    this.texture.restart(added);
    for (const user of this.#present()) user.renumber(moved);
  }

  /** @returns {Generator<GlyphUser>} */
  *#present() {
    for (const reference of this.#users) {
      const user = reference.deref();
      if (user) yield user;
      else this.#users.delete(reference);
    }
  }

  /** @param {VextureError} error @param {boolean} [isWorker] whether the worker has failed: one that never ran is not started in each frame */
  #fail(error, isWorker = false) {
    if (isWorker && !this.#isRunning) this.#failure = { error, time: Date.now() };
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    this.#endpoint?.then((endpoint) => endpoint.terminate(), () => {});
    this.#endpoint = null;
    this.#fonts.clear(); // another worker does not know them
    for (const { reject } of waiting) reject(error);
  }
}

/** @param {string} cause */
const withoutWorker = (cause) =>
  new VextureError(
    `the worker of texts does not run (${shortened(cause)}); check the site's files and its Content-Security-Policy ` +
      '(worker-src, wasm-unsafe-eval), or give Glyphs a `worker` of your own',
    'worker',
  );

/** A worker in this thread. @param {(data: any) => void} receive @returns {Promise<Endpoint>} */
async function openHere(receive) {
  const { Typesetter } = await import('#typesetter'); // in Node.js
  if (!Typesetter) throw new VextureError('a page sets no texts in its own thread; leave `worker` out, or give one that starts the worker', 'worker');
  const typesetter = new Typesetter();
  return {
    postMessage: async (message) => {
      const answer = await typesetter.answer(message);
      if (answer?.reply) receive(answer.reply);
    },
    terminate: () => {},
  };
}

/** A worker resolves addresses against its own. @param {Record<string, any> | undefined} sources */
function absolute(sources) {
  return sources && Object.fromEntries(
    Object.entries(sources).map(([name, source]) => {
      const isAddress = typeof source === 'string' || source instanceof URL;
      return [name, isAddress ? new URL(source, globalThis.document?.baseURI).href : source];
    }),
  );
}
