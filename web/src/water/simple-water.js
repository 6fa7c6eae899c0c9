import { Color, FrontSide, Mesh, ShaderMaterial, UniformsLib, UniformsUtils, Vector3 } from 'three';
import { SEA, checkGeometry, watered } from './mesh.js';
import { waterNormals } from './normals.js';
import { SIMPLE_SHADER } from './shader.js';
import { WaterShape } from './shape.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('three').ColorRepresentation} ColorRepresentation */

/**
 * @typedef {import('./shape.js').WaterShapeOptions & {
 *   waterNormals?: import('three').Texture,
 *   sunDirection?: Vector3,
 *   sunColor?: ColorRepresentation,
 *   waterColor?: ColorRepresentation,
 *   sky?: ColorRepresentation,
 *   horizon?: ColorRepresentation,
 *   size?: number,
 *   alpha?: number,
 *   time?: number,
 *   side?: import('three').Side,
 *   fog?: boolean,
 * } & import('./mesh.js').WaterOptions} SimpleWaterOptions those of `VectorWater`, except for its mirror; and the colours of the sky at the zenith and at
 *   the horizon, which this water mirrors instead of the scene
 */

/** Water for phones: like `VectorWater`, but it mirrors a sky of two colours instead of the scene. */
export class SimpleWater extends watered(
  /** @type {new (...args: any[]) => import('./mesh.js').WaterMesh} */ (Mesh),
) {
  /**
   * @param {import('three').BufferGeometry} geometry a plane, as `VectorWater` takes it
   * @param {VectorTexture | null} texture
   * @param {SimpleWaterOptions} [options]
   * @throws {VextureError} if an option is out of range
   */
  constructor(geometry, texture, options = {}) {
    checkGeometry(geometry);
    const { sunDirection = new Vector3(0.70707, 0.70707, 0), sunColor, waterColor } = { ...SEA, ...options };
    const { sky = 0x6f9fcf, horizon = 0xd5e2ea, size = 1, alpha = 1, time = 0, side = FrontSide, fog = false } = options;
    const normals = options.waterNormals ?? waterNormals();
    const material = new ShaderMaterial({
      name: 'SimpleWater',
      uniforms: UniformsUtils.clone(UniformsLib.fog),
      transparent: true,
      side,
      fog,
    });
    super(geometry, material);
    this.ownNormals = options.waterNormals ? null : normals;
    this.shape = new WaterShape(texture, options, (shown) => (material.visible = shown));
    Object.assign(material, SIMPLE_SHADER);
    Object.assign(material.uniforms, this.shape.uniforms, {
      normalSampler: { value: normals },
      sunDirection: { value: sunDirection },
      sunColor: { value: new Color(sunColor) },
      waterColor: { value: new Color(waterColor) },
      vextureZenith: { value: new Color(sky) },
      vextureHorizon: { value: new Color(horizon) },
      size: { value: size },
      alpha: { value: alpha },
      time: { value: time },
    });
    this.follow(options);
  }
}
