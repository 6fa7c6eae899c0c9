// Runs conversions: in one worker, one after another, or in this thread where there are no workers.
import { VextureError, line, shortened } from '../errors.js';
import { Conversion } from './conversion.js';
import { MAX_SECONDS } from './pace.js';
import { overtime } from './silhouette.js';
import { outlineStroke } from './stroke-outline.js';

/** @import { Converted, ConversionOptions } from './conversion.js' */
/** @import { Drawing } from './drawing.js' */

/**
 * @typedef {object} ConverterOptions Where a converter finds the kernels and its worker.
 * @property {import('./kernel-modules.js').KernelSources} [kernels] addresses or contents of the modules `silhouettes`, `maps` and
 *   `strokes`; by default those of this package
 * @property {(() => Worker) | false} [worker] starts the worker, for pages with their own way to load one; false converts in
 *   this thread
 *
 * @typedef {object} Job A drawing to convert.
 * @property {Drawing} drawing what `readSvg`, `readGeojson` or `fromContours` has made
 * @property {ConversionOptions} options of the conversion
 * @property {AbortSignal} [signal] stops it
 * @property {number} [spent] seconds of its time limit that reading has taken
 *
 * @typedef {object} Waiting A job that waits for the worker.
 * @property {Job} job
 * @property {(converted: Converted) => void} resolve
 * @property {(error: unknown) => void} reject
 *
 * @typedef {{ converted: Converted } | { message: string, field: string }} Answer What the worker sends.
 */

/** Longest delay of a timer, in ms; a longer one would end at once. */
const LONGEST_DELAY = 2 ** 31 - 1;

/**
 * @param {string} cause
 * @returns {VextureError} for a worker that does not run
 */
const withoutWorker = (cause) =>
  new VextureError(
    `the worker of conversions does not run (${shortened(cause)}); ${/Trusted/.test(cause)
      ? 'the page requires Trusted Types: give a `worker` that starts it by a policy of the page'
      : 'check the site\'s files and its Content-Security-Policy (worker-src)'}, or convert with \`worker: false\``,
    'worker',
  );

/** Start the package's own worker; bundlers recognise this form. */
const startWorker = () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'vexture' });

/** Converts drawings one after another. */
export class Converter {
  #kernels;
  #start;
  /** @type {Worker | null} */
  #worker = null;
  /** @type {Waiting[]} */
  #waiting = [];
  #busy = false;
  /** @type {Conversion} */
  #here;

  /** @param {ConverterOptions} [options] */
  constructor({ kernels, worker = startWorker } = {}) {
    this.#kernels = kernels;
    this.#here = new Conversion(kernels);
    this.#start = worker && typeof Worker === 'function' ? worker : null;
  }

  /**
   * Convert a drawing.
   *
   * @param {Job} job
   * @returns {Promise<Converted>}
   * @throws {VextureError} if it cannot be converted, or takes too long
   */
  convert(job) {
    job.signal?.throwIfAborted();
    if (!this.#start) return this.#convertHere(job);
    return new Promise((resolve, reject) => {
      const waiting = { job, resolve, reject };
      this.#waiting.push(waiting);
      job.signal?.addEventListener('abort', () => this.#drop(waiting), { once: true });
      this.#next();
    });
  }

  /**
   * The outlines of strokes, by the kernels in this thread: reading an SVG needs them at once.
   *
   * @returns {Promise<import('./strokes.js').StrokeOutline>}
   */
  async strokeOutline() {
    const kernels = await this.#here.modules.load('strokes');
    return (cubics, closed, style) => outlineStroke(kernels, cubics, closed, style);
  }

  /** Digest of the text of the kernels. */
  async digest() {
    return (await this.#here.modules.load('silhouettes')).digest;
  }

  /** End the worker; a later conversion starts another one. */
  dispose() {
    this.#worker?.terminate();
    this.#worker = null;
  }

  /** @param {Job} job */
  async #convertHere({ drawing, options, signal }) {
    const converted = await this.#here.convert(drawing, options);
    signal?.throwIfAborted();
    return converted;
  }

  /** Reject a job that is stopped before its turn. @param {Waiting} waiting */
  #drop(waiting) {
    const place = this.#waiting.indexOf(waiting);
    if (place < 0) return; // it runs, or has ended
    this.#waiting.splice(place, 1);
    waiting.reject(waiting.job.signal?.reason);
  }

  async #next() {
    if (this.#busy) return;
    const waiting = this.#waiting.shift();
    if (!waiting) return;
    this.#busy = true;
    try {
      waiting.resolve(await this.#convertInWorker(waiting.job));
    } catch (error) {
      waiting.reject(error);
    } finally {
      this.#busy = false;
      this.#next();
    }
  }

  /**
   * Convert in the worker, which is ended if the job is stopped or takes too long: a kernel does not listen.
   *
   * @param {Job} job
   * @returns {Promise<Converted>}
   */
  #convertInWorker({ drawing, options, signal, spent = 0 }) {
    signal?.throwIfAborted();
    const worker = (this.#worker ??= this.#begin());
    const { maxSeconds = MAX_SECONDS } = options;
    return new Promise((resolve, reject) => {
      const end = (/** @type {unknown} */ error) => {
        done();
        this.dispose();
        reject(error);
      };
      const timer = setTimeout(() => {
        end(overtime(drawing.name, { maxSeconds }));
      }, Math.min(1000 * Math.max((maxSeconds > 0 ? maxSeconds : MAX_SECONDS) - spent, 0), LONGEST_DELAY)); // the worker refuses a wrong number
      const onAbort = () => end(signal?.reason);
      const done = () => {
        clearTimeout(timer);
        signal?.removeEventListener('abort', onAbort);
        worker.onmessage = worker.onerror = worker.onmessageerror = null;
      };
      signal?.addEventListener('abort', onAbort);
      worker.onmessage = ({ data }) => {
        done();
        if ('converted' in data) resolve(data.converted);
        else reject(new VextureError(data.message, data.field));
      };
      worker.onerror = (event) => {
        event.preventDefault?.();
        end(withoutWorker(event.message || 'it cannot be loaded'));
      };
      worker.onmessageerror = () => end(new VextureError('the worker of conversions sent damaged data; try again', 'worker'));
      try {
        worker.postMessage({ drawing, options });
      } catch (error) {
        done();
        reject(new VextureError(`the drawing or an option cannot be sent to the worker (${line(error)}); give plain data`, 'source', { cause: error }));
      }
    });
  }

  /** @returns {Worker} @throws {VextureError} if the page may start none */
  #open() {
    try {
      return /** @type {() => Worker} */ (this.#start)();
    } catch (error) {
      throw withoutWorker(error instanceof Error ? error.message : String(error));
    }
  }

  #begin() {
    const worker = this.#open();
    const sources = Object.entries(this.#kernels ?? {}).map(([name, source]) => {
      const isAddress = typeof source === 'string' || source instanceof URL; // a worker resolves it against its own address
      return [name, isAddress ? new URL(source, globalThis.document?.baseURI).href : source];
    });
    worker.postMessage({ kernels: Object.fromEntries(sources) });
    return worker;
  }
}
