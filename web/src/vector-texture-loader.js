import { PACKED_FILE_LIMIT, PACKED_SUFFIX } from '../generated/layout.js';
import { BaseLoader, nameOf } from './base-loader.js';
import { shown } from './fetching.js';
import { readPacked } from './packed.js';
import { VectorTexture } from './vector-texture.js';

/**
 * Loads vector textures from KTX2 files.
 *
 * @extends {BaseLoader<VectorTexture, string>}
 */
export class VectorTextureLoader extends BaseLoader {
  /**
   * Load a texture.
   *
   * @param {string} url
   * @param {import('./base-loader.js').OnProgress} [onProgress]
   * @returns {Promise<VectorTexture>}
   * @throws {VextureError} if there is no such file, it is damaged, or the server does not answer
   */
  async loadAsync(url, onProgress) {
    return new VectorTexture(await this.loadData(url, onProgress));
  }

  /**
   * Contents of a file, read and validated, without three.js objects.
   *
   * @param {string} url
   * @param {import('./base-loader.js').OnProgress} [onProgress]
   * @param {AbortSignal} [signal] stops this request only; `abort` stops all
   * @returns {Promise<import('./data.js').PackedData>}
   * @throws {VextureError} if there is no such file, it is damaged, or the server does not answer
   */
  async loadData(url, onProgress, signal) {
    const request = this.startRequest(onProgress, signal);
    const [bytes] = await this.fetchAll([url], PACKED_FILE_LIMIT, request);
    const data = await readPacked(bytes, shown(url));
    request.signal.throwIfAborted();
    return data.name === shown(url) ? { ...data, name: nameOf(url, [PACKED_SUFFIX]) } : data;
  }

  /**
   * A texture from a file's contents.
   *
   * @param {import('./base-loader.js').Bytes} contents
   * @param {string} [name] name for messages, and for the texture if the file has none
   * @returns {Promise<VectorTexture>}
   * @throws {VextureError} if the file is damaged
   */
  async parse(contents, name) {
    return new VectorTexture(await readPacked(contents, name));
  }
}
