// Gradients in linear light, as more stops of one in sRGB (SVG 2, 13.9); the same as Python's `vexture.svg.linear_light`.

/** @typedef {import('./paints.js').Color} Color */
/** @typedef {import('./paints.js').Stop} Stop */

/** Largest distance of a component from the curve at a few points between two stops: 0.5/255 in between. */
const BEND = 0.4 / 255;

/** Places between two stops where the distance is measured. */
const PARTS = [0.25, 0.5, 0.75];

/** @param {number} part @returns {number} a component of sRGB in linear light */
function decode(part) {
  return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
}

/** @param {number} part @returns {number} a component in linear light as sRGB */
function encode(part) {
  return part <= 0.0031308 ? 12.92 * part : Math.min(1.055 * part ** (1 / 2.4) - 0.055, 1);
}

/**
 * Stops, between which sRGB is interpolated, for ones between which linear light is.
 *
 * @param {Stop[]} stops
 * @param {number} most most stops of the result, unless there are more already
 * @returns {{ stops: Stop[], error: number }} the stops, and the error of a component: 0.5/255, or as large as necessary
 */
export function stopsInLinearLight(stops, most) {
  for (let bend = BEND; ; bend *= 2) {
    const found = stops.slice(0, 1);
    for (let k = 1; k < stops.length; k += 1) {
      if (stops[k].offset > stops[k - 1].offset) addHalves(stops[k - 1], stops[k], bend, found);
      found.push(stops[k]);
    }
    if (found.length <= Math.max(most, stops.length)) return { stops: found, error: (bend * 0.5) / 0.4 };
  }
}

/**
 * Add the stops that are needed between two, in order: each one in the middle of others.
 *
 * @param {Stop} before
 * @param {Stop} after
 * @param {number} bend
 * @param {Stop[]} found
 */
function addHalves(before, after, bend, found) {
  const middle = mixStops(before, after, 0.5);
  if (!(before.offset < middle.offset && middle.offset < after.offset && distance(before, after) > bend)) return;
  addHalves(before, middle, bend, found);
  found.push(middle);
  addHalves(middle, after, bend, found);
}

/**
 * @param {Stop} before
 * @param {Stop} after
 * @param {number} part
 * @returns {Stop} the stop between two, in linear light; opacity is interpolated as it is
 */
function mixStops(before, after, part) {
  const color = before.color.map((one, k) => encode(decode(one) + part * (decode(after.color[k]) - decode(one))));
  return {
    offset: before.offset + part * (after.offset - before.offset), color: /** @type {Color} */ (color),
    opacity: before.opacity + part * (after.opacity - before.opacity),
  };
}

/**
 * @param {Stop} before
 * @param {Stop} after
 * @returns {number} the largest distance of a component in linear light from the straight line between two stops
 */
function distance(before, after) {
  const away = PARTS.map((part) => {
    const { color } = mixStops(before, after, part);
    return Math.max(...color.map((one, k) => Math.abs(one - before.color[k] - part * (after.color[k] - before.color[k]))));
  });
  return Math.max(...away);
}
