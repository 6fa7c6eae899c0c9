// Lets rays pass a mesh where its mask lets them, and those of its clones.
import { takePartIn } from './methods.js';

/**
 * @typedef {object} Rays The interface of a mask to its meshes.
 * @property {import('three').Material} material
 * @property {(u: number, v: number, instance?: number) => boolean} hits
 * @property {(u: number, v: number, instance?: number) => import('./element-at.js').FoundElement | null} elementAt
 * @property {() => 'uv' | 'uv1'} uv texture coordinates of the mesh that the mask looks up
 * @property {(copy: Masked) => void} attach a clone of the mesh
 *
 * @typedef {import('three').Object3D & {
 *   material: import('three').Material | import('three').Material[],
 *   geometry: import('three').BufferGeometry
 * }} Masked a mesh, or whatever else has a geometry and a material
 *
 * @typedef {import('./masked-intersection.js').MaskedIntersection} MaskedIntersection
 */

/** A mesh whose rays a mask filters. */
export class RayMesh {
  #mesh;
  #rays;
  #takeBack;

  /**
   * @param {Masked} mesh
   * @param {Rays} rays
   */
  constructor(mesh, rays) {
    this.#mesh = mesh;
    this.#rays = rays;
    this.#takeBack = [
      takePartIn(mesh, 'raycast', (raycast, raycaster, hits) => {
        /** @type {MaskedIntersection[]} */
        const found = [];
        raycast(raycaster, found);
        for (const hit of found) if (this.#isHit(hit)) hits.push(hit);
      }),
      // three.js copies nothing of a mask to a clone, of a mesh or of a model around it
      takePartIn(mesh, 'clone', (clone, recursive) => {
        const copy = clone(recursive);
        rays.attach(copy);
        return copy;
      }),
    ];
  }

  /**
   * Whether a ray meets the masked surface; `element` of the intersection tells which part of the drawing.
   *
   * @param {MaskedIntersection} hit
   */
  #isHit(hit) {
    const { face, instanceId } = hit;
    const uv = hit[this.#rays.uv()];
    const { material } = this.#mesh;
    const one = Array.isArray(material) ? material[face?.materialIndex ?? 0] : material;
    if (uv === undefined || one !== this.#rays.material) return true;
    hit.element = this.#rays.elementAt(uv.x, uv.y, instanceId);
    return this.#rays.hits(uv.x, uv.y, instanceId);
  }

  /** Nothing of rays changes with a mask. */
  update() {}

  dispose() {}

  release() {
    for (const takeBack of this.#takeBack) takeBack();
    this.dispose();
  }
}

/** The meshes of a mask. It does not keep them alive: clones of a model come and go, and nobody detaches them. */
export class MaskedMeshes {
  /** @type {WeakMap<Masked, RayMesh>} */
  #attached = new WeakMap();
  /** @type {Set<WeakRef<Masked>>} */
  #meshes = new Set();

  /** @param {Masked} mesh */
  has(mesh) {
    return this.#attached.has(mesh);
  }

  /**
   * @param {Masked} mesh
   * @param {RayMesh} attached
   */
  add(mesh, attached) {
    this.#attached.set(mesh, attached);
    this.#meshes.add(new WeakRef(mesh));
  }

  /** @param {Masked} mesh */
  release(mesh) {
    this.#attached.get(mesh)?.release();
    this.#attached.delete(mesh);
  }

  releaseAll() {
    for (const [mesh] of this.#present()) this.release(mesh);
  }

  /** @param {(attached: RayMesh) => void} act */
  forEach(act) {
    for (const [, attached] of this.#present()) act(attached);
  }

  /** @returns {[Masked, RayMesh][]} */
  #present() {
    /** @type {[Masked, RayMesh][]} */
    const present = [];
    for (const reference of this.#meshes) {
      const mesh = reference.deref();
      const attached = mesh && this.#attached.get(mesh);
      if (attached) present.push([mesh, attached]);
      else this.#meshes.delete(reference);
    }
    return present;
  }
}
