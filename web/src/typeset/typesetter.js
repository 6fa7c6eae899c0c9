// Sets texts: requests in, places of glyphs and new shapes out.
import { VextureError, line } from '../errors.js';
import { KernelModules } from '../convert/kernel-modules.js';
import { TypeFont } from './font.js';
import { layOut } from './layout.js';
import { linesOf } from './lines.js';
import { primaryFont } from './runs.js';
import { Shapes, modulesOf, partsOfKey } from './shapes.js';
import { Style } from './style.js';

/** @import { KernelSources, ModuleName } from '../convert/kernel-modules.js' */
/** @import { Loadable } from './libraries.js' */
/** @import { Result } from './layout.js' */
/** @import { Added, Kind } from './shapes.js' */
/** @import { Request } from './style.js' */

/**
 * @typedef {{ error: string, field: string }} Refusal
 *
 * @typedef {object} Message
 * @property {KernelSources} [kernels]
 * @property {{ id: number, source: string | ArrayBuffer, unicodeRange?: string }} [font]
 * @property {number} [id]
 * @property {Request[]} [texts]
 * @property {{ fonts: number[], characters: string }} [preload]
 * @property {{ keys: string[] }} [restart]
 *
 * @typedef {object} Reply
 * @property {number} id
 * @property {(Result | Refusal)[]} [results]
 * @property {true} [restarted]
 * @property {Added} [added]
 * @property {{ message: string, field: string }} [error]
 */

/** Sets the texts of a page with its fonts. */
export class Typesetter {
  #modules;
  #shapes = new Shapes();
  /** @type {Map<number, TypeFont>} */
  #fonts = new Map();
  /** Errors of fonts that were named, by their ids. @type {Map<number, unknown>} */
  #wrong = new Map();

  /** @param {{ kernels?: KernelSources }} [options] */
  constructor({ kernels } = {}) {
    this.#modules = new KernelModules(kernels);
  }

  /**
   * Add a font; its file is not read before a text needs it.
   *
   * @param {number} id
   * @param {string | ArrayBuffer} source
   * @param {string} [unicodeRange]
   */
  addFont(id, source, unicodeRange) {
    this.#fonts.set(id, new TypeFont(id, source, unicodeRange));
  }

  /**
   * Answer a message.
   *
   * @param {Message} message
   * @returns {Promise<{ reply: Reply, transfer: Transferable[] } | null>} null for messages without an id
   */
  async answer(message) {
    const { id, font } = message;
    try {
      if (font) this.addFont(font.id, font.source, font.unicodeRange);
    } catch (error) {
      this.#wrong.set(/** @type {{ id: number }} */ (font).id, error);
    }
    if (id === undefined) {
      if (!font && 'kernels' in message) this.#modules = new KernelModules(message.kernels);
      return null;
    }
    try {
      await this.#load(['silhouettes']);
      if (message.restart) {
        const parts = await this.#loadKeys(message.restart.keys);
        this.#renumber(parts);
        return this.#reply({ id, restarted: true });
      }
      const requests = message.preload ? [requestOf(message.preload)] : message.texts;
      if (!Array.isArray(requests)) throw new VextureError(`\`texts\` is ${line(requests)}; give a list of requests`, 'texts');
      for (;;) {
        const { results, needed, wanted } = this.#attempt(requests);
        if (!needed.length && !wanted.length) return this.#reply({ id, results: message.preload ? results.filter((one) => 'error' in one) : results });
        await Promise.all([...needed.map((one) => one.load()), this.#load(wanted)]);
      }
    } catch (error) {
      return { reply: { id, error: errorOf(error) }, transfer: [] };
    }
  }

  /**
   * A reply with what was added. It is made in the same step as its results: another message may be answered in the next.
   *
   * @param {Omit<Reply, 'added'>} reply
   */
  #reply(reply) {
    const added = this.#shapes.take();
    /** @type {Transferable[]} */
    const transfer = [added.words.buffer];
    for (const result of reply.results ?? []) {
      if (!('shapes' in result)) continue;
      const { clusters, carets } = result, drawn = [result, result.outlines, result.strokes].filter((one) => one !== undefined);
      transfer.push(clusters.buffer, carets.buffer, ...drawn.flatMap(({ shapes, places }) => [shapes.buffer, places.buffer]));
    }
    return { reply: { ...reply, added }, transfer };
  }

  /** @param {Iterable<ModuleName>} names */
  async #load(names) {
    await Promise.all(
      Array.from(names, async (name) => {
        if (name === 'maps') this.#shapes.colors ??= await import('./color-glyphs.js');
        this.#shapes.kernels[name] ??= await this.#modules.load(name);
      }),
    );
  }

  /**
   * Set texts as far as fonts and modules are loaded.
   *
   * @param {Request[]} requests
   */
  #attempt(requests) {
    const { wanted } = this.#shapes;
    /** @type {Set<Loadable>} */
    const needed = new Set();
    wanted.clear();
    const results = requests.map((request) => this.#set(request, needed));
    return { results: /** @type {(Result | Refusal)[]} */ (results), needed: [...needed], wanted: [...wanted] };
  }

  /**
   * Load what shapes need; the others, such as those of fonts that fail, are left out.
   *
   * @param {unknown} keys
   */
  async #loadKeys(keys) {
    if (!Array.isArray(keys)) throw new VextureError(`\`keys\` is ${line(keys)}; give a list of keys of shapes`, 'keys');
    const wanted = keys.map(partsOfKey).filter((parts) => parts !== null);
    await Promise.all(Array.from(new Set(wanted.map(({ font }) => font)), (font) => this.#fonts.get(font)?.load()));
    const found = wanted.flatMap(({ font, ...parts }) => {
      const owner = this.#fonts.get(font);
      return owner?.isLoaded ? [{ ...parts, owner }] : [];
    });
    await this.#load(new Set(found.flatMap(({ owner, glyph, kind }) => modulesOf(owner, glyph, kind))));
    return found;
  }

  /**
   * Number shapes from 0 again, beginning with some.
   *
   * @param {{ owner: TypeFont, variation: string, glyph: number, kind: Kind }[]} parts
   */
  #renumber(parts) {
    this.#shapes.clear();
    for (const font of this.#fonts.values()) font.forget();
    for (const { owner, variation, glyph, kind } of parts) this.#shapes.restore(owner.instance(variation), glyph, kind);
  }

  /**
   * @param {Request} request
   * @param {Set<Loadable>} needed what to load first is added
   * @returns {Result | Refusal | null} null if something is needed
   */
  #set(request, needed) {
    try {
      for (const id of Array.isArray(request?.fonts) ? request.fonts : []) if (this.#wrong.has(id)) throw this.#wrong.get(id);
      const style = new Style(request, this.#fonts);
      /** @type {Set<number>} */
      const missing = new Set();
      const { text } = request;
      /** @type {Set<Loadable>} */
      const own = new Set(), primary = primaryFont(style.fonts);
      const lines = linesOf(text, style, own, missing);
      if (!own.size && !primary.isLoaded) own.add(primary); // the metrics of blank texts
      own.forEach((one) => needed.add(one));
      if (own.size) return null;
      const failed = style.fonts.filter(({ error }) => error);
      const result = layOut(text, lines, style, this.#shapes);
      const used = new Set(lines.flatMap(({ pieces }) => pieces.map(({ shaped }) => shaped.instance.owner)));
      const notes = new Set(failed.map(({ error }) => /** @type {VextureError} */ (error).message));
      for (const font of used) for (const note of font.notes) notes.add(note);
      return { ...result, missing: [...missing], notes: [...notes] };
    } catch (error) {
      const { message, field } = errorOf(error);
      return { error: message, field };
    }
  }
}

/** @param {{ fonts: number[], characters: string }} preload @returns {Request} */
const requestOf = ({ characters, ...style }) => ({ ...style, text: characters, inks: [[0, '000000']] });

/** @param {unknown} error */
function errorOf(error) {
  if (error instanceof VextureError) return { message: error.message, field: error.field };
  return { message: `the text cannot be set (${line(error)}); please report it`, field: 'text' };
}
