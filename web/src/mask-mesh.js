// Applies a mask to a mesh's shadows and raycasting, and to those of its clones.
import { MeshDepthMaterial, MeshDistanceMaterial, RGBADepthPacking } from 'three';
import { VextureError } from './errors.js';
import { takePart } from './hooks.js';
import { RayMesh } from './ray-mesh.js';

/** @typedef {import('./ray-mesh.js').Masked} Masked */

/**
 * @typedef {object} Shadows What a mask does to the light that its meshes keep away.
 * @property {() => boolean} cuts whether light passes outside the shape
 * @property {() => string} key
 * @property {(program: import('./hooks.js').Program, type: string) => void} compile for depths and distances
 *
 * @typedef {import('./ray-mesh.js').Rays & Shadows} Cut The interface of a mask to its meshes.
 */

/**
 * @param {Masked} mesh
 * @param {Cut} cut
 * @param {boolean} shadow
 * @returns {boolean} whether its shadow has to be cut
 */
function cutsOne({ material }, cut, shadow) {
  if (!shadow || !cut.cuts()) return false;
  if (Array.isArray(material)) {
    throw new VextureError(
      'mesh has several materials, which share one shadow; give each a mesh of its own, or attach with shadow: false',
      'mesh',
    );
  }
  return true;
}

/** A mesh attached to a mask. */
export class MaskedMesh extends RayMesh {
  #mesh;
  #cut;
  #shadow;
  #before;
  #depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
  #distance = new MeshDistanceMaterial();

  /**
   * @param {Masked} mesh
   * @param {Cut} cut
   * @param {boolean} shadow whether to cut its shadow, where light passes
   */
  constructor(mesh, cut, shadow) {
    cutsOne(mesh, cut, shadow);
    super(mesh, cut);
    this.#mesh = mesh;
    this.#cut = cut;
    this.#shadow = shadow;
    this.#before = { depth: mesh.customDepthMaterial, distance: mesh.customDistanceMaterial };
    for (const material of [this.#depth, this.#distance]) {
      takePart(material, cut.key, (program) => cut.compile(program, material.type));
    }
    this.update();
  }

  /** Follow a change of the mask. */
  update() {
    const cuts = cutsOne(this.#mesh, this.#cut, this.#shadow);
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
    super.release();
    this.#mesh.customDepthMaterial = this.#before.depth;
    this.#mesh.customDistanceMaterial = this.#before.distance;
  }
}
