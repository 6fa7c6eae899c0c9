// The size of what is drawn to, in pixels.
import { Vector4 } from 'three';
import { VIEWPORT } from '../glyph-shader.js';

const CORNERS = new Vector4();

/**
 * Keep the size of what a renderer draws to now, for the shaders of glyphs. Nodes ask three.js themselves.
 *
 * @param {any} renderer
 */
export function readViewport(renderer) {
  if (renderer.isWebGLRenderer) {
    renderer.getCurrentViewport(CORNERS);
    VIEWPORT.set(CORNERS.z, CORNERS.w);
  } else renderer.getDrawingBufferSize(VIEWPORT);
}
