// The mesh of a part of the map: a grid in the tile's own units, with the caps of the poles where it reaches them.
import { cellsAt } from '../tiles/grid.js';

/** Units along a tile's side in MapLibre. */
export const EXTENT = 8192;

/** What MapLibre's projection takes for the poles. */
const NORTH = -32768;
const SOUTH = 32767;

/**
 * @param {import('../tiles/grid.js').TileId} quad
 * @returns {{ key: string, cells: number, north: boolean, south: boolean }} key: quads of one key share a mesh
 */
export function meshOf({ z, y }) {
  const cells = cellsAt(z);
  const north = y === 0;
  const south = y === 2 ** z - 1;
  return { key: `${cells} ${north} ${south}`, cells, north, south };
}

/**
 * @param {{ cells: number, north: boolean, south: boolean }} mesh
 * @returns {{ positions: Int16Array, indices: Uint16Array }}
 */
export function quadMesh({ cells, north, south }) {
  const steps = Array.from({ length: cells + 1 }, (_, k) => (EXTENT * k) / cells);
  const rows = [...(north ? [NORTH] : []), ...steps, ...(south ? [SOUTH] : [])];
  const positions = new Int16Array(rows.flatMap((y) => steps.flatMap((x) => [x, y])));
  const indices = [];
  const side = cells + 1;
  for (let row = 0; row + 1 < rows.length; row++) {
    for (let x = 0; x < cells; x++) {
      const at = row * side + x;
      indices.push(at, at + side, at + 1, at + 1, at + side, at + side + 1);
    }
  }
  return { positions, indices: new Uint16Array(indices) };
}
