/** Other representations of the same drawing, drawn for comparison; here a raster. */
import { LinearFilter, LinearMipmapLinearFilter, RGBAFormat, RedFormat, Vector2, Vector3, Vector4, WebGLRenderTarget } from 'three';
import { Pass } from './pass.js';
import { pixelSide, toUnit } from './view.js';

/**
 * @typedef {import('./theme.js').Colors} Colors
 * @typedef {import('three').WebGLRenderer} WebGLRenderer
 *
 * @typedef {object} Rival
 * @property {Pass} pass
 * @property {string} label
 * @property {readonly number[] | null} tint colour of what has but one, where it is not the theme's ink
 * @property {() => void} dispose
 */

/** Uniforms and output of every rival's shader. */
export const HEAD = `
uniform vec2 start;
uniform float side;
uniform vec3 ink;
uniform vec4 paper;
out vec4 pixel;
`;

const RASTER = `
uniform sampler2D raster;
uniform bool silhouette;
void main() {
  vec2 uv = start + gl_FragCoord.xy * side;
  vec4 color = textureGrad(raster, uv, vec2(side, 0.0), vec2(0.0, side));
  color = silhouette ? vec4(ink, 1.0) * color.r : color;
  color *= uv == clamp(uv, 0.0, 1.0) ? 1.0 : 0.0;
  pixel = color + paper * (1.0 - color.a);
}
`;

const MIPS = 4 / 3; // all levels of a texture to its largest

/** The uniforms of `HEAD`, and a rival's own. @param {Record<string, {value: any}>} own */
export function uniforms(own) {
  return {
    start: { value: new Vector2() }, side: { value: 1 }, ink: { value: new Vector3() }, paper: { value: new Vector4() },
    ...own,
  };
}

/**
 * Set what all rivals need.
 *
 * @param {Rival} rival
 * @param {import('./view.js').View} view @param {import('./view.js').Size} size @param {number} ratio
 * @param {Colors} colors
 */
export function setRivalView(rival, view, size, ratio, colors) {
  const { start, side, ink, paper } = rival.pass.uniforms;
  start.value.fromArray(toUnit(view, size, 0, size.height));
  side.value = pixelSide(view.zoom, size) / ratio;
  ink.value.fromArray(rival.tint ?? colors.ink);
  paper.value.set(...colors.paper, 1);
}

/** Colour of a drawing of one painted layer; null for others. @param {import('./drawing.js').ShownDrawing} drawing */
export function tintOf({ texture, first, count, silhouette }) {
  return count === 1 && !silhouette ? (texture.roots[first].paint?.color ?? null) : null;
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
 * @returns {Rival}
 */
export function rasterRival(renderer, flat, drawing) {
  const { texture } = drawing;
  const silhouette = drawing.count === 1 && drawing.maps === 'none'; // a byte of coverage to a pixel is enough
  const side = Math.min(rasterSide(texture.nbytes, silhouette ? 1 : 4), renderer.capabilities.maxTextureSize);
  const target = new WebGLRenderTarget(side, side, {
    format: silhouette ? RedFormat : RGBAFormat, depthBuffer: false, generateMipmaps: true,
    minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter, // not anisotropic: in the flat view pixels are square
  });
  flat.drawSquare(renderer, target, silhouette);
  const pass = new Pass(HEAD + RASTER, uniforms({
    raster: { value: target.texture }, silhouette: { value: silhouette },
  }));
  return {
    pass, tint: tintOf(drawing), label: `Raster, ${side} × ${side}`, dispose: () => {
      pass.dispose();
      target.dispose();
    },
  };
}
