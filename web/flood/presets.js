/** Poses of the camera for the page's views, from a plan to the one who stands at the water. */

/**
 * @typedef {{x: number, y: number, z: number}} Vector
 * @typedef {{from: Vector, to: Vector}} Pose position of the camera, and its target
 *
 * @typedef {object} View
 * @property {string} name
 * @property {'plan' | 'whole' | 'over' | 'far' | 'near' | 'eye'} kind of view: the whole box from above, or from the side;
 *   from the air, lower and lower; or from the ground
 * @property {[number, number]} place that is looked at, or where one stands: x and z
 * @property {[number, number]} toward direction of the water there: x and z, of length 1
 * @property {number} away distance of the camera
 * @property {() => number} above height of the highest water there, of all times
 *
 * @typedef {object} Stand the scene's dimensions that the presets depend on
 * @property {number} width of the box in the world
 * @property {number} depth
 * @property {number} low the box's lower end
 * @property {number} high its highest ground
 * @property {(x: number, z: number) => number} height of the surface, which changes with the water
 * @property {(x: number, z: number) => number} ground height of the ground, which does not
 * @property {number} aspect of what is free of the picture: width over height
 * @property {number} share of the picture's height that is free
 */

/** @typedef {Omit<Stand, 'aspect' | 'share' | 'low' | 'high'>} Fixed what of it does not change */

/** The views that every page has, toward the water. @param {[number, number]} toward @returns {View[]} */
export const wholes = (toward) => [
  { name: 'Plan', kind: 'plan', place: [0, 0], toward, away: 0, above: () => 0 },
  { name: 'Overview', kind: 'whole', place: [0, 0], toward, away: 0, above: () => 0 },
];

/** Degrees, of the camera, from the lower to the upper border of the picture. */
export const FIELD = 42;

/** Degrees above the horizon, degrees to the side of the water's direction, and how far out the middle is. */
const ABOVE = Object.freeze({ over: [36, 28, 0], far: [23, 56, 0.16], near: [11, 72, 0.18] });
/** Of the one who stands at the water: height of the eyes, how far from it, degrees to the side, how far down. */
const EYE = Object.freeze({ eyes: 0.62, inland: 1.3, side: 32, down: 7 });
/** The same for a picture that is higher than wide: along the shore, so that there is land in it. */
const TALL = Object.freeze({ side: 60, down: 9 });
/** Degrees: height of the sun, and how far to the side of the sea's direction. */
const SUN = Object.freeze({ up: 34, side: 14 });
/** Degrees above the horizon of the plan: at 90 no direction would be up. */
const STEEPEST = 89.99;
/** How much more than the box is seen where all of it is. */
const AROUND = 1.06;
/** How far ahead one looks at from there, and what is turned around. */
const AHEAD = 12;

const radians = (/** @type {number} */ degrees) => (degrees * Math.PI) / 180;

/**
 * Pose from which the whole box is seen, as large as it can be.
 *
 * @param {Stand} stand
 * @param {number} angle of the camera around the box, from the south to the east
 * @param {number} above the horizon
 * @returns {Pose}
 */
function whole({ width, depth, low, high, aspect, share }, angle, above) {
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  const back = [sin * Math.cos(above), Math.sin(above), cos * Math.cos(above)];
  const right = [cos, 0, -sin];
  const up = [-sin * Math.sin(above), Math.cos(above), -cos * Math.sin(above)];
  const along = (/** @type {number[]} */ axis, /** @type {number[]} */ corner) =>
    axis[0] * corner[0] + axis[1] * corner[1] + axis[2] * corner[2];
  const corners = [-width / 2, width / 2].flatMap((x) =>
    [low, high].flatMap((y) => [-depth / 2, depth / 2].map((z) => [x, y, z])));
  const slope = (Math.tan(radians(FIELD / 2)) * share) / AROUND;
  const fit = (/** @type {number[]} */ axis, /** @type {number} */ tangent) => {
    const reach = (/** @type {number} */ sign) =>
      Math.max(...corners.map((corner) => along(back, corner) * tangent + sign * along(axis, corner)));
    return { middle: (reach(1) - reach(-1)) / 2, away: (reach(1) + reach(-1)) / 2 / tangent };
  };
  const [across, over] = [fit(right, slope * aspect), fit(up, slope)];
  const away = Math.max(across.away, over.away);
  const [x, y, z] = [0, 1, 2].map((at) => right[at] * across.middle + up[at] * over.middle);
  return { from: { x: x + away * back[0], y: y + away * back[1], z: z + away * back[2] }, to: { x, y, z } };
}

/**
 * @param {View} view
 * @param {Stand} stand
 * @returns {Pose}
 */
export function pose(view, stand) {
  const { aspect, height } = stand;
  const { kind, place: [px, pz], toward: [sx, sz], above } = view;
  const sea = Math.atan2(sx, sz);
  if (kind === 'plan') return whole(stand, 0, radians(STEEPEST)); // and then without perspective
  if (kind === 'whole') return whole(stand, sea + radians(28), radians(30));
  if (kind === 'eye') {
    const [x, z] = [px - sx * EYE.inland, pz - sz * EYE.inland];
    const eyes = Math.max(height(x, z), height(px, pz), above()) + EYE.eyes;
    const { side, down } = aspect < 0.9 ? TALL : EYE;
    const angle = sea + landSide(view, stand, EYE.side) * radians(side);
    const lower = eyes - AHEAD * Math.tan(radians(down));
    const to = { x: x + AHEAD * Math.sin(angle), y: lower, z: z + AHEAD * Math.cos(angle) };
    return { from: { x, y: eyes, z }, to };
  }
  const [up, side, out] = ABOVE[kind];
  const [mx, mz] = [px + sx * out * view.away, pz + sz * out * view.away];
  const angle = sea - landSide(view, stand, side) * radians(side); // it looks back to where the land is
  const wide = view.away * Math.max(1, Math.min(1.5, 1 / aspect));
  const flat = wide * Math.cos(radians(up));
  const level = Math.max(height(mx, mz), above());
  const [x, z] = [mx + flat * Math.sin(angle), mz + flat * Math.cos(angle)];
  const y = Math.max(level + wide * Math.sin(radians(up)), height(x, z) + EYE.eyes);
  return { from: { x, y, z }, to: { x: mx, y: level, z: mz } };
}

/**
 * Half the height of a plan of the box, in world units, from the middle of what is free of the picture.
 *
 * @param {Stand} stand
 */
export function planHeight({ width, depth, aspect, share }) {
  return (AROUND / 2) * Math.max(depth, width / aspect) / share;
}

/**
 * Where the sun is, to glitter on the water that one sees in a view.
 *
 * @param {View} view
 * @param {Fixed} stand
 * @returns {Vector} of length 1
 */
export function sunOver(view, stand) {
  const [sx, sz] = view.toward;
  const angle = Math.atan2(sx, sz) + landSide(view, stand, EYE.side) * radians(SUN.side);
  const flat = Math.cos(radians(SUN.up));
  return { x: flat * Math.sin(angle), y: Math.sin(radians(SUN.up)), z: flat * Math.cos(angle) };
}

/** How much less ground below the highest water counts than land above it: where all land is low, it decides. */
const DROWNED = 0.01;

/**
 * To which side of the water's direction more land is seen, at all times the same: 1 or -1.
 *
 * @param {View} view @param {Fixed} stand @param {number} degrees
 */
function landSide({ place: [px, pz], toward: [sx, sz], above }, { ground, width }, degrees) {
  const land = [1, -1].map((sign) => {
    const angle = Math.atan2(sx, sz) + sign * radians(degrees);
    const tenth = width / 20;
    return [1, 2, 3, 4, 5, 6].reduce((sum, k) => {
      const over = ground(px + k * tenth * Math.sin(angle), pz + k * tenth * Math.cos(angle)) - above();
      return sum + (over > 0 ? over : DROWNED * over);
    }, 0);
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
  const from = { x: to.x + flat * Math.sin(angle), y: to.y + away * Math.sin(up), z: to.z + flat * Math.cos(angle) };
  return { from, to };
}

/** @param {Pose} pose */
function around({ from, to }) {
  const [x, y, z] = [from.x - to.x, from.y - to.y, from.z - to.z];
  const away = Math.max(Math.hypot(x, y, z), 1e-6);
  return { away, angle: Math.atan2(x, z), up: Math.asin(Math.min(Math.max(y / away, -1), 1)) };
}
