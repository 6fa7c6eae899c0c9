// What makes the program of one mask differ from that of another.
import { UV_ATTRIBUTES } from './attributes.js';
import { FOOTPRINT } from './mask-shader.js';
import { isOfGlyphs } from './mask-options.js';
import { gradientsAmong, mapsAmong, mapsOfGlyphs } from './select-root.js';

/** @typedef {import('./mask-shader.js').Variant} Variant */

/**
 * @param {import('./vector-texture.js').AnyVectorTexture} texture
 * @param {import('./mask-options.js').ShownOptions} options
 * @param {{ first: number, count: number }} range of the shape or the drawing's layers in the texture's roots
 * @returns {Variant}
 */
export function variantOf(texture, options, range) {
  const { mode, wrap, flat, invert, background, instanced, map, fold, linear, channel } = options;
  const reader = texture.maskReader();
  const isAlone = Boolean(instanced) || range.count === 1;
  const shown = instanced ? texture.roots : texture.roots.slice(range.first, range.first + range.count);
  const maps = isOfGlyphs(instanced) ? mapsOfGlyphs(mode) : mapsAmong(shown, isAlone);
  return {
    other: reader && { declared: reader.declared, coverage: reader.coverage(FOOTPRINT) },
    mode,
    inLayers: mode === 'paint',
    maps,
    gradients: gradientsAmong(shown),
    linear: linear && mode === 'paint' && maps !== 'none' && isAlone, // layers are composited in sRGB, as in browsers
    wrap,
    flat,
    invert,
    background,
    instanced: /** @type {any} */ (instanced), // labels are their kind in the key of a program
    hasMap: mode === 'mix' && map !== null,
    uv: UV_ATTRIBUTES[channel],
    fold: fold?.glsl ?? '',
  };
}
