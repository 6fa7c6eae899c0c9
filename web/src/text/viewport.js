// The size of what is drawn to, in pixels.
import { Matrix4, Vector4 } from 'three';
import { VIEWPORT } from '../glyph-shader.js';

const CORNERS = new Vector4();

const TO_CLIP = new Matrix4();

/** Slope in the picture below which a line counts as level or upright: over a glyph it is less than rounding. */
const LEVEL = 1e-5;

/**
 * Return whether all pixels are equal upright rectangles in the plane of an object, which cost less to draw.
 *
 * @param {import('three').Object3D} object
 * @param {import('three').Camera} camera
 */
export function isUpright({ matrixWorld }, { projectionMatrix, matrixWorldInverse }) {
  const { elements: e } = TO_CLIP.multiplyMatrices(projectionMatrix, matrixWorldInverse).multiply(matrixWorld);
  const reach = Math.max(Math.abs(e[0]), Math.abs(e[1]), Math.abs(e[4]), Math.abs(e[5]));
  const isSmall = (/** @type {number} */ part) => Math.abs(part) <= LEVEL * reach;
  const isLevel = (isSmall(e[1]) && isSmall(e[4])) || (isSmall(e[0]) && isSmall(e[5]));
  return isLevel && e[3] === 0 && e[7] === 0; // and it is not in perspective
}

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
