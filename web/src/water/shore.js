// The shore rasters: the fraction of the shape around each point. The GPU draws them from the shape when it changes.
import {
  ClampToEdgeWrapping,
  HalfFloatType,
  LinearFilter,
  NoBlending,
  RGFormat,
  ShaderMaterial,
  UnsignedByteType,
  Vector2,
  Vector3,
  WebGLRenderTarget,
} from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';
import { SHORE_SHADER, SPREAD_SHADER } from './shader.js';

/**
 * @typedef {object} Shape
 * @property {import('three').DataTexture} texels
 * @property {number} quad its root
 *
 * @typedef {Shape & { reach: number, target: WebGLRenderTarget }} Raster of a shape; its wide box filter has 2 `reach` +
 *   1 texels
 */

/** Least texels in half a box: with linear interpolation, more would not look smoother. */
const TEXELS = 4;

/** Least and most texels of a side. At the most, narrow foam gets smaller boxes. */
const LEAST_SIDE = 256;
const MOST_SIDE = 1024;

/** Texels in half a near box, and at least in half a wide one: enough to tell where there is no outline. */
const LEAST_TEXELS = 2;

/**
 * Format of the rasters. With eight bits, for GPUs that cannot render to others, lines of foam show small steps.
 *
 * @param {import('three').WebGLRenderer} renderer
 * @param {number} side
 */
function targetOf({ extensions }, side) {
  const halves = ['EXT_color_buffer_float', 'EXT_color_buffer_half_float'].some((name) => extensions.has(name));
  return new WebGLRenderTarget(side, side, {
    format: RGFormat,
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
 * Draw and restore the renderer's state, since a frame is in progress.
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

/**
 * A full-screen pass.
 *
 * @param {string} name
 * @param {{ vertexShader: string, fragmentShader: string }} shader
 * @param {Record<string, unknown>} values of its uniforms
 */
function pass(name, shader, values) {
  const uniforms = Object.fromEntries(Object.entries(values).map(([key, value]) => [key, { value }]));
  const parameters = { name, ...shader, uniforms, blending: NoBlending, depthTest: false, depthWrite: false };
  return new FullScreenQuad(new ShaderMaterial(parameters));
}

/**
 * @param {FullScreenQuad} quad
 * @param {Record<string, unknown>} values of its uniforms
 */
function set({ material }, values) {
  const { uniforms } = /** @type {ShaderMaterial} */ (material);
  for (const [name, value] of Object.entries(values)) uniforms[name].value = value;
}

export class Shores {
  /** @type {Raster[]} */
  #rasters = [];
  /** @type {import('three').WebGLRenderer | null} */
  #renderer = null;
  #texels = pass('VextureShore', SHORE_SHADER, { vextureTexels: null, vextureRoot: 0, vextureTexel: 0 });
  #spread = pass('VextureSpread', SPREAD_SHADER, {
    vextureRaster: null, vextureWay: new Vector2(), vextureReach: 0, vextureNear: LEAST_TEXELS,
  });
  #onRestored = () => this.#drop(this.#rasters);

  /**
   * Rasters of shapes; only new ones are drawn.
   *
   * @param {import('three').WebGLRenderer} renderer
   * @param {Shape[]} shapes
   * @param {number} width of the foam
   */
  drawn(renderer, shapes, width) {
    this.#use(renderer);
    const wanted = 2 ** Math.ceil(Math.log2(TEXELS / Math.max(width, TEXELS / MOST_SIDE)));
    const texel = 1 / Math.max(wanted, LEAST_SIDE);
    const reach = Math.max(Math.ceil(width / texel - 0.5), LEAST_TEXELS);
    const before = this.#rasters;
    this.#rasters = [];
    for (const shape of shapes) {
      const same = (/** @type {Raster} */ one) =>
        one.texels === shape.texels && one.quad === shape.quad && one.reach === reach;
      this.#rasters.push(before.find(same) ?? this.#rasters.find(same) ?? this.#draw({ ...shape, reach }, texel));
    }
    this.#drop(before.filter((one) => !this.#rasters.includes(one)));
    const half = (/** @type {number} */ texels) => (texels + 0.5) * texel;
    const boxes = new Vector3(half(reach), half(reach) - texel, half(LEAST_TEXELS) - texel);
    return { rasters: this.#rasters.map(({ target }) => target.texture), boxes };
  }

  /**
   * @param {Shape & { reach: number }} shape
   * @param {number} texel
   * @returns {Raster}
   */
  #draw(shape, texel) {
    const renderer = /** @type {import('three').WebGLRenderer} */ (this.#renderer);
    const [target, other] = [targetOf(renderer, 1 / texel), targetOf(renderer, 1 / texel)];
    set(this.#texels, { vextureTexels: shape.texels, vextureRoot: shape.quad, vextureTexel: texel });
    drawInto(renderer, target, () => this.#texels.render(renderer));
    for (const [from, to, x, y] of /** @type {const} */ ([[target, other, 1, 0], [other, target, 0, 1]])) {
      set(this.#spread, { vextureRaster: from.texture, vextureWay: new Vector2(x, y), vextureReach: shape.reach });
      drawInto(renderer, to, () => this.#spread.render(renderer));
    }
    other.dispose();
    return { ...shape, target };
  }

  /** @param {Raster[]} rasters */
  #drop(rasters) {
    for (const { target } of rasters) target.dispose();
    this.#rasters = this.#rasters.filter((one) => !rasters.includes(one));
  }

  /**
   * Drop the rasters with a lost context or for another renderer.
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

  /** Free the GPU memory. */
  dispose() {
    this.#use(null);
    for (const quad of [this.#texels, this.#spread]) {
      quad.material.dispose();
      quad.dispose();
    }
  }
}
