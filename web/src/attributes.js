import { InstancedBufferAttribute, IntType } from 'three';
import { MOST_ROWS } from '../generated/layout.js';
import { VextureError, line, unfit } from './errors.js';

/** Name of the attribute that holds each instance's root. */
export const ROOT_ATTRIBUTE = 'vextureRoot';

/** Names that three.js uses for sets of texture coordinates, in geometries and in intersections of rays. */
export const UV_ATTRIBUTES = Object.freeze(/** @type {const} */ (['uv', 'uv1']));

/**
 * Attribute `vextureRoot` for the geometry of an `InstancedMesh`: the shape of each instance.
 *
 * @param {import('./vector-texture.js').AnyVectorTexture} texture
 * @param {readonly (string | number)[]} roots names, or indices in `texture.roots`, one for each instance
 * @returns {InstancedBufferAttribute}
 */
export function rootAttribute(texture, roots) {
  if (!texture?.isVectorTexture) throw unfit('texture', texture, 'load one by VectorTextureLoader');
  if (typeof roots?.map !== 'function') throw new VextureError(`roots is ${line(roots)}; give an array of names`, 'roots');
  const places = roots.map((root) => texture.index(root));
  const most = places.findIndex((place) => place >= MOST_ROWS);
  if (most >= 0) {
    throw new VextureError(`${texture.name}: root ${places[most]}; instances can show the first ${MOST_ROWS}`, 'root');
  }
  const attribute = new InstancedBufferAttribute(new Uint32Array(places), 1);
  attribute.gpuType = IntType;
  return attribute;
}

/** Warnings already given for each geometry. @type {WeakMap<import('three').BufferGeometry, Set<string>>} */
const SAID = new WeakMap();

/**
 * Warn once about a geometry without the attributes that a mask reads, because three.js would silently draw nothing.
 *
 * @param {import('three').Object3D & { count?: number }} object
 * @param {import('three').BufferGeometry} geometry
 * @param {Pick<import('./mask-options.js').AllOptions, 'channel' | 'instanced'>} options
 */
export function warnOfMissing(object, geometry, { channel, instanced }) {
  const uv = UV_ATTRIBUTES[channel];
  const { [uv]: places, [ROOT_ATTRIBUTE]: roots } = geometry.attributes;
  const { count = 1 } = object;
  if (!places) warn(object, geometry, `${uv}; give it texture coordinates, or the mask another channel`);
  if (instanced && !(roots?.count >= count)) {
    warn(object, geometry, `${ROOT_ATTRIBUTE} of ${count} instances; make it by rootAttribute(texture, names)`);
  }
}

/**
 * @param {import('three').Object3D} object
 * @param {import('three').BufferGeometry} geometry
 * @param {string} missing
 */
function warn({ name, type }, geometry, missing) {
  const said = SAID.get(geometry) ?? new Set();
  if (said.has(missing)) return;
  SAID.set(geometry, said.add(missing));
  console.warn(`vexture: ${name || type} has no attribute ${missing}`);
}
