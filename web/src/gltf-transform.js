import { Matrix3 } from 'three';
import { VextureError, line, givenOptions } from './errors.js';

/**
 * @typedef {object} GLTFTransform Parameters of KHR_texture_transform.
 * @property {readonly [number, number]} [offset] by default 0, 0
 * @property {number} [rotation] in radians, by default 0
 * @property {readonly [number, number]} [scale] by default 1, 1
 */

/**
 * Make the `transform` of a mask on a glTF model, whose texture coordinates point down where the unit square points up.
 *
 * The coordinates are scaled, turned, moved and then turned over (FORMAT.md, E.4).
 *
 * @param {GLTFTransform} [transform]
 * @returns {Matrix3} from the mesh's uv to the unit square
 * @throws {VextureError} if a part is not numeric
 */
export function gltfTransform(transform) {
  const { offset = [0, 0], rotation = 0, scale = [1, 1] } = givenOptions(transform, 'parts of the transform');
  const [c, s] = [Math.cos(rotation), Math.sin(rotation)];
  const matrix = new Matrix3().set(
    c * scale[0], s * scale[1], offset[0],
    s * scale[0], -c * scale[1], 1 - offset[1],
    0, 0, 1,
  );
  if (matrix.elements.every(Number.isFinite)) return matrix;
  const given = line({ offset, rotation, scale });
  throw new VextureError(`the transform is ${given}; offset and scale must be two numbers each, rotation one`, 'transform');
}
