/** The flat view of a texture: its layers on the theme's paper. */
import { Vector2, Vector3, Vector4 } from 'three';
import { planar } from '../generated/planar-shader.js';
import { overlay, packed } from '../generated/shaders.js';
import { Pass } from './pass.js';
import { shaderView } from './view.js';

/**
 * @typedef {import('./theme.js').Colors} Colors
 * @typedef {import('three').Texture} Texture
 * @typedef {import('three').WebGLRenderer} WebGLRenderer
 */

const FLAT = '#define VEXTURE_FLAT 1\n';

/** For each kind of drawing the shader's text, and what colours a pixel with a footprint. */
const DRAWN = Object.freeze({
  none: { text: packed, call: 'vextureLayers(first, count, FOOTPRINT)' },
  some: { text: planar, call: 'vextureSheets(first, count, FOOTPRINT)' },
  all: { text: planar, call: 'vextureWrappedColor(quad, FOOTPRINT)' },
});

/** @param {string} call */
const output = (call) => `
#define FOOTPRINT base, offset, vec2(side, 0.0), vec2(0.0, side)
uniform uvec2 base;
uniform vec2 start;
uniform float side;
uniform int first;
uniform int count;
uniform uint quad;
uniform bool silhouette;
uniform vec3 ink;
uniform vec4 paper;
out vec4 pixel;
void main() {
  vec2 offset = start + gl_FragCoord.xy * side;
  vec4 color = ${call};
  if (silhouette) color.rgb = ink * color.a;
  pixel = color + paper * (1.0 - color.a);
  #ifdef OVERLAY
    pixel = vextureOverlay(pixel, FOOTPRINT);
  #endif
}
`;

/** Two programs for each kind of drawing, with the same uniforms: the drawing, and the drawing below overlays. */
export class Flat {
  /** @type {Map<string, Pass>} */
  #passes = new Map();
  /** @type {import('./drawing.js').ShownDrawing['maps']} */
  #maps = 'none';
  #gradients = false;

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
      quad: { value: 0 },
      silhouette: { value: true },
      ink: { value: new Vector3() },
      paper: { value: new Vector4(1, 1, 1, 1) },
    });
  }

  /** The drawing's own program. */
  get plain() {
    return this.#pass(false);
  }

  /** The program with overlays. */
  get overlaid() {
    return this.#pass(true);
  }

  /** @param {boolean} isOverlaid */
  #pass(isOverlaid) {
    const { text, call } = DRAWN[this.#maps];
    const key = `${this.#maps} ${this.#gradients} ${isOverlaid}`;
    const chosen = `${FLAT}#define VEXTURE_GRADIENTS ${Number(this.#gradients)}\n`;
    const made = this.#passes.get(key)
      ?? (isOverlaid ? new Pass(chosen + text + overlay + output(call), this.uniforms, { OVERLAY: 1 })
        : new Pass(chosen + text + output(call), this.uniforms));
    this.#passes.set(key, made);
    return made;
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
    uniforms.quad.value = shown.texture.roots[shown.first].quad;
    this.#maps = shown.maps;
    this.#gradients = shown.gradients;
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
