/** The flat picture of a packed texture, its layers on the theme's paper. */
import { Vector2, Vector3 } from 'three';
import { QUALITIES, packed, packedOverlay } from '../generated/shaders.js';
import { Pass } from './pass.js';
import { shaderView } from './view.js';

/** @typedef {import('./theme.js').Colors} Colors */
/** @typedef {import('three').Texture} Texture */

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

/** What the flat shaders share; `overlays` are the uniforms of packed_overlay.glsl. */
export class Flat {
  /** @param {Record<string, {value: any}>} overlays */
  constructor(overlays) {
    this.uniforms = Object.assign(overlays, {
      vextureTexels: { value: /** @type {Texture | undefined} */ (undefined) },
      vexturePaints: { value: /** @type {Texture | undefined} */ (undefined) },
      base: { value: [0, 0] },
      start: { value: new Vector2() },
      side: { value: 1 },
      first: { value: 0 },
      count: { value: 1 },
      silhouette: { value: true },
      ink: { value: new Vector3() },
      paper: { value: [1, 1, 1, 1] },
    });
    const text = `#define VEXTURE_QUALITY ${QUALITIES.exact}\n`;
    this.plain = new Pass(text + packed + OUTPUT, this.uniforms);
    this.overlaid = new Pass(text + packedOverlay + OUTPUT, this.uniforms, { OVERLAY: true });
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
    uniforms.paper.value = [...colors.paper, 1];
  }

  /**
   * @param {import('./view.js').View} view
   * @param {import('./view.js').Size} size
   * @param {number} ratio
   */
  setView(view, size, ratio) {
    const { base, start, step } = shaderView(view, size, ratio);
    this.uniforms.base.value = base;
    this.uniforms.start.value.fromArray(start);
    this.uniforms.side.value = step;
  }
}
