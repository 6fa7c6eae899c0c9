// Sends single rows of a texture to the GPU.
import { DataTexture } from 'three';

/** A texture of words whose rows can change. */
export class RowTexture extends DataTexture {
  /** All rows that have changed since the beginning: of several renderers, one may have missed any of them. @type {Set<number>} */
  #changed = new Set();

  /**
   * Send rows to the GPU before the next frame. A three.js without ranges, before 0.177, sends the whole texture.
   *
   * @param {number} first
   * @param {number} end the row after the last one
   */
  sendRows(first, end) {
    for (let row = first; row < end; row++) this.#changed.add(row);
    const components = 4 * this.image.width;
    this.clearUpdateRanges?.();
    for (const row of this.#changed) this.addUpdateRange?.(components * row, components); // none may span two rows
    this.needsUpdate = true;
  }

  /**
   * A renderer that meets the texture, the first time or after its context was lost, listens and then needs all of it.
   *
   * @template {Extract<keyof import('three').TextureEventMap, string>} T
   * @param {T} type
   * @param {import('three').EventListener<import('three').TextureEventMap[T], T, this>} listener
   */
  addEventListener(type, listener) {
    super.addEventListener(type, listener);
    this.clearUpdateRanges?.();
  }
}
