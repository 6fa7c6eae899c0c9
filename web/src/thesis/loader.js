import { CURVES_SUFFIX, FILE_LIMIT, QUADS_SUFFIX } from '../../generated/thesis-layout.js';
import { BaseLoader, divided, nameOf } from '../base-loader.js';
import { VextureError, line } from '../errors.js';
import { readThesis } from './read.js';
import { ThesisTexture } from './texture.js';

/**
 * @typedef {string | [string, string]} PairUrl the common stem of both files, either file, or both
 * @typedef {import('../base-loader.js').Bytes} Bytes
 * @typedef {import('../base-loader.js').OnProgress} OnProgress
 */

const SUFFIXES = [QUADS_SUFFIX, CURVES_SUFFIX];

/**
 * The two addresses of a pair.
 *
 * @param {PairUrl} url
 * @returns {string[]}
 */
function pairOf(url) {
  if (typeof url !== 'string' || !url.trim()) return Array.isArray(url) ? url : [url]; // fetchAll says what is wrong
  const { path, rest } = divided(url);
  const suffix = SUFFIXES.find((one) => path.endsWith(one)) ?? '';
  const stem = path.slice(0, path.length - suffix.length);
  return SUFFIXES.map((one) => stem + one + rest);
}

/**
 * Loads thesis textures from pairs of files, `NAME.quads.png` and `NAME.curves.png`.
 *
 * @extends {BaseLoader<ThesisTexture, PairUrl>}
 */
export class ThesisLoader extends BaseLoader {
  /**
   * Load a texture.
   *
   * @param {PairUrl} url
   * @param {OnProgress} [onProgress]
   * @returns {Promise<ThesisTexture>}
   * @throws {VextureError} if there is no such pair, one is damaged, or the server does not answer
   */
  async loadAsync(url, onProgress) {
    return new ThesisTexture(await this.loadData(url, onProgress));
  }

  /**
   * Contents of both files, read and validated, without three.js objects.
   *
   * @param {PairUrl} url
   * @param {OnProgress} [onProgress]
   * @param {AbortSignal} [signal] stops this request only; `abort` stops all
   * @returns {Promise<import('./read.js').ThesisData>}
   */
  async loadData(url, onProgress, signal) {
    const request = this.startRequest(onProgress, signal);
    const urls = pairOf(url);
    const [quads, curves] = await this.fetchAll(urls, FILE_LIMIT, request);
    const data = await readThesis(quads, curves, nameOf(urls[0], SUFFIXES));
    request.signal.throwIfAborted();
    return data;
  }

  /**
   * A texture from the contents of both files.
   *
   * @param {[Bytes, Bytes]} contents
   * @param {string} [name] name for messages, and of the texture
   * @returns {Promise<ThesisTexture>}
   */
  async parse(contents, name) {
    if (!Array.isArray(contents)) {
      throw new VextureError(`contents are ${line(contents)}; give the bytes of both files, [quads, curves]`, 'contents');
    }
    const [quads, curves] = contents;
    return new ThesisTexture(await readThesis(quads, curves, name));
  }
}
