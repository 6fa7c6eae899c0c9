// Applies a mask to a mesh's shadows and raycasting, and to those of its clones.
import { MeshDepthMaterial, MeshDistanceMaterial, RGBADepthPacking } from 'three';
import { VextureError } from './errors.js';
import { takePart } from './hooks.js';

/**
 * @typedef {object} Cut The interface of a mask to its meshes.
 * @property {import('three').Material} material
 * @property {() => boolean} cuts whether light passes outside the shape
 * @property {(u: number, v: number, instance?: number) => boolean} hits
 * @property {(u: number, v: number, instance?: number) => import('./element-at.js').FoundElement | null} elementAt
 * @property {() => 'uv' | 'uv1'} uv texture coordinates of the mesh that the mask looks up
 * @property {() => string} key
 * @property {(program: import('./hooks.js').Program, type: string) => void} compile for depths and distances
 * @property {(copy: Masked) => void} attach a clone of the mesh
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
export class MaskedMesh {
  #mesh;
  #cut;
  #shadow;
  #before;
  #takeBack;
  #isReleased = false;
  #depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
  #distance = new MeshDistanceMaterial();

  /**
   * @param {Masked} mesh
   * @param {Cut} cut
   * @param {boolean} shadow whether to cut its shadow, where light passes
   */
  constructor(mesh, cut, shadow) {
    cutsOne(mesh, cut, shadow);
    this.#mesh = mesh;
    this.#cut = cut;
    this.#shadow = shadow;
    this.#before = { depth: mesh.customDepthMaterial, distance: mesh.customDistanceMaterial };
    for (const material of [this.#depth, this.#distance]) {
      takePart(material, cut.key, (program) => cut.compile(program, material.type));
    }
    this.#takeBack = [this.#filterRays(), this.#followClones()];
    this.update();
  }

  #filterRays() {
    const { raycast } = this.#mesh;
    return this.#replace('raycast', (raycaster, hits) => {
      if (this.#isReleased) return raycast.call(this.#mesh, raycaster, hits);
      /** @type {MaskedIntersection[]} */
      const found = [];
      raycast.call(this.#mesh, raycaster, found);
      for (const hit of found) if (this.#isHit(hit)) hits.push(hit);
    });
  }

  /** three.js copies nothing of a mask to a clone, of a mesh or of a model around it. */
  #followClones() {
    const { clone } = this.#mesh;
    return this.#replace('clone', (recursive) => {
      const copy = clone.call(this.#mesh, recursive);
      if (!this.#isReleased) this.#cut.attach(/** @type {Masked} */ (copy));
      return copy;
    });
  }

  /**
   * Replace a method of the mesh.
   *
   * @template {'raycast' | 'clone'} Name
   * @param {Name} name
   * @param {Masked[Name]} method
   * @returns {() => void} takes it back, unless another one has replaced it, which calls it
   */
  #replace(name, method) {
    const mesh = this.#mesh;
    const before = Object.hasOwn(mesh, name) ? mesh[name] : null;
    mesh[name] = method;
    return () => {
      if (mesh[name] !== method) return;
      if (before) mesh[name] = before;
      else delete (/** @type {Partial<Masked>} */ (mesh)[name]);
    };
  }

  /**
   * Whether a ray meets the masked surface; `element` of the intersection tells which part of the drawing.
   *
   * @param {MaskedIntersection} hit
   */
  #isHit(hit) {
    const { face, instanceId } = hit;
    const uv = hit[this.#cut.uv()];
    const { material } = this.#mesh;
    const one = Array.isArray(material) ? material[face?.materialIndex ?? 0] : material;
    if (uv === undefined || one !== this.#cut.material) return true;
    hit.element = this.#cut.elementAt(uv.x, uv.y, instanceId);
    return this.#cut.hits(uv.x, uv.y, instanceId);
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
    const { depth, distance } = this.#before;
    this.#isReleased = true; // methods that replaced these later still call them
    for (const takeBack of this.#takeBack) takeBack();
    this.#mesh.customDepthMaterial = depth;
    this.#mesh.customDistanceMaterial = distance;
    this.dispose();
  }
}

/** The meshes of a mask. It does not keep them alive: clones of a model come and go, and nobody detaches them. */
export class MaskedMeshes {
  /** @type {WeakMap<Masked, MaskedMesh>} */
  #attached = new WeakMap();
  /** @type {Set<WeakRef<Masked>>} */
  #meshes = new Set();

  /** @param {Masked} mesh */
  has(mesh) {
    return this.#attached.has(mesh);
  }

  /**
   * @param {Masked} mesh
   * @param {MaskedMesh} attached
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

  /** @param {(attached: MaskedMesh) => void} act */
  forEach(act) {
    for (const [, attached] of this.#present()) act(attached);
  }

  /** @returns {[Masked, MaskedMesh][]} */
  #present() {
    /** @type {[Masked, MaskedMesh][]} */
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
