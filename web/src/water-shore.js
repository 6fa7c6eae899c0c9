// The rasters that water reads along the shore: how much of the shape lies around each place. They are drawn by the GPU,
// from the shape itself, when it changes.
import {
  ClampToEdgeWrapping,
  HalfFloatType,
  LinearFilter,
  NoBlending,
  RedFormat,
  ShaderMaterial,
  UnsignedByteType,
  WebGLRenderTarget,
} from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';
import { SHORE_SHADER } from './water-shader.js';

/**
 * @typedef {object} Shape
 * @property {import('three').DataTexture} texels
 * @property {number} quad its root
 *
 * @typedef {Shape & { reach: number, target: WebGLRenderTarget }} Raster a shape's, and half the width of its boxes
 */

/** Texels in half a box at least; blended, so few show its smooth edges as well as more would. */
const TEXELS = 4;

/** Least and most texels of a side. With the most, boxes of little foam hold fewer. */
const LEAST_SIDE = 256;
const MOST_SIDE = 1024;

/** Texels in half a box where that is wider than the foam: enough to know where no outline is. */
const LEAST_TEXELS = 2;

/**
 * In eight bits, for the GPUs that draw no others, lines of foam have little steps.
 *
 * @param {import('three').WebGLRenderer} renderer
 * @param {number} side
 */
function targetOf({ extensions }, side) {
  const halves = ['EXT_color_buffer_float', 'EXT_color_buffer_half_float'].some((name) => extensions.has(name));
  return new WebGLRenderTarget(side, side, {
    format: RedFormat,
    type: halves ? HalfFloatType : UnsignedByteType,
    depthBuffer: false,
    generateMipmaps: false,
    magFilter: LinearFilter,
    minFilter: LinearFilter,
    wrapS: ClampToEdgeWrapping,
    wrapT: ClampToEdgeWrapping,
  });
}

/**
 * Draw without a trace in the renderer's state: it is in the middle of a picture.
 *
 * @param {import('three').WebGLRenderer} renderer
 * @param {WebGLRenderTarget} target
 * @param {() => void} draw
 */
function drawInto(renderer, target, draw) {
  const [before, face, level] = [renderer.getRenderTarget(), renderer.getActiveCubeFace(), renderer.getActiveMipmapLevel()];
  const { xr, shadowMap } = renderer;
  const [enabled, autoUpdate] = [xr.enabled, shadowMap.autoUpdate];
  xr.enabled = false;
  shadowMap.autoUpdate = false;
  renderer.setRenderTarget(target);
  draw();
  xr.enabled = enabled;
  shadowMap.autoUpdate = autoUpdate;
  renderer.setRenderTarget(before, face, level);
}

export class Shores {
  /** @type {Raster[]} */
  #rasters = [];
  /** @type {import('three').WebGLRenderer | null} */
  #renderer = null;
  #quad = new FullScreenQuad(
    new ShaderMaterial({
      name: 'VextureShore',
      ...SHORE_SHADER,
      uniforms: {
        vextureTexels: { value: null },
        vextureRoot: { value: 0 },
        vextureReach: { value: 0 },
        vextureTexel: { value: 0 },
      },
      blending: NoBlending,
      depthTest: false,
      depthWrite: false,
    }),
  );
  #onRestored = () => this.#drop(this.#rasters);

  /**
   * Rasters of some shapes; only those that are new are drawn.
   *
   * @param {import('three').WebGLRenderer} renderer
   * @param {Shape[]} shapes
   * @param {number} width of the foam
   */
  drawn(renderer, shapes, width) {
    this.#use(renderer);
    const wanted = 2 ** Math.ceil(Math.log2(TEXELS / Math.max(width, TEXELS / MOST_SIDE)));
    const texel = 1 / Math.max(wanted, LEAST_SIDE);
    const reach = Math.max(width, LEAST_TEXELS * texel);
    const before = this.#rasters;
    this.#rasters = [];
    for (const shape of shapes) {
      const same = (/** @type {Raster} */ one) =>
        one.texels === shape.texels && one.quad === shape.quad && one.reach === reach;
      this.#rasters.push(before.find(same) ?? this.#rasters.find(same) ?? this.#draw({ ...shape, reach }, texel));
    }
    this.#drop(before.filter((one) => !this.#rasters.includes(one)));
    return { rasters: this.#rasters.map(({ target }) => target.texture), reach, texel };
  }

  /**
   * @param {Shape & { reach: number }} shape
   * @param {number} texel
   * @returns {Raster}
   */
  #draw(shape, texel) {
    const renderer = /** @type {import('three').WebGLRenderer} */ (this.#renderer);
    const target = targetOf(renderer, 1 / texel);
    const { uniforms } = /** @type {ShaderMaterial} */ (this.#quad.material);
    uniforms.vextureTexels.value = shape.texels;
    uniforms.vextureRoot.value = shape.quad;
    uniforms.vextureReach.value = shape.reach;
    uniforms.vextureTexel.value = texel;
    drawInto(renderer, target, () => this.#quad.render(renderer));
    return { ...shape, target };
  }

  /** @param {Raster[]} rasters */
  #drop(rasters) {
    for (const { target } of rasters) target.dispose();
    this.#rasters = this.#rasters.filter((one) => !rasters.includes(one));
  }

  /**
   * What a GPU has drawn is lost with its context, and another renderer does not have it.
   *
   * @param {import('three').WebGLRenderer | null} renderer
   */
  #use(renderer) {
    if (renderer === this.#renderer) return;
    this.#renderer?.domElement.removeEventListener('webglcontextrestored', this.#onRestored);
    renderer?.domElement.addEventListener('webglcontextrestored', this.#onRestored);
    this.#renderer = renderer;
    this.#drop(this.#rasters);
  }

  /** Free what the GPU holds. */
  dispose() {
    this.#use(null);
    this.#quad.material.dispose();
    this.#quad.dispose();
  }
}
