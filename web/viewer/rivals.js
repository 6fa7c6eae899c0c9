/** Other representations of the same drawing, drawn for comparison; here a raster. */
import { LinearFilter, LinearMipmapLinearFilter, RGBAFormat, RedFormat, Vector2, Vector3, WebGLRenderTarget } from 'three';
import { BACKDROP } from './backdrop.js';
import { bytesText } from './numbers.js';
import { Pass } from './pass.js';
import { pixelSide, toUnit } from './view.js';

/**
 * @typedef {import('./backdrop.js').Backdrop} Backdrop
 * @typedef {import('three').WebGLRenderer} WebGLRenderer
 *
 * @typedef {object} Rival
 * @property {Pass} pass
 * @property {string} label
 * @property {import('./flat.js').Flat} [left] what stands left of the divider, where it is another texture
 * @property {string} [leftLabel] of that
 * @property {() => void} dispose
 */

/** Uniforms and output of every rival's shader. */
export const HEAD = `${BACKDROP}
uniform vec2 start;
uniform float side;
uniform vec3 tint;
out vec4 pixel;
`;

const RASTER = `
uniform sampler2D raster;
uniform bool silhouette;
void main() {
  vec2 uv = start + gl_FragCoord.xy * side;
  vec4 color = textureGrad(raster, uv, vec2(side, 0.0), vec2(0.0, side));
  color = silhouette ? vec4(tint, 1.0) * color.r : color;
  color *= uv == clamp(uv, 0.0, 1.0) ? 1.0 : 0.0;
  pixel = color + backdrop() * (1.0 - color.a);
}
`;

const MIPS = 4 / 3; // all levels of a texture to its largest

/**
 * The uniforms of `HEAD`, and a rival's own.
 *
 * @param {Backdrop} backdrop
 * @param {import('./drawing.js').ShownDrawing} drawing of one colour, or black
 * @param {Record<string, {value: any}>} own
 */
export function uniforms(backdrop, { texture, first, count }, own) {
  const tint = (count === 1 && texture.roots[first].paint?.color) || [0, 0, 0];
  return {
    ...backdrop.uniforms, start: { value: new Vector2() }, side: { value: 1 },
    tint: { value: new Vector3().fromArray(tint) }, ...own,
  };
}

/**
 * Set what all rivals need.
 *
 * @param {Rival} rival
 * @param {import('./view.js').View} view @param {import('./view.js').Size} size @param {number} ratio
 */
export function setRivalView(rival, view, size, ratio) {
  const { start, side } = rival.pass.uniforms;
  start.value.fromArray(toUnit(view, size, 0, size.height));
  side.value = pixelSide(view.zoom, size) / ratio;
}

/**
 * Nothing but the backdrop, below a picture that the browser draws.
 *
 * @param {Backdrop} backdrop
 * @param {import('./drawing.js').ShownDrawing} drawing
 * @returns {Rival}
 */
export function bareRival(backdrop, drawing) {
  const pass = new Pass(`${HEAD}void main() { pixel = backdrop(); }\n`, uniforms(backdrop, drawing, {}));
  return { pass, label: 'Browser SVG', dispose: () => pass.dispose() };
}

/**
 * Side of a square of pixels that takes, with its mip levels, so many bytes.
 *
 * @param {number} bytes
 * @param {number} texel bytes of a pixel
 */
function rasterSide(bytes, texel) {
  return Math.max(1, Math.floor(Math.sqrt(bytes / (texel * MIPS))));
}

/**
 * @param {WebGLRenderer} renderer
 * @param {import('./flat.js').Flat} flat ready, its drawing set
 * @param {import('./drawing.js').ShownDrawing} drawing
 * @param {number} most bytes of GPU memory
 * @returns {Rival}
 */
export function rasterRival(renderer, flat, drawing, most) {
  const silhouette = drawing.count === 1 && drawing.maps === 'none'; // a byte of coverage to a pixel is enough
  const side = Math.min(rasterSide(most, silhouette ? 1 : 4), renderer.capabilities.maxTextureSize);
  const target = new WebGLRenderTarget(side, side, {
    format: silhouette ? RedFormat : RGBAFormat, depthBuffer: false, generateMipmaps: true,
    minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter, // not anisotropic: in the flat view pixels are square
  });
  flat.drawSquare(renderer, target, silhouette);
  const pass = new Pass(HEAD + RASTER, uniforms(flat.backdrop, drawing, {
    raster: { value: target.texture }, silhouette: { value: silhouette },
  }));
  return {
    pass, label: `Raster, ${side} × ${side}: ${bytesText(most)}`, dispose: () => {
      pass.dispose();
      target.dispose();
    },
  };
}
