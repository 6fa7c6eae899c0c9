import { Color, FrontSide, Mesh, ShaderMaterial, UniformsLib, UniformsUtils, Vector3 } from 'three';
import { SEA, checkGeometry, watered } from './mesh.js';
import { waterNormals } from './normals.js';
import { SIMPLE_SHADER } from './shader.js';
import { WaterShape } from './shape.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @import { ColorRepresentation, Side, Texture } from 'three' */

/**
 * @typedef {object} SimpleWaterLook What water looks like that mirrors a sky of two colours.
 * @property {Texture} [waterNormals] normals of the waves, which repeat; by default those of `waterNormals()`
 * @property {Vector3} [sunDirection] towards the sun, of length 1
 * @property {ColorRepresentation} [sunColor] by default `0x9fb0b8`
 * @property {ColorRepresentation} [waterColor] by default `0x0b5068`
 * @property {ColorRepresentation} [sky] colour of the sky at the zenith, by default `0x6f9fcf`
 * @property {ColorRepresentation} [horizon] colour of the sky at the horizon, by default `0xd5e2ea`
 * @property {number} [size] scale of the waves, by default 1; larger values give smaller waves
 * @property {number} [alpha] opacity, by default 1
 * @property {number} [time] seconds, by default 0
 * @property {Side} [side] by default `FrontSide`
 * @property {boolean} [fog] whether the scene's fog hides it, by default `false`
 *
 * @typedef {import('./shape.js').WaterShapeOptions & SimpleWaterLook & import('./mesh.js').WaterOptions} SimpleWaterOptions
 *   those of `VectorWater`, except for its mirror; and the colours of the sky, which this water mirrors instead of the scene
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
    /** @internal */
    this.ownNormals = options.waterNormals ? null : normals;
    /** @internal */
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
