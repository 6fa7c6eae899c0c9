/** The water: its surface over the ground, and what is seen of it along the cut sides. */
import { BufferGeometry, Color, Group, Matrix3, Mesh, MeshBasicMaterial, MeshPhongMaterial } from 'three';
import { applyVectorMask } from '../src/vector-mask.js';
import { gridGeometry, wallGeometry } from './land.js';

/** @typedef {import('../src/vector-texture.js').VectorTexture} VectorTexture */

/** Water drawn over the ground that it lies on, whatever the rounding. */
const OVER = Object.freeze({ polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 });

export class Sea {
  #surface;
  /** @type {VectorTexture | null} */
  #texture = null;

  /**
   * @param {import('./relief.js').Surface} surface
   * @param {Matrix3} transform from the box to the unit square
   */
  constructor(surface, transform) {
    this.#surface = surface;
    this.transform = transform;
    this.mesh = new Mesh(
      gridGeometry(surface, (height) => Math.max(0, height)),
      new MeshPhongMaterial({ color: 0x2f7f9d, transparent: true, opacity: 0.9, shininess: 90, ...OVER }),
    );
    this.mesh.rotation.x = -Math.PI / 2;
    this.walls = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ color: 0x3b8ea8, transparent: true, opacity: 0.5 }));
    this.group = new Group().add(this.mesh, this.walls);
    this.raise();
  }

  /** @param {VectorTexture | null} texture */
  show(texture) {
    this.#texture = texture;
    this.group.visible = texture !== null;
    if (!texture) return;
    for (const { material } of [this.mesh, this.walls]) {
      if (material.userData.mask) material.userData.mask.texture = texture;
      else material.userData.mask = applyVectorMask(material, texture, { transform: this.transform, wrap: 'clamp' });
    }
  }

  raise() {
    const { rise } = this.#surface;
    this.mesh.scale.z = Math.max(rise, 1e-6);
    this.walls.geometry.dispose();
    this.walls.geometry = wallGeometry(this.#surface, ({ s, t, height }) => {
      const inward = [s + (0.5 - s) * 1e-3, t + (0.5 - t) * 1e-3];
      return { low: Math.min(0, height) * rise, high: 0, uvLow: /** @type {[number, number]} */ (inward), uvHigh: [s, t] };
    });
  }

  /** Seconds, of waves and folds. */
  set time(/** @type {number} */ seconds) {
    void seconds;
  }

  /** @param {Color | null} color */
  set flat(color) {
    void color;
    this.walls.visible = color === null;
  }
}
