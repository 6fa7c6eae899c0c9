// The grid of Web Mercator tiles, XYZ: which tile holds which, and where in a tile's square a place lies. Plain numbers.

/**
 * @typedef {object} TileId A tile of the grid.
 * @property {number} z zoom
 * @property {number} x column, from the west
 * @property {number} y row, from the north
 */

/** Greatest latitude of the grid, in degrees. */
export const MOST_LATITUDE = (360 / Math.PI) * Math.atan(Math.exp(Math.PI)) - 90;

/** How far above the view's zoom the tiles' own may be. */
export const LEAD = 0.25;

/** CSS pixels along a tile's side at its own zoom. */
export const TILE_SIZE = 512;

/** Cells along a side of a quad's mesh at zoom 0, halved every second zoom as the globe flattens, and the most and the fewest. */
const CELLS = 512;
const MOST_CELLS = 192;
const FEWEST_CELLS = 16;

/**
 * Cells along a side of the mesh of a quad on a sphere, between whose vertices the map is linear: it is off by less than a
 * hundredth of a pixel, and by a fiftieth at zoom 0.
 *
 * @param {number} z zoom of the quad
 */
export const cellsAt = (z) => Math.min(Math.max(CELLS >> Math.min(Math.ceil(z / 2), 30), FEWEST_CELLS), MOST_CELLS);

/** Name of a tile in maps. @param {TileId} tile */
export const keyOf = ({ z, x, y }) => `${z}/${x}/${y}`;

/**
 * The tile of a lower zoom that holds a tile.
 *
 * @param {TileId} tile
 * @param {number} z at most the tile's own
 * @returns {TileId}
 */
export function ancestor(tile, z) {
  const side = 2 ** (tile.z - z);
  return { z, x: Math.floor(tile.x / side), y: Math.floor(tile.y / side) };
}

/**
 * The zooms of a pyramid that lead to a tile, the lowest first.
 *
 * @param {readonly number[]} zooms that the pyramid has, rising
 * @param {number} z
 */
export const zoomsTo = (zooms, z) => zooms.filter((zoom) => zoom <= z);

/**
 * A place in Web Mercator, each axis 0..1 from the north-west corner; the latitude is held within the grid, and in a tile of it.
 *
 * @param {number} lng degrees
 * @param {number} lat degrees
 * @returns {[number, number]}
 */
export function mercator(lng, lat) {
  const held = (Math.PI / 180) * Math.min(Math.max(lat, -MOST_LATITUDE), MOST_LATITUDE);
  const x = lng / 360 + 0.5;
  const y = 0.5 - Math.asinh(Math.tan(held)) / (2 * Math.PI);
  return [x - Math.floor(x), Math.min(Math.max(y, 2 ** -32), 1 - 2 ** -32)];
}

/**
 * Longitude and latitude of a place in Web Mercator, in degrees.
 *
 * @param {number} x
 * @param {number} y
 * @returns {[number, number]}
 */
export const lngLat = (x, y) => [360 * (x - 0.5), (180 / Math.PI) * Math.atan(Math.sinh(Math.PI * (1 - 2 * y)))];

/**
 * Where the north-west corner of a quad lies in the unit square of a tile's texture, and the length of its side there.
 *
 * @param {TileId} quad the tile itself, or one in it
 * @param {TileId} tile
 * @param {number} margin by which the texture is wider than the tile, as a part of the tile's side
 * @returns {{ u: number, v: number, side: number }} v upwards
 */
export function placeIn(quad, tile, margin) {
  const parts = 2 ** (quad.z - tile.z);
  const whole = 1 + 2 * margin;
  const u = ((quad.x - parts * tile.x) / parts + margin) / whole;
  const v = 1 - ((quad.y - parts * tile.y) / parts + margin) / whole;
  return { u, v, side: 1 / (parts * whole) };
}

/**
 * Where a place of Web Mercator lies in the unit square of a tile's texture.
 *
 * @param {number} x
 * @param {number} y
 * @param {TileId} tile
 * @param {number} margin
 * @returns {[number, number]} v upwards
 */
export function squareOf(x, y, tile, margin) {
  const parts = 2 ** tile.z;
  const whole = 1 + 2 * margin;
  return [(x * parts - tile.x + margin) / whole, 1 - (y * parts - tile.y + margin) / whole];
}

/**
 * A number of 0..1 as fixed point, which floats of shaders cannot hold, and what is left.
 *
 * @param {number} value
 * @returns {[number, number]} a whole number of 2^-32, and the rest as a part of 1
 */
export function fixed(value) {
  const scaled = value * 2 ** 32;
  const whole = Math.min(Math.max(Math.floor(scaled), 0), 2 ** 32 - 1);
  return [whole, (scaled - whole) / 2 ** 32];
}
