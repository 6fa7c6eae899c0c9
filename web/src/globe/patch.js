// The mesh of a part of a sphere: its vertices lie around its own middle, so that float32 serves at every zoom.
import { BufferGeometry, Float32BufferAttribute } from 'three';
import { lngLat } from '../tiles/grid.js';
import { CAP } from '../tiles/tile-shader.js';
import { onSphere } from './cover.js';

/** Cells along a side at zoom 0, and the fewest. */
const MOST = 128;
const FEWEST = 16;

/**
 * Vertices have a place and, as `tilePlace`, that within the quad: 0..1 from its north-west corner.
 *
 * @param {import('../tiles/grid.js').TileId} quad
 * @param {number} radius
 * @returns {{ geometry: BufferGeometry, middle: import('./cover.js').Vec3 }}
 */
export function patch({ z, x, y }, radius) {
  const cells = Math.max(MOST >> z, FEWEST);
  const side = 2 ** -z;
  const at = (/** @type {number} */ a, /** @type {number} */ b) => onSphere(...lngLat((x + a) * side, (y + b) * side)).map((part) => radius * part);
  const middle = /** @type {import('./cover.js').Vec3} */ (at(0.5, 0.5));
  /** @type {number[]} */
  const positions = [];
  /** @type {number[]} */
  const places = [];
  const add = (/** @type {number[]} */ point, /** @type {number} */ a, /** @type {number} */ b) => {
    positions.push(...point.map((part, k) => part - middle[k]));
    places.push(a, b);
  };
  const steps = Array.from({ length: cells + 1 }, (_, k) => k / cells);
  const rows = [...(y === 0 ? [-1] : []), ...steps, ...(y === 2 ** z - 1 ? [2] : [])];
  for (const b of rows) {
    for (const a of steps) {
      if (b < 0 || b > 1) add([0, b < 0 ? radius : -radius, 0], a, b < 0 ? CAP : 1 - CAP); // the grid ends before the poles
      else add(at(a, b), a, b);
    }
  }
  const indices = [];
  for (let row = 0; row + 1 < rows.length; row++) {
    for (let k = 0; k < cells; k++) {
      const first = row * (cells + 1) + k;
      indices.push(first, first + cells + 1, first + 1, first + 1, first + cells + 1, first + cells + 2);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
  geometry.setAttribute('tilePlace', new Float32BufferAttribute(places, 2));
  geometry.setIndex(indices);
  return { geometry, middle };
}
