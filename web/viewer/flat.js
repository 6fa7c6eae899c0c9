/** The flat view of a texture: its layers on the backdrop, in their own colours. */
import { Vector2, Vector4 } from 'three';
import { planar } from '../generated/planar-shader.js';
import { overlay, packed } from '../generated/shaders.js';
import { BACKDROP } from './backdrop.js';
import { Pass } from './pass.js';
import { shaderView } from './view.js';

/**
 * @typedef {import('./backdrop.js').Backdrop} Backdrop
 * @typedef {import('three').Texture} Texture
 * @typedef {import('three').WebGLRenderer} WebGLRenderer
 */

const FLAT = '#define VEXTURE_FLAT 1\n';

/** For each kind of drawing the shader's text, and what colours a pixel with a footprint. */
const DRAWN = Object.freeze({
  none: { text: packed, call: 'vextureLayers(first, count, FOOTPRINT)' },
  some: { text: packed + planar, call: 'vextureSheets(first, count, FOOTPRINT)' },
  all: { text: packed + planar, call: 'vextureWrappedColor(quad, FOOTPRINT)' },
});

/** @param {string} call */
const output = (call) => `${BACKDROP}
#define FOOTPRINT base, offset, vec2(side, 0.0), vec2(0.0, side)
uniform uvec2 base;
uniform vec2 start;
uniform float side;
uniform int first;
uniform int count;
uniform uint quad;
uniform bool tinted;
uniform vec4 tint;
uniform bool straight;
out vec4 pixel;
void main() {
  vec2 offset = start + gl_FragCoord.xy * side;
  vec4 color = ${call};
  if (tinted) color = tint * color.a;
  pixel = color + backdrop() * (1.0 - color.a);
  if (straight) pixel.rgb /= max(pixel.a, exp2(-24.0));
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
  /** @type {import('./drawing.js').ShownDrawing['gradients']} */
  #gradients = 0;

  /**
   * @param {Record<string, {value: any}>} overlays uniforms of overlay.glsl, set by the module `overlays`
   * @param {Backdrop} backdrop
   */
  constructor(overlays, backdrop) {
    this.backdrop = backdrop;
    const nothing = /** @type {Texture | undefined} */ (undefined);
    this.uniforms = Object.assign(overlays, backdrop.uniforms, {
      vextureTexels: { value: nothing },
      vexturePaints: { value: nothing },
      base: { value: [0, 0] },
      start: { value: new Vector2() },
      side: { value: 1 },
      first: { value: 0 },
      count: { value: 1 },
      quad: { value: 0 },
      tinted: { value: false },
      tint: { value: new Vector4(1, 1, 1, 1) },
      straight: { value: false },
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
    const chosen = `${FLAT}#define VEXTURE_GRADIENTS ${this.#gradients}\n`;
    const made = this.#passes.get(key)
      ?? (isOverlaid ? new Pass(chosen + text + overlay + output(call), this.uniforms, { OVERLAY: 1 })
        : new Pass(chosen + text + output(call), this.uniforms));
    this.#passes.set(key, made);
    return made;
  }

  /** @param {import('./drawing.js').ShownDrawing} shown */
  setDrawing(shown) {
    const { uniforms } = this;
    uniforms.vextureTexels.value = shown.texture.textures.texels;
    uniforms.vexturePaints.value = shown.texture.textures.layers;
    uniforms.first.value = shown.first;
    uniforms.count.value = shown.count;
    uniforms.quad.value = shown.texture.roots[shown.first].quad;
    this.#maps = shown.maps;
    this.#gradients = shown.gradients;
  }

  /**
   * Draw in one colour from now on.
   *
   * @param {import('../src/data.js').RootPaint} paint
   */
  paintAll({ color, opacity }) {
    const [red, green, blue] = color.map((part) => part * opacity);
    this.uniforms.tint.value.set(red, green, blue, opacity);
    this.uniforms.tinted.value = true;
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

  dispose() {
    for (const pass of this.#passes.values()) pass.dispose();
  }

  /**
   * Draw the unit square into an image of n x n pixels, premultiplied.
   *
   * @param {WebGLRenderer} renderer
   * @param {import('three').WebGLRenderTarget} target
   * @param {boolean} asCoverage in white instead of its colours
   */
  drawSquare(renderer, target, asCoverage) {
    const { base, start, side, tinted } = this.uniforms;
    tinted.value = asCoverage;
    base.value = [0, 0];
    start.value.set(0, 0);
    side.value = 1 / target.width;
    this.drawInto(renderer, target);
    tinted.value = false;
  }

  /**
   * Draw into an image as the uniforms say, with nothing below.
   *
   * @param {WebGLRenderer} renderer
   * @param {import('three').WebGLRenderTarget} target
   */
  drawInto(renderer, target) {
    renderer.setRenderTarget(target);
    this.backdrop.without(() => this.plain.draw(renderer));
    renderer.setRenderTarget(null);
  }
}
