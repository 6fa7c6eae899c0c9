// The package's entry `vexture/water`: apart, since it needs an addon of three.js.
import { SimpleWater } from './simple-water.js';
import { VectorWater } from './vector-water.js';

export { SimpleWater } from './simple-water.js';
export { VectorWater } from './vector-water.js';
export { waterNormals } from './normals.js';

/** Gigabytes of memory up to which a device gets the simple water. */
const LITTLE_MEMORY = 4;

/**
 * The kind of water for this device: without a mirror where a finger points (phones, tablets) and where there is little
 * memory. A page that knows better takes the class that it likes.
 *
 * @returns {typeof VectorWater | typeof SimpleWater}
 */
export function chooseWater() {
  const memory = /** @type {{ deviceMemory?: number }} */ (navigator).deviceMemory ?? Infinity;
  return matchMedia('(pointer: coarse)').matches || memory <= LITTLE_MEMORY ? SimpleWater : VectorWater;
}
