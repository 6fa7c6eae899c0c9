// Requests in the order of their urgency: few at once, those that nobody wants any more aborted, failures tried again.

/**
 * @typedef {object} Task
 * @property {string} key
 * @property {AbortController} controller
 *
 * @typedef {object} QueueOptions
 * @property {number} [most] requests at once
 * @property {number} [retries] of a request that has failed
 * @property {number} [pause] milliseconds before the first retry, twice as long before each further one
 */

/**
 * What a request gives, which is tried again.
 *
 * @template Answer
 * @param {() => Promise<Answer>} load
 * @param {AbortSignal} signal
 * @param {number} [retries]
 * @param {number} [pause]
 * @param {(error: unknown) => boolean} [isPassing] whether it may be otherwise the next time
 */
export async function tried(load, signal, retries = 2, pause = 500, isPassing = () => true) {
  for (let attempt = 0; ; attempt++) {
    try {
      return await load();
    } catch (error) {
      if (signal.aborted || attempt >= retries || !isPassing(error)) throw error;
      await new Promise((resolve) => setTimeout(resolve, pause * 2 ** attempt));
      signal.throwIfAborted();
    }
  }
}

/** @template Item */
export class RequestQueue {
  #load;
  #done;
  #failed;
  #most;
  #retries;
  #pause;
  /** @type {{ key: string, item: Item }[]} */
  #wanted = [];
  /** @type {Map<string, AbortController>} */
  #running = new Map();

  /**
   * @param {(item: Item, signal: AbortSignal) => Promise<void>} load loads, and keeps what it has loaded
   * @param {() => void} done something has been loaded
   * @param {(item: Item, error: unknown) => void} failed after all retries
   * @param {QueueOptions} [options]
   */
  constructor(load, done, failed, { most = 8, retries, pause } = {}) {
    this.#load = load;
    this.#done = done;
    this.#failed = failed;
    this.#most = most;
    this.#retries = retries;
    this.#pause = pause;
  }

  /** How many requests are under way. */
  get running() {
    return this.#running.size;
  }

  /**
   * What is wanted now, the most urgent first; all else is aborted.
   *
   * @param {{ key: string, item: Item }[]} wanted
   */
  want(wanted) {
    this.#wanted = wanted.filter(({ key }) => !this.#running.has(key));
    const keys = new Set(wanted.map(({ key }) => key));
    for (const [key, controller] of this.#running) {
      if (keys.has(key)) continue;
      this.#running.delete(key);
      controller.abort();
    }
    this.#start();
  }

  #start() {
    while (this.#running.size < this.#most) {
      const next = this.#wanted.findIndex(({ key }) => !this.#running.has(key));
      if (next < 0) return;
      const [{ key, item }] = this.#wanted.splice(next, 1);
      this.#run(key, item);
    }
  }

  /**
   * @param {string} key
   * @param {Item} item
   */
  async #run(key, item) {
    const controller = new AbortController();
    const { signal } = controller;
    this.#running.set(key, controller);
    try {
      await tried(() => this.#load(item, signal), signal, this.#retries, this.#pause);
    } catch (error) {
      if (!signal.aborted) this.#failed(item, error);
    }
    if (signal.aborted) return; // its place has been given to another one
    this.#running.delete(key);
    this.#start();
    this.#done();
  }
}
