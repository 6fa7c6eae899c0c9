/** The water: its surface over the ground, and its cross-section along the sides of the box. */
import { BufferGeometry, Group, Mesh, MeshBasicMaterial } from 'three';
import { applyVectorMask } from '../src/vector-mask.js';
import { gridGeometry, LEAST_RISE, wallGeometry } from './land.js';

/** @typedef {import('../src/vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('../src/vector-mask.js').VectorMask} VectorMask */
/** @typedef {import('../src/fold-texture.js').FoldTexture} FoldTexture */
/** @typedef {ReturnType<typeof import('../src/water/index.js').chooseWater>} Kind */

const LOOK = Object.freeze({
  waterColor: 0x0d6480, sunColor: 0x7f8f98, distortionScale: 1.8, size: 15, shallow: 0x62b7aa, clipBias: 0.002,
  sky: 0x86b2d6, horizon: 0xd3e2ec,
});
const FOAM = Object.freeze({ width: 0.015, period: 6 });
/** Place of the water among the shapes of a step's texture, which normally holds no other. */
export const WATER = 0;
/** Milliseconds of a cross-fade. */
const FADE = 900;
/** Shift of a wall's lower border into the shape: with equal uv at both borders the footprint would be empty. */
const INWARD = 1e-3;

export class Sea {
  #surface;
  #transform;
  #fold;
  /** @type {VectorMask | null} */
  #mask = null;
  /** @type {{to: VectorTexture, begin: number} | null} */
  #fading = null;
  #isFlat = false;

  /**
   * @param {Kind} Water
   * @param {import('./relief.js').Surface} surface
   * @param {{transform: import('three').Matrix3, fold: FoldTexture | null, sun: import('three').Vector3,
   *   mirror: number}} how from the box to the unit square; the fold of the shore; direction of the sun; side of
   *   the mirror's image in pixels
   */
  constructor(Water, surface, { transform, fold, sun, mirror }) {
    this.#surface = surface;
    this.#transform = transform;
    this.#fold = fold;
    this.water = new Water(gridGeometry(surface, (height) => Math.max(0, height)), null, {
      ...LOOK, root: WATER, transform, fold, foam: FOAM, sunDirection: sun, textureWidth: mirror, textureHeight: mirror,
    });
    const { material } = this.water;
    material.polygonOffset = true; // above the ground that it lies on, despite rounding
    material.polygonOffsetFactor = -1;
    material.polygonOffsetUnits = -4;
    this.water.rotation.x = -Math.PI / 2;
    this.walls = new Mesh(
      new BufferGeometry(),
      new MeshBasicMaterial({ color: 0x2f8199, transparent: true, opacity: 0.62, depthWrite: false }),
    );
    this.walls.visible = false;
    this.group = new Group().add(this.water, this.walls);
    this.raise();
  }

  /**
   * Show the water of a texture.
   *
   * @param {VectorTexture} texture
   * @param {boolean} fading over a while, from what is shown now
   */
  show(texture, fading) {
    if (this.#fading) this.#arrive();
    if (fading && this.water.texture) {
      this.water.fadeTo(texture);
      this.#fading = { to: texture, begin: performance.now() };
    } else {
      this.water.texture = texture;
      this.#wall(texture);
    }
  }

  #arrive() {
    const to = this.#fading?.to;
    this.#fading = null;
    if (!to) return;
    this.water.texture = to;
    this.#wall(to);
  }

  /** @param {VectorTexture} texture */
  #wall(texture) {
    if (this.#mask) this.#mask.texture = texture;
    else {
      const [transform, fold] = [this.#transform, this.#fold];
      this.#mask = applyVectorMask(this.walls.material, texture, { root: WATER, transform, fold, wrap: 'clamp' });
    }
    this.walls.visible = !this.#isFlat;
  }

  /**
   * Advance a fade.
   *
   * @returns {boolean} whether it goes on
   */
  advance() {
    if (!this.#fading) return false;
    const share = (performance.now() - this.#fading.begin) / FADE;
    if (share >= 1) this.#arrive();
    else this.water.fade = share;
    return true;
  }

  /** Follow the surface's exaggeration. */
  raise() {
    const { rise } = this.#surface;
    this.water.scale.z = Math.max(rise, LEAST_RISE);
    this.walls.geometry.dispose();
    this.walls.geometry = wallGeometry(this.#surface, ({ s, t, height }) => ({
      low: Math.min(0, height) * rise, high: 0, uvLow: [s + (0.5 - s) * INWARD, t + (0.5 - t) * INWARD], uvHigh: [s, t],
    }));
  }

  /** Time of waves and folds, in seconds. */
  set time(/** @type {number} */ seconds) {
    this.water.time = seconds;
    if (this.#mask) this.#mask.time = seconds;
  }

  /** Uniform colour of the water, or null. */
  set flat(/** @type {import('three').ColorRepresentation | null} */ color) {
    this.#isFlat = color !== null;
    this.water.flat = color;
    this.walls.visible = color === null && this.#mask !== null;
  }
}
