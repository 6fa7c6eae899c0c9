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
   * @param {string} url
   * @param {import('./base-loader.js').OnProgress} [onProgress]
   * @returns {Promise<FoldTexture>}
   */
  async loadAsync(url, onProgress) {
    const [bytes] = await this.fetchAll([url], FOLD_FILE_LIMIT, this.startRequest(onProgress));
    return FoldTexture.parse(bytes, shown(url));
  }
}
