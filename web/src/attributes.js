import { InstancedBufferAttribute, IntType } from 'three';
import { MOST_ROWS } from '../generated/layout.js';
import { VextureError } from './errors.js';

/** Name of the attribute that holds each instance's root. */
export const ROOT_ATTRIBUTE = 'vextureRoot';

/** Names that three.js gives the sets of texture coordinates, in geometries and in what a ray meets. */
export const UV_ATTRIBUTES = Object.freeze(/** @type {const} */ (['uv', 'uv1']));

/**
 * Attribute `vextureRoot` for the geometry of an `InstancedMesh`: the shape of each instance.
 *
 * @param {import('./vector-texture.js').AnyVectorTexture} texture
 * @param {readonly (string | number)[]} roots names or places in `texture.roots`, one for each instance
 * @returns {InstancedBufferAttribute}
 */
export function rootAttribute(texture, roots) {
  const places = roots.map((root) => texture.index(root));
  const most = places.findIndex((place) => place >= MOST_ROWS);
  if (most >= 0) {
    throw new VextureError(`${texture.name}: root ${places[most]}; instances can show the first ${MOST_ROWS}`, 'root');
  }
  const attribute = new InstancedBufferAttribute(new Uint32Array(places), 1);
  attribute.gpuType = IntType;
  return attribute;
}
