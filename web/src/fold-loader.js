import { FOLD_FILE_LIMIT } from '../generated/fold-layout.js';
import { BaseLoader } from './base-loader.js';
import { shown } from './fetching.js';
import { FoldTexture } from './fold-texture.js';

/**
 * Loads folds, which `vexture fold` makes.
 *
 * @extends {BaseLoader<FoldTexture, string>}
 */
export class FoldLoader extends BaseLoader {
  /**
   * Load a fold.
   *
   * @param {string} url
   * @param {import('./base-loader.js').OnProgress} [onProgress]
   * @returns {Promise<FoldTexture>}
   * @throws {VextureError} if there is no such file, it is damaged, or the server does not answer
   */
  async loadAsync(url, onProgress) {
    const [bytes] = await this.fetchAll([url], FOLD_FILE_LIMIT, this.startRequest(onProgress));
    return FoldTexture.parse(bytes, shown(url));
  }
}
