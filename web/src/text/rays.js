// Where rays meet texts: in their plane, on a cylinder, or along a curve.
import { Quaternion, Ray, Vector3 } from 'three';
import { alongCurve, isBent } from './bends.js';
import { glyphAt, shownPart } from './layout.js';

/** @import { TextLayout } from './layout.js' */
/** @import { ArrangementOptions } from './text-options.js' */

/**
 * @typedef {object} Meeting
 * @property {number} distance in units of the direction of the ray
 * @property {number} glyph -1 between glyphs
 */

/** Least part of a direction that is not along a plane or an axis. */
const LEAST = 1e-12;

const HIT = new Vector3(), OWN = new Ray(), TURN = new Quaternion();

/**
 * Find where a ray meets the block of a text.
 *
 * @param {Ray} ray in the space of the text
 * @param {TextLayout} layout
 * @param {readonly [number, number][]} boxes of each shape the part of its unit square that it fills
 * @param {ArrangementOptions} options
 * @returns {Meeting[]}
 */
export function meetText(ray, layout, boxes, { clipRect, curveRadius, curve }) {
  if (curve) return meetGlyphs(ray, layout, boxes, clipRect, alongCurve(curve, layout.lines[0]?.baseline ?? 0));
  const [left, bottom, right, top] = shownPart(layout.blockBounds, clipRect);
  const meet = (/** @type {number} */ distance, /** @type {number} */ x) => {
    const y = ray.at(distance, HIT).y;
    if (!(distance >= 0) || x < left || x > right || y < bottom || y > top) return [];
    return [{ distance, glyph: glyphAt(layout, boxes, x, y) }];
  };
  if (!isBent(curveRadius)) return flatDistances(ray).flatMap((distance) => meet(distance, ray.at(distance, HIT).x));
  const around = 2 * Math.PI * Math.abs(curveRadius);
  return cylinderDistances(ray, curveRadius).flatMap((distance) => {
    const { x, z } = ray.at(distance, HIT);
    const arc = curveRadius * Math.atan2(x / curveRadius, 1 - z / curveRadius);
    return meet(distance, arc + Math.ceil((left - arc) / around) * around); // the first turn of a text longer than one
  });
}

/** @param {Ray} ray */
function flatDistances({ origin, direction }) {
  return Math.abs(direction.z) < LEAST * direction.length() ? [] : [-origin.z / direction.z];
}

/** Where a ray meets a vertical cylinder that touches the plane at x = 0. @param {Ray} ray @param {number} radius */
function cylinderDistances({ origin: { x, z }, direction }, radius) {
  const square = direction.x ** 2 + direction.z ** 2, depth = z - radius;
  if (square < LEAST * direction.lengthSq()) return [];
  const half = -(x * direction.x + depth * direction.z) / square, rest = half * half - (x * x + depth * depth - radius * radius) / square;
  return rest < 0 ? [] : [half - Math.sqrt(rest), half + Math.sqrt(rest)];
}

/**
 * @param {Ray} ray
 * @param {TextLayout} layout
 * @param {readonly [number, number][]} boxes
 * @param {import('./layout.js').Rectangle | null} clip
 * @param {import('./bends.js').Bend} bend
 * @returns {Meeting[]}
 */
function meetGlyphs(ray, { shapes, places }, boxes, clip, bend) {
  return Array.from(shapes).flatMap((shape, glyph) => {
    const [start, base, side] = places.subarray(3 * glyph, 3 * glyph + 3), [width, height] = boxes[shape];
    const middle = start + 0.5 * width * side, { position, rotation } = bend(middle, base);
    TURN.fromArray(rotation).conjugate();
    OWN.origin.fromArray(position).sub(ray.origin).negate().applyQuaternion(TURN);
    OWN.direction.copy(ray.direction).applyQuaternion(TURN);
    const [left, bottom, right, top] = shownPart([start, base, start + width * side, base + height * side], clip);
    return flatDistances(OWN).flatMap((distance) => {
      OWN.at(distance, HIT);
      const x = HIT.x + middle, y = HIT.y + base;
      return distance >= 0 && x >= left && x <= right && y >= bottom && y <= top ? [{ distance, glyph }] : [];
    });
  });
}
