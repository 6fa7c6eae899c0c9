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
const NEAR = Object.freeze({ Coast: [24, 52, 42], Shore: [13, 66, 13] });
/** Of the one who stands on the beach: height of the eyes, and how far inland. */
const EYES = 0.62;
const INLAND = 0.9;
const HORIZON = 14;

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
    const away = whole(width * 1.1, depth * 1.12, aspect);
    const tilt = radians(76);
    return { from: { x: 0, y: away * Math.sin(tilt), z: away * Math.cos(tilt) }, to: { x: 0, y: 0, z: 0.5 } };
  }
  const [sx, sz] = stand.seaward;
  if (preset === 'Bird') {
    const angle = Math.atan2(sx, sz) + radians(28);
    const away = whole(Math.hypot(width, depth) * 0.9, depth * 0.82, aspect) * 1.06;
    const up = radians(33);
    const flat = away * Math.cos(up);
    return {
      from: { x: flat * Math.sin(angle), y: away * Math.sin(up), z: flat * Math.cos(angle) },
      to: { x: 0, y: -2, z: 0 },
    };
  }
  const [px, pz] = stand.place;
  if (preset === 'Beach') {
    const [x, z] = [px - sx * INLAND, pz - sz * INLAND];
    const eyes = height(x, z) + EYES;
    const [tx, tz] = [px + sx * HORIZON, pz + sz * HORIZON];
    return { from: { x, y: eyes, z }, to: { x: tx, y: eyes - 1.1, z: tz } };
  }
  const [up, side, away] = NEAR[preset];
  const angle = Math.atan2(sx, sz) + radians(side);
  const wide = away * Math.max(1, Math.min(1.5, 1 / aspect));
  const flat = wide * Math.cos(radians(up));
  const from = { x: px + flat * Math.sin(angle), y: wide * Math.sin(radians(up)), z: pz + flat * Math.cos(angle) };
  from.y = Math.max(from.y, height(from.x, from.z) + EYES);
  return { from, to: { x: px, y: Math.min(1, height(px, pz)), z: pz } };
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
