// Values of a mask's uniforms.
import { Color } from 'three';
import { glyphHooks } from './glyph-hooks.js';

/** @typedef {import('./mask-options.js').AllOptions} Options */

/**
 * @param {import('./vector-texture.js').AnyVectorTexture} texture
 * @param {Options} options
 * @param {{ first: number, count: number }} range of the shape or the drawing's layers in the texture's roots
 * @param {Color} inside receives the colour inside, unless it is a `Color` itself
 * @returns {Record<string, unknown>} by the uniforms' names
 */
export function uniformValues(texture, { transform, threshold, color, map, fold, time, instanced }, { first, count }, inside) {
  const { roots, textures } = texture;
  return {
    vextureTexels: textures.texels ?? null,
    vexturePaints: textures.layers ?? null,
    ...texture.maskReader()?.uniforms,
    vextureRootQuad: roots[first]?.quad, // a texture of glyphs may have none yet
    vextureFirst: first,
    vextureCount: count,
    vextureTransform: transform,
    vextureThreshold: threshold,
    vextureInside: color instanceof Color ? color : inside.set(color),
    vextureInsideMap: map,
    vextureFolding: fold?.texture ?? null,
    vextureCycle: fold?.cycle ?? 0,
    ...glyphHooks.uniforms?.(instanced),
    vextureTime: fold?.clock(time) ?? 0,
  };
}

/**
 * Uniform with the transform of the inside map, read when a frame is drawn, as three.js reads those of its own maps.
 *
 * @param {() => Pick<Options, 'map' | 'transform'>} options
 */
export function mapTransform(options) {
  return {
    get value() {
      const { map, transform } = options();
      if (map?.matrixAutoUpdate) map.updateMatrix();
      return map?.matrix ?? transform;
    },
  };
}
