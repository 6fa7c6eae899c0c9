/** Where the camera stands, from high in the sky to the beach. */

/**
 * @typedef {{x: number, y: number, z: number}} Vector
 * @typedef {{from: Vector, to: Vector}} Pose where the camera is, and what it looks at
 * @typedef {'Sky' | 'Bird' | 'Coast' | 'Shore' | 'Beach'} Preset
 *
 * @typedef {object} Stand what the presets go by
 * @property {number} width of the box in the world
 * @property {number} depth
 * @property {[number, number]} place on the shore: x and z
 * @property {[number, number]} seaward direction of open water there: x and z, of length 1
 * @property {(x: number, z: number) => number} height of the surface
 * @property {number} aspect of the picture: width over height
 */

export const PRESETS = Object.freeze(/** @type {Preset[]} */ (['Sky', 'Bird', 'Coast', 'Shore', 'Beach']));

/** Degrees, of the camera, from the lower to the upper border of the picture. */
export const FIELD = 42;

/** Degrees above the horizon, degrees to the side of the sea's direction, distance from the place on the shore. */
const NEAR = Object.freeze({ Coast: [25, 58, 44], Shore: [11, 74, 14] });
/** Of the one who stands on the beach: height of the eyes, how far inland, degrees to the side, how far down. */
const BEACH = Object.freeze({ eyes: 0.62, inland: 1.3, side: 32, down: 7 });
/** Degrees: height of the sun, and how far to the side of the sea's direction. */
const SUN = Object.freeze({ up: 34, side: 14 });
/** How far ahead one looks at from there, and what is turned around. */
const AHEAD = 12;

const radians = (/** @type {number} */ degrees) => (degrees * Math.PI) / 180;

/**
 * Distance from which a width and a height are seen whole.
 *
 * @param {number} width @param {number} height @param {number} aspect
 */
function whole(width, height, aspect) {
  const slope = Math.tan(radians(FIELD / 2));
  return Math.max(height / 2 / slope, width / 2 / slope / aspect);
}

/**
 * @param {Preset} preset
 * @param {Stand} stand
 * @returns {Pose}
 */
export function pose(preset, stand) {
  const { width, depth, aspect, height } = stand;
  if (preset === 'Sky') {
    const away = whole(width * 1.16, depth * 1.24, aspect);
    const tilt = radians(76);
    return { from: { x: 0, y: away * Math.sin(tilt), z: away * Math.cos(tilt) }, to: { x: 0, y: 0, z: 0.5 } };
  }
  const [sx, sz] = stand.seaward;
  if (preset === 'Bird') {
    const angle = Math.atan2(sx, sz) + radians(28);
    const away = whole(Math.hypot(width, depth) * 1.02, depth * 0.98, aspect) * 1.12;
    const up = radians(33);
    const flat = away * Math.cos(up);
    return {
      from: { x: flat * Math.sin(angle), y: away * Math.sin(up), z: flat * Math.cos(angle) },
      to: { x: 0, y: -2, z: 0 },
    };
  }
  const [px, pz] = stand.place;
  const sea = Math.atan2(sx, sz);
  if (preset === 'Beach') {
    const [x, z] = [px - sx * BEACH.inland, pz - sz * BEACH.inland];
    const eyes = Math.max(height(x, z), 0) + BEACH.eyes;
    const angle = sea + landSide(stand, BEACH.side) * radians(BEACH.side);
    const to = { x: x + AHEAD * Math.sin(angle), y: eyes - AHEAD * Math.tan(radians(BEACH.down)), z: z + AHEAD * Math.cos(angle) };
    return { from: { x, y: eyes, z }, to };
  }
  const [up, side, away] = NEAR[preset];
  const angle = sea - landSide(stand, side) * radians(side); // it looks back to where the land is
  const wide = away * Math.max(1, Math.min(1.5, 1 / aspect));
  const flat = wide * Math.cos(radians(up));
  const from = { x: px + flat * Math.sin(angle), y: wide * Math.sin(radians(up)), z: pz + flat * Math.cos(angle) };
  from.y = Math.max(from.y, height(from.x, from.z) + BEACH.eyes);
  return { from, to: { x: px, y: Math.min(1, height(px, pz)), z: pz } };
}

/**
 * Where the sun is, to glitter on the water that one sees from the beach.
 *
 * @param {Omit<Stand, 'aspect'>} stand
 * @returns {Vector} of length 1
 */
export function sunOver(stand) {
  const [sx, sz] = stand.seaward;
  const angle = Math.atan2(sx, sz) + landSide(stand, BEACH.side) * radians(SUN.side);
  const flat = Math.cos(radians(SUN.up));
  return { x: flat * Math.sin(angle), y: Math.sin(radians(SUN.up)), z: flat * Math.cos(angle) };
}

/**
 * To which side of the sea's direction more land is seen: 1 or -1.
 *
 * @param {Omit<Stand, 'aspect'>} stand @param {number} degrees
 */
function landSide({ place: [px, pz], seaward: [sx, sz], height, width }, degrees) {
  const land = [1, -1].map((sign) => {
    const angle = Math.atan2(sx, sz) + sign * radians(degrees);
    const tenth = width / 20;
    return [1, 2, 3, 4, 5, 6].reduce((sum, k) =>
      sum + Math.max(0, height(px + k * tenth * Math.sin(angle), pz + k * tenth * Math.cos(angle))), 0);
  });
  return land[0] >= land[1] ? 1 : -1;
}

/** @param {number} share of the way, in time */
const eased = (share) => share * share * share * (share * (6 * share - 15) + 10);

/**
 * On the way from one pose to another: around what is looked at, nearer by the same factor in the same time.
 *
 * @param {Pose} start @param {Pose} end
 * @param {number} share of the time, 0..1
 * @returns {Pose}
 */
export function between(start, end, share) {
  const part = eased(Math.min(Math.max(share, 0), 1));
  const mixed = (/** @type {number} */ a, /** @type {number} */ b) => a + (b - a) * part;
  const to = { x: mixed(start.to.x, end.to.x), y: mixed(start.to.y, end.to.y), z: mixed(start.to.z, end.to.z) };
  const [a, b] = [around(start), around(end)];
  const turn = ((((b.angle - a.angle + Math.PI) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) - Math.PI;
  const away = Math.exp(mixed(Math.log(a.away), Math.log(b.away)));
  const [angle, up] = [a.angle + turn * part, mixed(a.up, b.up)];
  const flat = away * Math.cos(up);
  return { from: { x: to.x + flat * Math.sin(angle), y: to.y + away * Math.sin(up), z: to.z + flat * Math.cos(angle) }, to };
}

/** @param {Pose} pose */
function around({ from, to }) {
  const [x, y, z] = [from.x - to.x, from.y - to.y, from.z - to.z];
  const away = Math.max(Math.hypot(x, y, z), 1e-6);
  return { away, angle: Math.atan2(x, z), up: Math.asin(Math.min(Math.max(y / away, -1), 1)) };
}
