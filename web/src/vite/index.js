/**
 * A plugin of Vite: `import logo from './logo.svg?vexture'` is the address of the drawing's texture.
 *
 * @module
 */
import { createHash } from 'node:crypto';
import { access, mkdir, readFile, rename, rm, writeFile } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import path from 'node:path';
import { givenOptions } from '../errors.js';
import { findConverter, linesOf } from './converter.js';
import { optionsOf, parametersOf } from './options.js';
import { configOfWorkers } from './workers.js';

/**
 * @typedef {import('./options.js').ConvertOptions} ConvertOptions
 *
 * @typedef {object} ConverterOption Where the converter is.
 * @property {string | readonly string[] | false} [converter] the Python program with its leading arguments, such as
 *   `['uvx', 'vexture']`; false is this package itself. By default the program is searched, and this package takes its place
 *
 * @typedef {ConvertOptions & ConverterOption} VextureOptions options of the conversion of all drawings, and the converter
 */

/** @import { Converter } from './converter.js' */

const OURS = /\?(?:.*&)?vexture(?:[&=]|$)/;

/** Within Vite's root. */
const CACHE = 'node_modules/.cache/vexture';

/** Ending of a file beside a texture, with the warnings of its conversion: each build tells them. */
const NOTES = '.txt';

/** As Vite writes paths. @param {string} file */
const slashed = (file) => file.replaceAll('\\', '/');

/**
 * Vite plugin that converts drawings when they are imported with the query `?vexture`: by the Python program `vexture` if this
 * machine has it, or else by itself. It reuses a texture until the drawing, an option or the converter changes.
 *
 * @param {VextureOptions} [options]
 * @returns {import('vite').Plugin}
 */
export default function vexture(options) {
  const { converter, ...common } = givenOptions(options);
  parametersOf(common); // a wrong name is said when Vite starts
  let root = process.cwd();
  const converting = new Conversions(() => findConverter(root, converter));
  return {
    name: 'vexture',
    enforce: 'pre',
    config(user) {
      return configOfWorkers(user, this?.meta?.viteVersion); // Vite 6 tells nothing
    },
    configResolved(config) {
      root = config.root;
    },
    async load(id) {
      if (!OURS.test(id)) return null;
      const [file, query] = divided(id);
      this.addWatchFile(file);
      try {
        const all = { ...common, ...optionsOf(query) };
        parametersOf(all); // a wrong name is refused by either converter
        const { target, notes } = await converting.converted(file, all, path.join(root, CACHE));
        for (const note of notes) this.warn(`${slashed(path.relative(root, file))}: ${note}`);
        return { code: `export { default } from ${JSON.stringify(`${slashed(target)}?url&no-inline`)};`, moduleType: 'js' };
      } catch (error) {
        return this.error(`${slashed(path.relative(root, file))}: ${error instanceof Error ? error.message : error}`);
      }
    },
  };
}

/** @param {string} id @returns {[string, string]} file and query */
function divided(id) {
  const at = id.indexOf('?');
  return [id.slice(0, at), id.slice(at + 1)];
}

/** Conversions, each done once, and no more at a time than there are processors. */
class Conversions {
  #find;
  /** @type {Promise<Converter> | null} */
  #found = null;
  /** @type {Map<string, Promise<{ target: string, notes: string[] }>>} */
  #running = new Map();
  #free = availableParallelism();
  /** @type {(() => void)[]} */
  #waiting = [];

  /** @param {() => Promise<Converter>} find */
  constructor(find) {
    this.#find = find;
  }

  /**
   * @param {string} file
   * @param {ConvertOptions} options
   * @param {string} cache folder
   */
  async converted(file, options, cache) {
    const content = await readFile(file);
    this.#found ??= this.#find();
    const converter = await this.#found.catch((error) => {
      this.#found = null; // somebody may install one meanwhile
      throw error;
    });
    const name = path.parse(file).name;
    const identity = JSON.stringify([converter.version, parametersOf(options), name]);
    const key = createHash('sha256').update(identity).update(content).digest('hex').slice(0, 16);
    const target = path.join(cache, key, `${name.replace(/[^\w.-]/g, '_')}.ktx2`);
    const work = this.#running.get(target) ?? this.#convert(converter, file, options, target);
    this.#running.set(target, work);
    return work.finally(() => this.#running.delete(target));
  }

  /**
   * @param {Converter} converter
   * @param {string} file
   * @param {ConvertOptions} options
   * @param {string} target
   */
  async #convert(converter, file, options, target) {
    const kept = await readFile(`${target}${NOTES}`, 'utf8').catch(() => null); // written last
    if (kept !== null && (await access(target).then(() => true, () => false))) return { target, notes: linesOf(kept) };
    if (this.#free === 0) await new Promise((/** @type {(value?: unknown) => void} */ go) => this.#waiting.push(go));
    else this.#free--;
    const unfinished = path.join(path.dirname(target), `${process.pid}.ktx2`);
    try {
      await mkdir(path.dirname(target), { recursive: true });
      const notes = await converter.convert(file, options, unfinished);
      await rename(unfinished, target);
      await writeFile(`${target}${NOTES}`, notes.join('\n'));
      return { target, notes };
    } finally {
      await rm(unfinished, { force: true });
      const next = this.#waiting.shift();
      if (next) next();
      else this.#free++;
    }
  }
}
