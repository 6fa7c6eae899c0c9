/** The ground: its surface, and the sides of the cut-out box. */
import {
  BufferAttribute, BufferGeometry, FrontSide, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial,
} from 'three';
import { earthTexture } from './canvas-textures.js';
import { addGrain } from './grain.js';

/** @typedef {import('./relief.js').Surface} Surface */

/** World units of earth below the lowest ground. */
export const BASE = 4;
/** World units of depth that the picture of the earth shows. */
const LAYERS = 16;
/** World units along a side after which that picture comes again. */
const REPEAT = 50;
/** Least exaggeration: at 0 the ground would have no normals. */
export const LEAST_RISE = 1e-6;

/**
 * A grid over the box, x east, y north, z up in metres; uv are 0..1 over the box.
 *
 * @param {Surface} surface
 * @param {Float32Array} raised height of each sample in metres
 */
export function gridGeometry({ relief, places }, raised) {
  const { columns, rows } = relief;
  const positions = new Float32Array(columns * rows * 3);
  const uvs = new Float32Array(columns * rows * 2);
  for (let row = 0, at = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++, at++) {
      const [s, t] = [column / (columns - 1), 1 - row / (rows - 1)];
      const [x, z] = places.toWorld(s, t);
      positions.set([x, -z, raised[at]], 3 * at);
      uvs.set([s, t], 2 * at);
    }
  }
  const index = new Uint32Array((columns - 1) * (rows - 1) * 6);
  for (let row = 0, at = 0; row < rows - 1; row++) {
    for (let column = 0; column < columns - 1; column++, at += 6) {
      const a = row * columns + column;
      const [b, c, d] = [a + 1, a + columns, a + columns + 1];
      index.set([a, c, b, b, c, d], at);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeVertexNormals();
  return geometry;
}

/**
 * Samples of the relief along the border, counter-clockwise as seen from above, from the south-west.
 *
 * @param {import('./relief.js').Relief} relief
 * @returns {{s: number, t: number, height: number, side: number, at: number}[]} four sides, each with both its corners
 */
export function border({ columns, rows, heights }) {
  const sample = (/** @type {number} */ column, /** @type {number} */ row, /** @type {number} */ side) => ({
    s: column / (columns - 1), t: 1 - row / (rows - 1), height: heights[row * columns + column], side,
    at: row * columns + column,
  });
  const across = [...Array(columns).keys()];
  const down = [...Array(rows).keys()];
  return [
    ...across.map((column) => sample(column, rows - 1, 0)),
    ...down.map((row) => sample(columns - 1, rows - 1 - row, 1)),
    ...across.map((column) => sample(columns - 1 - column, 0, 2)),
    ...down.map((row) => sample(0, row, 3)),
  ];
}

/**
 * Walls along the border, in the world.
 *
 * @param {Surface} surface
 * @param {(sample: ReturnType<typeof border>[number], along: number) =>
 *   {low: number, high: number, uvLow: [number, number], uvHigh: [number, number]}} wall
 */
export function wallGeometry({ relief, places }, wall) {
  const samples = border(relief);
  const positions = new Float32Array(samples.length * 6);
  const uvs = new Float32Array(samples.length * 4);
  const normals = new Float32Array(samples.length * 6);
  /** @type {number[]} */
  const index = [];
  let along = 0;
  let before = /** @type {[number, number] | null} */ (null);
  samples.forEach((sample, at) => {
    const [x, z] = places.toWorld(sample.s, sample.t);
    if (before) along += Math.hypot(x - before[0], z - before[1]);
    before = [x, z];
    const { low, high, uvLow, uvHigh } = wall(sample, along);
    positions.set([x, low, z, x, high, z], 6 * at);
    uvs.set([...uvLow, ...uvHigh], 4 * at);
    const out = [[0, 0, 1], [1, 0, 0], [0, 0, -1], [-1, 0, 0]][sample.side];
    normals.set([...out, ...out], 6 * at);
    const [a, b, c, d] = [2 * at, 2 * at + 1, 2 * at + 2, 2 * at + 3];
    if (samples[at + 1]?.side === sample.side) index.push(a, c, b, b, c, d);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
  geometry.setIndex(index);
  return geometry;
}

export class Land {
  #surface;
  #material;
  #flat = new MeshBasicMaterial({ color: 0x000000, side: FrontSide });
  #earth = new MeshLambertMaterial({ map: earthTexture() });

  /**
   * @param {Surface} surface
   * @param {import('three').Texture | null} picture of the ground
   */
  constructor(surface, picture) {
    this.#surface = surface;
    this.#material = new MeshLambertMaterial(picture ? { map: picture } : { color: 0xcbb58a });
    if (picture) addGrain(this.#material);
    /** @type {Mesh<BufferGeometry, import('three').Material>} */
    this.mesh = new Mesh(gridGeometry(surface, surface.relief.heights), this.#material);
    this.mesh.rotation.x = -Math.PI / 2;
    this.sides = new Mesh(new BufferGeometry(), this.#earth);
    this.group = new Group().add(this.mesh, this.sides);
    this.raise();
  }

  /** Height of the sides' lower border in the world. */
  get floor() {
    return this.#surface.relief.lowest * this.#surface.rise - BASE;
  }

  /** Stand as high as the surface says. */
  raise() {
    const { rise } = this.#surface;
    const { floor } = this;
    this.mesh.scale.z = Math.max(rise, LEAST_RISE);
    this.sides.geometry.dispose();
    this.sides.geometry = wallGeometry(this.#surface, ({ height }, along) => {
      const high = height * rise;
      return {
        low: floor, high, uvLow: [along / REPEAT, 1 - (high - floor) / LAYERS], uvHigh: [along / REPEAT, 1],
      };
    });
  }

  /** One colour and nothing else. @param {boolean} wanted */
  set flat(wanted) {
    this.mesh.material = wanted ? this.#flat : this.#material;
    this.sides.visible = !wanted;
  }
}
