import { Water } from 'three/addons/objects/Water.js';
import { insert } from '../hooks.js';
import { SEA, checkGeometry, watered } from './mesh.js';
import { waterNormals } from './normals.js';
import { WATER_TEXTS } from './shader.js';
import { WaterShape } from './shape.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */

/**
 * @typedef {import('./shape.js').WaterShapeOptions & import('three/addons/objects/Water.js').WaterOptions
 *   & import('./mesh.js').WaterOptions & { size?: number }} VectorWaterOptions
 *   those of three.js's Water, and those of a shape; `size`, by default 1, is the scale of the waves: larger values give
 *   smaller waves
 */

/** three.js's Water within a shape: it mirrors the scene, and has foam and shallows along the shore. */
export class VectorWater extends watered(Water) {
  /**
   * @param {import('three').BufferGeometry} geometry a plane; its vertices may be moved along z
   * @param {VectorTexture | null} texture
   * @param {VectorWaterOptions} [options] and those of three.js's Water
   * @throws {VextureError} if an option is out of range, or the shader of this three.js's Water lacks a hook
   */
  constructor(geometry, texture, options = {}) {
    checkGeometry(geometry);
    const { size = 1, waterNormals: given, ...others } = { ...SEA, ...options };
    const normals = given ?? waterNormals();
    super(geometry, { ...others, waterNormals: normals });
    /** @internal */
    this.ownNormals = given ? null : normals;
    const { material } = this;
    /** @internal */
    this.shape = new WaterShape(texture, options, (shown) => (material.visible = shown));
    insert(material, 'Water', WATER_TEXTS);
    Object.assign(material.uniforms, this.shape.uniforms);
    material.uniforms.size.value = size;
    material.transparent = true;
    this.follow(options);
  }
}
