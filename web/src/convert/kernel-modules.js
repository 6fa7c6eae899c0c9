// The modules of kernels, of which each is loaded when a conversion first needs it.
import { VextureError, givenOptions, line } from '../errors.js';
import { Kernels } from './kernels.js';

/** @typedef {string | URL | BufferSource} KernelSource address or content of a module of kernels */

/** @typedef {'silhouettes' | 'maps' | 'strokes'} ModuleName name of a module of kernels */

/** @typedef {Partial<Record<ModuleName, KernelSource>>} KernelSources addresses or contents of the modules */

/** The modules of this package; bundlers recognise this form. A bundle without modules has no address, and is given them. */
const OWN = {
  silhouettes: () => new URL('../../kernels/silhouettes.wasm', import.meta.url),
  maps: () => new URL('../../kernels/maps.wasm', import.meta.url),
  strokes: () => new URL('../../kernels/strokes.wasm', import.meta.url),
};

/** Loads modules, each once. */
export class KernelModules {
  #sources;
  /** @type {Map<ModuleName, Promise<Kernels>>} */
  #loading = new Map();

  /** @param {KernelSources} [sources] by default those of this package @throws {VextureError} if there is no such module */
  constructor(sources) {
    this.#sources = givenOptions(sources, 'kernels');
    const wrong = Object.keys(this.#sources).find((name) => !(name in OWN));
    if (wrong !== undefined) throw new VextureError(`\`kernels\` have no ${line(wrong)}; there are ${Object.keys(OWN).join(', ')}`, 'kernels');
  }

  /**
   * Load a module.
   *
   * @param {ModuleName} name
   * @returns {Promise<Kernels>}
   * @throws {VextureError} if it cannot be fetched or compiled
   */
  load(name) {
    let loading = this.#loading.get(name);
    if (!loading) {
      loading = Kernels.load(this.#sources[name] ?? OWN[name]());
      this.#loading.set(name, loading);
      loading.catch(() => this.#loading.delete(name)); // the network may be back the next time
    }
    return loading;
  }
}
