// Libraries that most texts do without, each loaded when a text first needs it.
import { VextureError, line } from '../errors.js';

/** @typedef {{ load(): Promise<void> }} Loadable something that a text needs first: a font, or a library */

/**
 * @template T
 * @implements {Loadable}
 */
class Library {
  /** @type {T | null} */
  #content = null;
  #name;
  #read;

  /** @param {string} name @param {() => Promise<T>} read */
  constructor(name, read) {
    this.#name = name;
    this.#read = read;
  }

  get isLoaded() {
    return this.#content !== null;
  }

  /** What it exports, once it is loaded. @returns {T} */
  get content() {
    return /** @type {T} */ (this.#content);
  }

  /** @throws {VextureError} if it cannot be loaded */
  async load() {
    try {
      this.#content = await this.#read();
    } catch (error) {
      const message = `the module ${this.#name} cannot be loaded (${line(error)}); check the network and the site's files`;
      throw new VextureError(message, 'worker', { cause: error });
    }
  }
}

/** Directions of text (UAX 9). */
export const bidi = new Library('bidi-js', async () => (await import('bidi-js')).default());

/** Breaks of lines (UAX 14). */
export const lineBreaker = new Library('linebreak', async () => {
  // @ts-expect-error: the package has no types
  const module = await import('linebreak');
  return /** @type {new (text: string) => { nextBreak(): { position: number } | null }} */ (module.default);
});
