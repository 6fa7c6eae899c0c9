/** The drawing on a plane, a sphere or a cube, lit, turned by hand. */
import {
  BoxGeometry, DirectionalLight, DoubleSide, FrontSide, HemisphereLight, Matrix3, Mesh, MeshLambertMaterial,
  PerspectiveCamera, PlaneGeometry, Raycaster, Scene, SphereGeometry, Vector2,
} from 'three';
import { applyVectorMask } from '../src/vector-mask.js';

/**
 * @typedef {import('./state.js').ViewState} ViewState
 * @typedef {import('./drawing.js').ShownDrawing} ShownDrawing
 * @typedef {'plane' | 'sphere' | 'cube'} Surface
 */

/** Of the object, on any backdrop: drawings are made for light paper. */
const PAPER = '#f3f1ea';
const FIELD_OF_VIEW = 30;
const AWAY = 5.2;
const SEGMENTS = 64;
/** The drawing takes the half of the sphere that faces the reader, which is square on the surface. */
const FRONT_HALF = new Matrix3().set(2, 0, -0.5, 0, 1, 0, 0, 0, 1);

/** @param {Surface} surface */
function geometryOf(surface) {
  if (surface === 'plane') return new PlaneGeometry(2, 2);
  if (surface === 'cube') return new BoxGeometry(1.4, 1.4, 1.4);
  return new SphereGeometry(1.1, SEGMENTS, SEGMENTS / 2).rotateY(-Math.PI / 2);
}

export class Solid {
  /**
   * @param {Surface} surface
   * @param {ShownDrawing} drawing
   */
  constructor(surface, drawing) {
    this.surface = surface;
    this.drawing = drawing;
    this.material = new MeshLambertMaterial({ color: PAPER, side: surface === 'plane' ? DoubleSide : FrontSide });
    this.mask = applyVectorMask(this.material, drawing.texture, {
      mode: 'paint', background: 'own', root: drawing.count > 1 ? drawing.name : drawing.first,
      ...(surface === 'sphere' ? { transform: FRONT_HALF } : {}),
    });
    this.mesh = new Mesh(geometryOf(surface), this.material);
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 50);
    const sun = new DirectionalLight('#ffffff', 1.8);
    sun.position.set(-0.8, 1.2, 3);
    this.scene.add(this.mesh, sun, new HemisphereLight('#ffffff', '#c9c4ba', 1.6));
    this.ready = false;
    /** @type {Promise<void> | null} */
    this.compiling = null;
  }

  /** @param {import('three').WebGLRenderer} renderer */
  compile(renderer) {
    this.compiling ??= renderer.compileAsync(this.scene, this.camera).then(() => {
      this.ready = true;
    });
    return this.compiling;
  }

  /**
   * @param {ViewState} value
   * @param {import('./view.js').Size} size
   */
  place(value, size) {
    const { camera, mesh } = this;
    mesh.rotation.set(value.pitch, value.yaw, 0, 'XYZ');
    camera.aspect = size.width / size.height;
    const narrow = Math.min(1, camera.aspect);
    camera.position.z = AWAY / narrow;
    camera.zoom = value.distance;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    mesh.updateMatrixWorld();
  }

  /**
   * @param {import('three').WebGLRenderer} renderer
   * @param {import('./backdrop.js').Backdrop} backdrop
   */
  draw(renderer, backdrop) {
    renderer.clear();
    backdrop.pass.draw(renderer);
    renderer.render(this.scene, this.camera);
  }

  /**
   * Point of the unit square on the surface, at a place on the canvas.
   *
   * @param {number} px @param {number} py
   * @param {import('./view.js').Size} size
   * @returns {[number, number] | null}
   */
  toUnit(px, py, size) {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * px) / size.width - 1, 1 - (2 * py) / size.height), this.camera);
    const uv = ray.intersectObject(this.mesh)[0]?.uv;
    if (!uv) return null;
    if (this.surface === 'sphere') uv.applyMatrix3(FRONT_HALF);
    return [uv.x, uv.y];
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mask.remove();
    this.material.dispose();
  }
}
