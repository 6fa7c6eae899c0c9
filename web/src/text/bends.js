// Texts that are not in a plane: on a cylinder, or along a curve.
import { Matrix4, Quaternion, Vector3 } from 'three';

/** @import { Frame } from './glyph-geometry.js' */

/** @typedef {(x: number, y: number) => Frame} Bend place and rotation of what is at a point of the plane */

/** Whether a radius is that of a cylinder: 0 and infinity stand for none. @param {number} radius */
export const isBent = (radius) => radius !== 0 && Number.isFinite(radius);

/**
 * On a vertical cylinder that touches the plane at x = 0.
 *
 * @param {number} radius above 0 its axis is in front of the plane
 * @returns {Bend}
 */
export function onCylinder(radius) {
  return (x, y) => {
    const angle = x / radius;
    return {
      position: [radius * Math.sin(angle), y, radius * (1 - Math.cos(angle))],
      rotation: [0, Math.sin(-angle / 2), 0, Math.cos(angle / 2)],
    };
  };
}

const UP = new Vector3(0, 0, 1);

/**
 * Along a curve, whose length is the x of the plane; letters stand on it, and face the z axis as well as they can.
 *
 * @param {import('three').Curve<any>} curve of 2 or 3 dimensions; before its start and after its end it goes on straight
 * @param {number} baseline y that is on the curve
 * @returns {Bend}
 */
export function alongCurve(curve, baseline) {
  const length = curve.getLength();
  const basis = new Matrix4(), turn = new Quaternion();
  return (x, y) => {
    const part = Math.min(Math.max(length > 0 ? x / length : 0, 0), 1);
    const point = curve.getPointAt(part), ahead = curve.getTangentAt(part);
    const tangent = new Vector3(ahead.x, ahead.y, ahead.z ?? 0).normalize();
    const up = UP.clone().cross(tangent);
    if (up.lengthSq() < 1e-12) up.set(0, 1, 0); // the curve runs along the z axis
    up.normalize();
    const front = tangent.clone().cross(up);
    basis.makeBasis(tangent, up, front);
    turn.setFromRotationMatrix(basis);
    const beyond = x - part * length, above = y - baseline;
    return {
      position: [
        point.x + beyond * tangent.x + above * up.x,
        point.y + beyond * tangent.y + above * up.y,
        (point.z ?? 0) + beyond * tangent.z + above * up.z,
      ],
      rotation: [turn.x, turn.y, turn.z, turn.w],
    };
  };
}
