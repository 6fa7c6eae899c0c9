// The mesh of a part of a sphere: vertices are relative to its own middle, so that float32 suffices at every zoom.
import { BufferAttribute, BufferGeometry } from 'three';
import { cellsAt, lngLat } from '../tiles/grid.js';
import { onSphere } from './cover.js';

/** Distance that a skirt extends beyond its quad, as a fraction of the quad's side: about two pixels. */
const SKIRT = 1 / 256;

/** Start and direction of the skirts of a quad: south, north, east, west. */
const SKIRTS = /** @type {const} */ ([[0, SKIRT], [0, -SKIRT], [SKIRT, 0], [-SKIRT, 0]]);

/** Indices shared by patches of one kind. @type {Map<string, { inner: Uint32Array, around: Uint32Array }>} */
const INDICES = new Map();

/**
 * Vertices have a position and, as `tilePlace`, a position within the quad: 0..1 from its north-west corner. The skirt
 * continues beyond the sides, a little lower, and is only visible through cracks between quads whose vertices differ.
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
  const isNorth = y === 0;
  const isSouth = y === 2 ** z - 1;
  const count = cells + 1;
  const rows = count + Number(isNorth) + Number(isSouth);
  const vertices = count * (rows + SKIRTS.length);
  const positions = new Float32Array(3 * vertices);
  const places = new Float32Array(2 * vertices);
  const middle = /** @type {import('./cover.js').Vec3} */ (
    onSphere(...lngLat((x + 0.5) * side, (y + 0.5) * side)).map((part) => radius * part));
  // the place is a product of a part of the column and one of the row
  const column = (/** @type {number} */ a) => {
    const [sin, , cos] = onSphere(360 * ((x + a) * side - 0.5), 0);
    return [sin, cos];
  };
  const row = (/** @type {number} */ b) => onSphere(0, lngLat(0, (y + b) * side)[1]).slice(1);
  let filled = 0;
  const add = (/** @type {number[]} */ [sin, cos], /** @type {number[]} */ [up, out], /** @type {number} */ scale, /** @type {number} */ a, /** @type {number} */ b) => {
    positions[3 * filled] = scale * out * sin - middle[0];
    positions[3 * filled + 1] = scale * up - middle[1];
    positions[3 * filled + 2] = scale * out * cos - middle[2];
    places[2 * filled] = a;
    places[2 * filled++ + 1] = b;
  };
  const steps = Array.from({ length: count }, (_, k) => k / cells);
  const columns = steps.map(column);
  const pole = (/** @type {number} */ up, /** @type {number} */ b) =>
    steps.forEach((a, k) => add(columns[k], [up, 0], radius, a, b)); // the grid ends before the poles
  if (isNorth) pole(1, 0);
  for (const b of steps) {
    const here = row(b);
    for (let k = 0; k < count; k++) add(columns[k], here, radius, steps[k], b);
  }
  if (isSouth) pole(-1, 1);
  const rowsAt = steps.map(row);
  for (const [right, down] of SKIRTS) {
    const [beyondColumn, beyondRow] = right ? [column(Number(right > 0) + right), null] : [null, row(Number(down > 0) + down)];
    const [a, b] = [Number(right > 0) + right, Number(down > 0) + down];
    steps.forEach((step, k) => add(beyondColumn ?? columns[k], beyondRow ?? rowsAt[k], lower * radius, right ? a : step, down ? b : step));
  }
  const key = `${cells} ${isNorth} ${isSouth}`;
  const { inner, around } = INDICES.get(key) ?? indicesOf(cells, rows, Number(isNorth));
  INDICES.set(key, { inner, around });
  const [geometry, skirt] = [inner, around].map((index) => new BufferGeometry().setIndex(new BufferAttribute(index, 1)));
  for (const [name, values, size] of /** @type {const} */ ([['position', positions, 3], ['tilePlace', places, 2]])) {
    const attribute = new BufferAttribute(values, size);
    for (const made of [geometry, skirt]) made.setAttribute(name, attribute);
  }
  return { geometry, skirt, middle };
}

/**
 * @param {number} cells along a side
 * @param {number} rows of vertices, including those of the poles
 * @param {number} start the row at which the quad itself begins
 */
function indicesOf(cells, rows, start) {
  const count = cells + 1;
  /** @type {number[]} */
  const inner = [];
  /** @type {number[]} */
  const around = [];
  for (let row = 0; row + 1 < rows; row++) {
    for (let k = 0; k < cells; k++) {
      const first = row * count + k;
      inner.push(first, first + count, first + 1, first + 1, first + count, first + count + 1);
    }
  }
  SKIRTS.forEach(([right, down], number) => {
    const [first, next] = right ? [start * count + (right > 0 ? cells : 0), count] : [(start + (down > 0 ? cells : 0)) * count, 1];
    const isTurned = right > 0 || down < 0; // so that all look outwards
    for (let k = 0; k < cells; k++) {
      const top = [first + k * next, first + (k + 1) * next];
      const below = [(rows + number) * count + k, (rows + number) * count + k + 1];
      if (isTurned) for (const pair of [top, below]) pair.reverse();
      around.push(top[0], below[0], top[1], top[1], below[0], below[1]);
    }
  });
  return { inner: new Uint32Array(inner), around: new Uint32Array(around) };
}
