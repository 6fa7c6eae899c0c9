/** The water: its surface over the ground, and its cross-section along the sides of the box. */
import {
  BufferGeometry, DataTexture, DataUtils, Group, HalfFloatType, LinearFilter, Mesh, MeshBasicMaterial, RGFormat,
} from 'three';
import { VectorMaterial } from '../src/vector-material.js';
import { applyVectorMask } from '../src/vector-mask.js';
import { gridGeometry, LEAST_RISE, wallGeometry } from './land.js';
import { mixedLevels } from './levels.js';
import { OPACITY } from './shades.js';

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
/** Samples of a pixel of the mirror's image: without them hills have steps in calm water. */
const SMOOTH = 4;
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
  /** @type {{to: VectorTexture, begin: number, levels: [Float32Array | null, Float32Array | null]} | null} */
  #fading = null;
  #openness;
  #fields;
  /** @type {Mesh<BufferGeometry, VectorMaterial>} */
  #map;
  /** What the colours of the water are of; null: its depth. @type {Float32Array | null} */
  #values = null;
  #isFlat = false;

  /**
   * @param {Kind} Water
   * @param {import('./relief.js').Surface} surface
   * @param {{transform: import('three').Matrix3, fold: FoldTexture | null, sun: import('three').Vector3,
   *   mirror: number, openness: Float32Array}} how from the box to the unit square; the fold of the shore; direction of the
   *   sun; side of the mirror's image in pixels; where waves are, 0..1 on the relief's grid
   */
  constructor(Water, surface, { transform, fold, sun, mirror, openness }) {
    this.#surface = surface;
    this.#transform = transform;
    this.#fold = fold;
    this.#openness = openness;
    const { columns, rows } = surface.relief;
    this.#fields = new DataTexture(new Uint16Array(2 * columns * rows), columns, rows, RGFormat, HalfFloatType);
    this.#fields.magFilter = this.#fields.minFilter = LinearFilter;
    this.water = new Water(gridGeometry(surface, surface.tops), null, {
      ...LOOK, fields: this.#fields, root: WATER, transform, fold, foam: FOAM, sunDirection: sun, textureWidth: mirror, textureHeight: mirror,
    });
    const mirrored = this.water.material.uniforms.mirrorSampler?.value; // the simple water has none
    if (mirrored) mirrored.renderTarget.samples = SMOOTH;
    this.#map = new Mesh(this.water.geometry, new VectorMaterial({
      mode: 'paint', root: WATER, transform, wrap: 'clamp', transparent: true, opacity: OPACITY, depthWrite: false,
      toneMapped: false,
    }));
    for (const { material, rotation } of [this.water, this.#map]) {
      material.polygonOffset = true; // above the ground that it lies on, despite rounding
      material.polygonOffsetFactor = -1;
      material.polygonOffsetUnits = -4;
      rotation.x = -Math.PI / 2;
    }
    this.#map.visible = false;
    this.walls = new Mesh(
      new BufferGeometry(),
      new MeshBasicMaterial({ color: 0x2f8199, transparent: true, opacity: 0.62, depthWrite: false }),
    );
    this.walls.visible = false;
    this.group = new Group().add(this.water, this.#map, this.walls);
    this.raise();
  }

  /**
   * Show the water of a texture.
   *
   * @param {VectorTexture} texture
   * @param {Float32Array | null} levels of its water
   * @param {boolean} fading over a while, from what is shown now
   */
  show(texture, levels, fading) {
    if (this.#fading) this.#arrive();
    if (fading && this.water.texture) {
      this.water.fadeTo(texture);
      this.#fading = { to: texture, begin: performance.now(), levels: [this.#surface.levels, levels] };
    } else {
      this.water.texture = texture;
      this.#level(levels);
      this.#wall(texture);
    }
  }

  /**
   * Colour the water by its depth or by other values on the relief's grid; null: as water looks.
   *
   * @param {import('../src/water/fields.js').DepthColors | null} colors
   * @param {Float32Array | null} [values]
   */
  color(colors, values = null) {
    this.#values = values;
    this.water.depthColors = colors;
    this.#level(this.#surface.levels);
  }

  /** Show a planar map of the classes of its depth in place of the water; null: the water. */
  set classes(/** @type {VectorTexture | null} */ texture) {
    const { material } = this.#map;
    if (material.texture !== texture) material.texture?.dispose(); // what is shown again is uploaded again
    material.texture = texture;
    this.#choose();
  }

  get classes() {
    return /** @type {VectorTexture | null} */ (this.#map.material.texture);
  }

  /** Show the map, if there is one, or the water. */
  #choose() {
    this.#map.visible = this.#map.material.texture !== null && !this.#isFlat;
    this.water.visible = !this.#map.visible;
  }

  /** Let the water stand at these levels. @param {Float32Array | null} levels */
  #level(levels) {
    this.#surface.levels = levels;
    const { tops, relief: { columns, rows, heights } } = this.#surface;
    const { position } = this.water.geometry.attributes;
    const data = /** @type {Uint16Array} */ (this.#fields.image.data);
    for (let row = 0, at = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++, at++) {
        position.setZ(at, tops[at]);
        const to = 2 * ((rows - 1 - row) * columns + column); // a texture's first row is the southernmost
        const level = levels ? levels[at] : 0;
        const depth = Number.isNaN(level) ? 0 : level - heights[at]; // below 0 in walls, so that no shallows are at them
        data[to] = DataUtils.toHalfFloat(this.#values ? this.#values[at] || 0 : depth);
        data[to + 1] = DataUtils.toHalfFloat(this.#openness[at]);
      }
    }
    position.needsUpdate = true;
    this.#fields.needsUpdate = true;
  }

  #arrive() {
    const fading = this.#fading;
    this.#fading = null;
    if (!fading) return;
    const { to, levels } = fading;
    this.water.texture = to;
    this.#level(levels[1]);
    this.#wall(to);
  }

  /** @param {VectorTexture} texture */
  #wall(texture) {
    this.#raiseWalls();
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
    else {
      this.water.fade = share;
      const [from, to] = this.#fading.levels;
      if (from && to) this.#level(mixedLevels(from, to, share));
    }
    return true;
  }

  /** Follow the surface's exaggeration. */
  raise() {
    this.water.scale.z = this.#map.scale.z = Math.max(this.#surface.rise, LEAST_RISE);
    this.#raiseWalls();
  }

  #raiseWalls() {
    const { rise, tops } = this.#surface;
    this.walls.geometry.dispose();
    this.walls.geometry = wallGeometry(this.#surface, ({ s, t, height, at }) => ({
      low: height * rise, high: tops[at] * rise, uvLow: [s + (0.5 - s) * INWARD, t + (0.5 - t) * INWARD], uvHigh: [s, t],
    }));
  }

  /** Mirror at the level of the water at a place of the box or near it. @param {number} s @param {number} t */
  mirrorAt(s, t) {
    this.water.mirrorHeight = this.#surface.levelNear(s, t) * this.#surface.rise;
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
    this.#choose();
  }
}
