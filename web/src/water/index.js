/**
 * Water within a shape, with foam and shallows along its shore. An entry of its own, because it needs an addon of three.js.
 *
 * @module
 */
import { SimpleWater } from './simple-water.js';
import { VectorWater } from './vector-water.js';

export { SimpleWater } from './simple-water.js';
export { VectorWater } from './vector-water.js';
export { waterNormals } from './normals.js';

/** Devices with up to this many gigabytes of memory get the simple water. */
const LITTLE_MEMORY = 4;

/**
 * The kind of water for this device: `SimpleWater` on touch screens (phones, tablets) and with little memory, otherwise
 * `VectorWater`. A page may also choose the class itself.
 *
 * @returns {typeof VectorWater | typeof SimpleWater}
 */
export function chooseWater() {
  const memory = /** @type {{ deviceMemory?: number }} */ (navigator).deviceMemory ?? Infinity;
  return matchMedia('(pointer: coarse)').matches || memory <= LITTLE_MEMORY ? SimpleWater : VectorWater;
}

/** @typedef {import('./fields.js').Calm} Calm */
/** @typedef {import('./fields.js').DepthColors} DepthColors */
/** @typedef {import('./mesh.js').WaterOptions} WaterOptions */
/** @typedef {import('./shape.js').Foam} Foam */
/** @typedef {import('./shape.js').WaterShapeOptions} WaterShapeOptions */
/** @typedef {import('./simple-water.js').SimpleWaterLook} SimpleWaterLook */
/** @typedef {import('./simple-water.js').SimpleWaterOptions} SimpleWaterOptions */
/** @typedef {import('./vector-water.js').VectorWaterOptions} VectorWaterOptions */
