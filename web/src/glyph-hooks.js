// What a mask asks of glyphs. Those who show no text do not load it: `installGlyphShader` puts it here.

/** @import { Instances } from './glyph-shader.js' */

/**
 * @typedef {object} GlyphHooks Each gives nothing for instances that are no glyphs.
 * @property {(instances: Instances) => string} declared lines of a vertex shader outside of functions
 * @property {(instances: Instances) => { vertexNormal?: string, vertexPlace?: string }} placed lines that follow those that make
 *   `objectNormal` of the normal, and `transformed` of the position
 * @property {(instances: Instances) => { declared: string, used: string }} tint lines of a fragment shader for the colour of a
 *   label
 * @property {(instanced: any) => Record<string, unknown>} uniforms values of the declared uniforms
 * @property {(instanced: any) => { position: any, uv: any, tint: any } | null} nodes what these are in node materials
 */

/** Empty until a text is made. */
export const glyphHooks = /** @type {Partial<GlyphHooks>} */ ({});
