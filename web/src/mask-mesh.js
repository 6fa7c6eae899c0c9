// Applies a mask to a mesh's shadows and raycasting.
import { MeshDepthMaterial, MeshDistanceMaterial, RGBADepthPacking } from 'three';
import { VextureError } from './errors.js';
import { takePart } from './hooks.js';

/**
 * @typedef {object} Cut The interface of a mask to its meshes.
 * @property {import('three').Material} material
 * @property {() => boolean} cuts whether light passes outside the shape
 * @property {(u: number, v: number, instance?: number) => boolean} hits
 * @property {(u: number, v: number, instance?: number) => import('./element-at.js').FoundElement | null} elementAt
 * @property {() => string} key
 * @property {(program: import('./hooks.js').Program, type: string) => void} compile for depths and distances
 *
 * @typedef {import('three').Object3D & {
 *   material: import('three').Material | import('three').Material[],
 *   geometry: import('three').BufferGeometry
 * }} Masked
 *
 * @typedef {import('three').Intersection & { element?: import('./element-at.js').FoundElement | null }} MaskedIntersection
 *   what a ray finds on an attached mesh: `element` is the element of the drawing there, null without any
 */

/**
 * @param {Masked} mesh
 * @param {Cut} cut
 * @returns {boolean} whether its shadow has to be cut
 */
function cutsOne({ material }, cut) {
  if (cut.cuts() && Array.isArray(material)) {
    throw new VextureError('mesh has several materials, which share one shadow; give each a mesh of its own', 'mesh');
  }
  return cut.cuts();
}

/** A mesh attached to a mask. */
export class MaskedMesh {
  #mesh;
  #cut;
  #before;
  #depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
  #distance = new MeshDistanceMaterial();

  /**
   * @param {Masked} mesh
   * @param {Cut} cut
   */
  constructor(mesh, cut) {
    cutsOne(mesh, cut);
    this.#mesh = mesh;
    this.#cut = cut;
    this.#before = {
      raycast: Object.hasOwn(mesh, 'raycast') ? mesh.raycast : null,
      depth: mesh.customDepthMaterial,
      distance: mesh.customDistanceMaterial,
    };
    for (const material of [this.#depth, this.#distance]) {
      takePart(material, cut.key, (program) => cut.compile(program, material.type));
    }
    const raycast = mesh.raycast;
    mesh.raycast = (raycaster, hits) => {
      /** @type {MaskedIntersection[]} */
      const found = [];
      raycast.call(mesh, raycaster, found);
      for (const hit of found) if (this.#isHit(hit)) hits.push(hit);
    };
    this.update();
  }

  /**
   * Whether a ray meets the masked surface; `element` of the intersection tells which part of the drawing.
   *
   * @param {MaskedIntersection} hit
   */
  #isHit(hit) {
    const { uv, face, instanceId } = hit;
    const { material } = this.#mesh;
    const one = Array.isArray(material) ? material[face?.materialIndex ?? 0] : material;
    if (uv === undefined || one !== this.#cut.material) return true;
    hit.element = this.#cut.elementAt(uv.x, uv.y, instanceId);
    return this.#cut.hits(uv.x, uv.y, instanceId);
  }

  /** Follow a change of the mask. */
  update() {
    const cuts = cutsOne(this.#mesh, this.#cut);
    this.#mesh.customDepthMaterial = cuts ? this.#depth : this.#before.depth;
    this.#mesh.customDistanceMaterial = cuts ? this.#distance : this.#before.distance;
    for (const material of [this.#depth, this.#distance]) material.needsUpdate = true;
  }

  /** Free the GPU memory; the next use allocates it again. */
  dispose() {
    this.#depth.dispose();
    this.#distance.dispose();
  }

  release() {
    const { raycast, depth, distance } = this.#before;
    if (raycast) this.#mesh.raycast = raycast;
    else delete (/** @type {Partial<Masked>} */ (this.#mesh).raycast);
    this.#mesh.customDepthMaterial = depth;
    this.#mesh.customDistanceMaterial = distance;
    this.dispose();
  }
}
