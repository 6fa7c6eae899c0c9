// What a mask asks of glyphs. Those who show no text do not load it: `installGlyphShader` puts it here.

/** @import { Instances } from './glyph-shader.js' */

/**
 * @typedef {object} GlyphHooks
 * @property {(instances: Instances) => string} declared lines of a vertex shader outside of functions
 * @property {(instances: Instances) => string} placed lines that follow those that make `transformed` of the position
 * @property {(instanced: unknown) => Record<string, unknown>} uniforms values of the declared uniforms
 */

/** @type {GlyphHooks} */
export const glyphHooks = { declared: () => '', placed: () => '', uniforms: () => ({}) };
