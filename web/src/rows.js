// Sends single rows of a texture to the GPU.

/** @typedef {import('three').DataTexture} DataTexture */

/** All rows of a texture that have changed since the beginning: of several renderers, one may have missed any of them. */
const CHANGED = /** @type {WeakMap<DataTexture, Set<number>>} */ (new WeakMap());

/**
 * Make ready a texture of which rows will be sent. A renderer that meets it, the first time or after its context was lost,
 * listens to it and then needs all of it.
 *
 * @param {DataTexture} texture
 */
export function prepareRows(texture) {
  const listen = texture.addEventListener;
  texture.addEventListener = function addEventListener(...event) {
    /** @type {Function} */ (listen).apply(texture, event);
    texture.clearUpdateRanges?.();
  };
  CHANGED.set(texture, new Set());
}

/**
 * Send rows to the GPU before the next frame. A three.js without ranges, before 0.177, sends the whole texture.
 *
 * @param {DataTexture} texture
 * @param {number} first
 * @param {number} end the row after the last one
 */
export function sendRows(texture, first, end) {
  const changed = /** @type {Set<number>} */ (CHANGED.get(texture));
  for (let row = first; row < end; row++) changed.add(row);
  const components = 4 * texture.image.width;
  texture.clearUpdateRanges?.();
  for (const row of changed) texture.addUpdateRange?.(components * row, components); // none may span two rows
  texture.needsUpdate = true;
}
