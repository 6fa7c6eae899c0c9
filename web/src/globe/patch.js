// The mesh of a part of a sphere: its vertices lie around its own middle, so that float32 serves at every zoom.
import { BufferGeometry, Float32BufferAttribute } from 'three';
import { cellsAt, lngLat } from '../tiles/grid.js';
import { CAP } from '../tiles/tile-shader.js';
import { onSphere } from './cover.js';

/** How far a skirt reaches beyond its quad, as a part of the quad's side: about two pixels. */
const SKIRT = 1 / 256;

/**
 * Vertices have a place and, as `tilePlace`, that within the quad: 0..1 from its north-west corner. The skirt goes on
 * beyond the sides, a little lower: it is seen only through the cracks between quads, whose vertices do not meet.
 *
 * @param {import('../tiles/grid.js').TileId} quad
 * @param {number} radius
 * @returns {{ geometry: BufferGeometry, skirt: BufferGeometry, middle: import('./cover.js').Vec3 }}
 */
export function patch({ z, x, y }, radius) {
  const cells = cellsAt(z);
  const side = 2 ** -z;
  const angle = (2 * Math.PI * side) / cells;
  const lower = 1 - angle ** 2 / 2 - (2 * Math.PI * side * SKIRT) / 2;
  const at = (/** @type {number} */ a, /** @type {number} */ b) => onSphere(...lngLat((x + a) * side, (y + b) * side)).map((part) => radius * part);
  const middle = /** @type {import('./cover.js').Vec3} */ (at(0.5, 0.5));
  /** @type {number[]} */
  const positions = [];
  /** @type {number[]} */
  const places = [];
  const add = (/** @type {number[]} */ point, /** @type {number} */ a, /** @type {number} */ b) => {
    positions.push(...point.map((part, k) => part - middle[k]));
    places.push(a, b);
    return places.length / 2 - 1;
  };
  const steps = Array.from({ length: cells + 1 }, (_, k) => k / cells);
  const rows = [...(y === 0 ? [-1] : []), ...steps, ...(y === 2 ** z - 1 ? [2] : [])];
  for (const b of rows) {
    for (const a of steps) {
      if (b < 0 || b > 1) add([0, b < 0 ? radius : -radius, 0], a, b < 0 ? CAP : 1 - CAP); // the grid ends before the poles
      else add(at(a, b), a, b);
    }
  }
  /** @type {number[]} */
  const indices = [];
  const wall = (/** @type {number} */ first, /** @type {number} */ next, /** @type {number} */ below, /** @type {number} */ other) =>
    indices.push(first, below, next, next, below, other);
  for (let row = 0; row + 1 < rows.length; row++) {
    for (let k = 0; k < cells; k++) {
      const first = row * (cells + 1) + k;
      wall(first, first + 1, first + cells + 1, first + cells + 2);
    }
  }
  const inner = indices.splice(0);
  const start = y === 0 ? cells + 1 : 0;
  for (const [edge, out] of /** @type {[(k: number) => [number, number], [number, number]][]} */ ([
    [(k) => [k, cells], [0, SKIRT]], [(k) => [cells - k, 0], [0, -SKIRT]],
    [(k) => [cells, cells - k], [SKIRT, 0]], [(k) => [0, k], [-SKIRT, 0]],
  ])) {
    const places_ = steps.map((_, k) => edge(k));
    const beyond = places_.map(([k, row]) => {
      const [a, b] = [k / cells + out[0], row / cells + out[1]];
      return add(at(a, b).map((part) => lower * part), a, b);
    });
    const top = places_.map(([k, row]) => start + row * (cells + 1) + k);
    for (let k = 0; k < cells; k++) wall(top[k], top[k + 1], beyond[k], beyond[k + 1]);
  }
  const [geometry, skirt] = [inner, indices].map((index) => {
    const made = new BufferGeometry();
    made.setIndex(index);
    return made;
  });
  for (const [name, values, size] of /** @type {[string, number[], number][]} */ ([['position', positions, 3], ['tilePlace', places, 2]])) {
    const attribute = new Float32BufferAttribute(values, size);
    for (const made of [geometry, skirt]) made.setAttribute(name, attribute);
  }
  return { geometry, skirt, middle };
}
