// The pace of long work in a page: it gives the page its turns, keeps to a time limit, and ends when it is stopped.
import { VextureError, line } from '../errors.js';

/**
 * Work in steps: it pauses where the page is due a turn, or where it waits for what it yields.
 *
 * @template Result
 * @typedef {Generator<Promise<void> | undefined, Result, undefined>} Steps
 */

/**
 * @typedef {object} PaceOptions Limits of reading a source.
 * @property {AbortSignal} [signal] stops it; it rejects with the signal's reason
 * @property {number} [maxSeconds] time limit; 60 by default
 */

/** Time limit without an option. */
export const MAX_SECONDS = 60;

/** Work between two turns of the page, in ms: short enough for a button to answer at once. */
const SLICE = 30;

/** The time limit is over, for all of a source rather than a part of it. */
export class OvertimeError extends VextureError {}

/** Runs steps, and adds up the time that they take. */
export class Pace {
  #signal;
  #maxSeconds;
  #spent = 0;
  #start = 0;

  /** @param {PaceOptions} [options] @throws {VextureError} if the time limit is none */
  constructor({ signal, maxSeconds = MAX_SECONDS } = {}) {
    checkSeconds(maxSeconds);
    this.#signal = signal;
    this.#maxSeconds = maxSeconds;
  }

  /** Seconds of work until the last turn. */
  get seconds() {
    return this.#spent / 1000;
  }

  /** @returns {boolean} whether the page is due a turn @throws {VextureError} if the time limit is over */
  isDue() {
    const slice = performance.now() - this.#start;
    if (this.#spent + slice > 1000 * this.#maxSeconds) throw overtime('reading', this.#maxSeconds);
    return slice > SLICE;
  }

  /**
   * Run work, which asks `isDue` when to pause.
   *
   * @template Result
   * @param {Steps<Result>} steps
   * @returns {Promise<Result>}
   */
  async run(steps) {
    this.#signal?.throwIfAborted();
    for (;;) {
      const { done, value } = this.#slice(steps);
      if (done) return /** @type {Result} */ (value);
      await (value ?? turn());
      this.#signal?.throwIfAborted();
    }
  }

  /** @template Result @param {Steps<Result>} steps */
  #slice(steps) {
    this.#start = performance.now();
    try {
      return steps.next();
    } finally {
      this.#spent += performance.now() - this.#start;
    }
  }
}

/**
 * Do all of some work at once, without turns; it must not wait for anything.
 *
 * @template Result
 * @param {Steps<Result>} steps
 * @returns {Result}
 */
export function atOnce(steps) {
  for (;;) {
    const { done, value } = steps.next();
    if (done) return /** @type {Result} */ (value);
  }
}

/**
 * The error for work that takes too long.
 *
 * @param {string} work such as "reading"
 * @param {number} maxSeconds
 */
export function overtime(work, maxSeconds) {
  return new OvertimeError(`${work} takes longer than ${maxSeconds} s; give a larger \`maxSeconds\`, or a simpler drawing`, 'maxSeconds');
}

/** @param {unknown} value @throws {VextureError} if it is no time limit */
export function checkSeconds(value) {
  if (typeof value === 'number' && value > 0) return; // texts compare like numbers, but are none
  throw new VextureError(`\`maxSeconds\` ${line(value)} is no number above 0; leave it out`, 'maxSeconds');
}

/** Give the page its turn: timers wait longer in a tab behind others, messages do not. @returns {Promise<void>} */
function turn() {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}
