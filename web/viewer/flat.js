/** The flat view of a texture: its layers on the theme's paper. */
import { Vector2, Vector3, Vector4 } from 'three';
import { packed, packedOverlay } from '../generated/shaders.js';
import { Pass } from './pass.js';
import { shaderView } from './view.js';

/**
 * @typedef {import('./theme.js').Colors} Colors
 * @typedef {import('three').Texture} Texture
 * @typedef {import('three').WebGLRenderer} WebGLRenderer
 */

const FLAT = '#define VEXTURE_FLAT 1\n';

const OUTPUT = `
uniform uvec2 base;
uniform vec2 start;
uniform float side;
uniform int first;
uniform int count;
uniform bool silhouette;
uniform vec3 ink;
uniform vec4 paper;
out vec4 pixel;
void main() {
  vec2 offset = start + gl_FragCoord.xy * side;
  vec4 color = vextureLayers(first, count, base, offset, vec2(side, 0.0), vec2(0.0, side));
  if (silhouette) color.rgb = ink * color.a;
  pixel = color + paper * (1.0 - color.a);
  #ifdef OVERLAY
    pixel = vextureOverlay(pixel, base, offset, vec2(side, 0.0), vec2(0.0, side));
  #endif
}
`;

/** Two programs with the same uniforms: the drawing, and the drawing below overlays. */
export class Flat {
  /** @param {Record<string, {value: any}>} overlays uniforms of overlay.glsl, set by the module `overlays` */
  constructor(overlays) {
    const nothing = /** @type {Texture | undefined} */ (undefined);
    this.uniforms = Object.assign(overlays, {
      vextureTexels: { value: nothing },
      vexturePaints: { value: nothing },
      base: { value: [0, 0] },
      start: { value: new Vector2() },
      side: { value: 1 },
      first: { value: 0 },
      count: { value: 1 },
      silhouette: { value: true },
      ink: { value: new Vector3() },
      paper: { value: new Vector4(1, 1, 1, 1) },
    });
    this.plain = new Pass(FLAT + packed + OUTPUT, this.uniforms);
    this.overlaid = new Pass(FLAT + packedOverlay + OUTPUT, this.uniforms, { OVERLAY: 1 });
  }

  /**
   * @param {import('./drawing.js').ShownDrawing} shown
   * @param {Colors} colors
   */
  setDrawing(shown, colors) {
    const { uniforms } = this;
    uniforms.vextureTexels.value = shown.texture.textures.texels;
    uniforms.vexturePaints.value = shown.texture.textures.layers;
    uniforms.first.value = shown.first;
    uniforms.count.value = shown.count;
    uniforms.silhouette.value = shown.silhouette;
    uniforms.ink.value.fromArray(colors.ink);
    uniforms.paper.value.set(...colors.paper, 1);
  }

  /**
   * @param {import('./view.js').View} view
   * @param {import('./view.js').Size} size
   * @param {number} ratio device pixels of a CSS pixel
   */
  setView(view, size, ratio) {
    const { base, start, step } = shaderView(view, size, ratio);
    this.uniforms.base.value = base;
    this.uniforms.start.value.fromArray(start);
    this.uniforms.side.value = step;
  }

  /**
   * Draw the unit square into an image of n x n pixels, premultiplied.
   *
   * @param {WebGLRenderer} renderer
   * @param {import('three').WebGLRenderTarget} target
   * @param {boolean} asSilhouette in white instead of its colours
   */
  drawSquare(renderer, target, asSilhouette) {
    const { base, start, side, ink, paper, silhouette } = this.uniforms;
    const before = { ink: ink.value, paper: paper.value, silhouette: silhouette.value };
    silhouette.value = asSilhouette;
    base.value = [0, 0];
    start.value.set(0, 0);
    side.value = 1 / target.width;
    ink.value = new Vector3(1, 1, 1);
    paper.value = new Vector4(0, 0, 0, 0);
    renderer.setRenderTarget(target);
    this.plain.draw(renderer);
    renderer.setRenderTarget(null);
    ink.value = before.ink;
    paper.value = before.paper;
    silhouette.value = before.silhouette;
  }
}
