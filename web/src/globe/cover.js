// Finds the parts of a sphere that a camera sees, and the zoom of each. Plain numbers in float64, without three.js.
import { LEAD, TILE_SIZE, lngLat } from '../tiles/grid.js';

/**
 * @typedef {[number, number, number]} Vec3
 *
 * @typedef {object} Eye A camera, in the sphere's own coordinates.
 * @property {Vec3} position
 * @property {number[][]} planes of its frustum, inwards: nx ny nz d
 * @property {number} pixels CSS pixels covered by a length of 1 at a distance of 1
 *
 * @typedef {object} Ball A ball around a part of the sphere.
 * @property {Vec3} centre
 * @property {number} radius
 */

/** Fractions of a quad's sides at which it is sampled. */
const SAMPLES = [0, 0.25, 0.5, 0.75, 1];

/** Largest zoom, at which a pixel is a millimetre. */
const MOST_ZOOM = 27;

/**
 * Convert a place to the sphere of radius 1: y towards the north pole, z towards 0 degrees.
 *
 * @param {number} lng degrees
 * @param {number} lat degrees
 * @returns {Vec3}
 */
export function onSphere(lng, lat) {
  const [a, b] = [(lng * Math.PI) / 180, (lat * Math.PI) / 180];
  return [Math.cos(b) * Math.sin(a), Math.sin(b), Math.cos(b) * Math.cos(a)];
}

/**
 * Make a ball around a quad; the first and last rows include the poles.
 *
 * @param {import('../tiles/grid.js').TileId} quad
 * @returns {Ball}
 */
export function ballOf({ z, x, y }) {
  const side = 2 ** -z;
  const points = SAMPLES.flatMap((b) => SAMPLES.map((a) => onSphere(...lngLat((x + a) * side, (y + b) * side))));
  if (y === 0) points.push([0, 1, 0]);
  if (y === 2 ** z - 1) points.push([0, -1, 0]);
  const centre = /** @type {Vec3} */ ([0, 1, 2].map((k) => points.reduce((sum, point) => sum + point[k] / points.length, 0)));
  const reach = Math.max(...points.map((point) => between(point, centre)));
  return { centre, radius: z < 2 ? 2 : 1.1 * reach };
}

/** @param {number[]} one @param {number[]} other */
const between = (one, other) => Math.hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);

/**
 * Return whether part of a ball is in the frustum, and in front of the horizon.
 *
 * @param {Ball} ball
 * @param {Eye} eye
 */
function isSeen({ centre, radius }, { position, planes }) {
  const isBeyond = planes.some(([x, y, z, d]) => x * centre[0] + y * centre[1] + z * centre[2] + d < -radius);
  if (isBeyond) return false;
  const facing = position[0] * centre[0] + position[1] * centre[1] + position[2] * centre[2];
  return facing + radius * Math.hypot(...position) >= 1; // the plane of the horizon
}

/**
 * Find the quads that cover what a camera sees, each about as large on the screen as a tile at its own zoom.
 *
 * @param {Eye} eye
 * @returns {import('../tiles/choose.js').Quad[]}
 */
export function cover(eye) {
  /** @type {import('../tiles/choose.js').Quad[]} */
  const quads = [];
  const visit = (/** @type {import('../tiles/grid.js').TileId} */ quad) => {
    const ball = ballOf(quad);
    if (!isSeen(ball, eye)) return;
    const distance = between(eye.position, ball.centre);
    const middle = lngLat(0, (quad.y + 0.5) * 2 ** -quad.z)[1];
    const nearest = Math.max(distance - ball.radius, Math.hypot(...eye.position) - 1, 1e-9);
    const size = (2 * Math.PI * Math.cos((middle * Math.PI) / 180) * 2 ** -quad.z * eye.pixels) / nearest;
    if (quad.z >= MOST_ZOOM || (quad.z >= 2 && size < 2 * TILE_SIZE * 2 ** -LEAD)) {
      quads.push({ ...quad, distance });
      return;
    }
    for (const [x, y] of [[0, 0], [1, 0], [0, 1], [1, 1]]) visit({ z: quad.z + 1, x: 2 * quad.x + x, y: 2 * quad.y + y });
  };
  visit({ z: 0, x: 0, y: 0 });
  return quads;
}
