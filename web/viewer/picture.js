/** A drawing as a PNG of any size, by the shader that draws it on the page. */
import { WebGLRenderTarget } from 'three';
import { pngOf } from './png.js';
import { FIT, shaderView } from './view.js';

/** Pixels that are drawn at once: a picture is drawn in bands, so that a large one takes little memory. */
const BAND = 1 << 20;

export const LEAST_SIDE = 16;

/**
 * @typedef {object} Part of the unit square
 * @property {import('./view.js').View} view
 * @property {import('./view.js').Size} size of what the view is seen in
 *
 * @typedef {import('./engine.js').Engine} Engine
 */

/** The largest side of a picture that the graphics processor draws. @param {Engine} engine */
export const mostSide = (engine) => engine.renderer.capabilities.maxTextureSize;

/**
 * A box of the unit square as a view: of the window of an SVG, or all of it.
 *
 * @param {readonly number[]} box left, bottom, right, top
 * @returns {Part}
 */
export function partOf([left, bottom, right, top]) {
  const size = { width: right - left, height: top - bottom };
  const side = 1 / Math.min(size.width, size.height);
  const shown = { width: size.width * side, height: size.height * side };
  return { view: { center: [(left + right) / 2, (bottom + top) / 2], zoom: side / FIT }, size: shown };
}

/**
 * Width and height of a picture of a part.
 *
 * @param {Part} part
 * @param {number} longer side, in pixels
 * @returns {[number, number]}
 */
export function sidesOf({ size: { width, height } }, longer) {
  const scale = longer / Math.max(width, height);
  return [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
}

/**
 * @param {Engine} engine
 * @param {Part} part
 * @param {number} longer side, in pixels
 * @returns {Promise<Blob>}
 * @throws {Error} with one line for the user
 */
export async function pictureFile(engine, part, longer) {
  const most = mostSide(engine);
  if (!Number.isInteger(longer) || longer < LEAST_SIDE || longer > most) {
    throw new Error(`a side of ${Number.isFinite(longer) ? longer.toLocaleString('en') : 'no'} pixels cannot be drawn here; `
      + `choose ${LEAST_SIDE} to ${most.toLocaleString('en')}`);
  }
  const [width, height] = sidesOf(part, longer);
  return pngOf(width, height, bands(engine, part, width, height));
}

/**
 * @param {Engine} engine
 * @param {Part} part
 * @param {number} width @param {number} height in pixels
 */
async function* bands(engine, { view, size }, width, height) {
  const { flat, renderer, drawing } = engine;
  const rows = Math.min(height, Math.max(1, Math.floor(BAND / width)));
  const target = new WebGLRenderTarget(width, rows, { depthBuffer: false });
  const row = 4 * width;
  const pixels = new Uint8Array(row * rows);
  const ratio = width / size.width;
  const { base, start, step } = shaderView(view, size, ratio);
  const low = start[1] - (step * (height - size.height * ratio)) / 2; // the height is a whole number of pixels
  try {
    for (let top = 0; top < height; top += rows) {
      if (engine.drawing !== drawing) throw new Error('another shape was opened meanwhile; save it again');
      const { uniforms } = flat;
      uniforms.base.value = base;
      uniforms.start.value.set(start[0], low + step * (height - top - rows));
      uniforms.side.value = step;
      uniforms.straight.value = true;
      flat.drawInto(renderer, target);
      uniforms.straight.value = false;
      await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, rows, pixels);
      const kept = Math.min(rows, height - top);
      const band = new Uint8Array(row * kept); // from the bottom up to from the top down
      for (let y = 0; y < kept; y++) band.set(pixels.subarray(row * (rows - 1 - y), row * (rows - y)), row * y);
      yield band;
    }
  } finally {
    target.dispose();
    engine.requestFrame();
  }
}
