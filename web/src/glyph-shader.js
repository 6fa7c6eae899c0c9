// The vertices of glyphs: each instance is a rectangle around one glyph, a pixel's reach larger on each side.
//
// A pixel is a box, so it shows something of a glyph up to half a pixel beside it. What half a pixel is in the plane of
// the glyph follows from the derivatives of the projection (the inverse of its Jacobian): at any size, turn and tilt the
// rectangle is as large as needed, and no larger, because each of its pixels costs time.
import { Vector2 } from 'three';
import { ROOT_ATTRIBUTE } from './attributes.js';

/** Names of the attributes of glyphs. */
export const GLYPH = Object.freeze({
  /** x, y and z of the lower left corner of the unit square of the shape, and its side. */
  place: 'vextureGlyph',
  /** The part of the unit square that is shown: left, bottom, right and top. */
  box: 'vextureBox',
  /** Quaternion of the rotation of the glyph around that corner. */
  turn: 'vextureTurn',
  root: ROOT_ATTRIBUTE,
});

/** Share by which the rim is wider than half a pixel, because a perspective is linear only nearly. */
export const MARGIN = 0.125;

/** Rims are at most so many times as wide as the glyph: more is seen only of glyphs seen from the edge. */
export const MOST_RIM = 4;

/** Width and height in pixels of what is drawn to; set before each draw. */
export const VIEWPORT = new Vector2(1, 1);

/** Lines outside of functions. */
export const GLYPH_DECLARED = `uniform vec2 vextureViewport;
attribute vec4 ${GLYPH.place};
attribute vec4 ${GLYPH.box};
attribute vec4 ${GLYPH.turn};
vec3 vextureTurned(vec3 at) {
  return at + 2.0 * cross(${GLYPH.turn}.xyz, cross(${GLYPH.turn}.xyz, at) + ${GLYPH.turn}.w * at);
}
`;

/** Lines that follow those that make `transformed` of the position, which is a corner of a unit square here. */
export const GLYPH_PLACED = `{
  vec2 vextureSize = (${GLYPH.box}.zw - ${GLYPH.box}.xy) * ${GLYPH.place}.w;
  vec2 vextureAt = mix(${GLYPH.box}.xy, ${GLYPH.box}.zw, position.xy) * ${GLYPH.place}.w;
  mat4 vextureToClip = projectionMatrix * modelViewMatrix;
  vec4 vextureAtClip = vextureToClip * vec4(${GLYPH.place}.xyz + vextureTurned(vec3(vextureAt, 0.0)), 1.0);
  vec4 vextureStepU = vextureToClip * vec4(vextureTurned(vec3(1.0, 0.0, 0.0)), 0.0);
  vec4 vextureStepV = vextureToClip * vec4(vextureTurned(vec3(0.0, 1.0, 0.0)), 0.0);
  vec2 vextureScale = 0.5 * vextureViewport / max(vextureAtClip.w, 1e-6);
  vec2 vextureMean = vextureAtClip.xy / max(vextureAtClip.w, 1e-6);
  vec2 vextureU = (vextureStepU.xy - vextureStepU.w * vextureMean) * vextureScale;
  vec2 vextureV = (vextureStepV.xy - vextureStepV.w * vextureMean) * vextureScale;
  float vextureDet = max(abs(vextureU.x * vextureV.y - vextureU.y * vextureV.x), 1e-12);
  vec2 vextureRim = ${(0.5 * (1 + MARGIN)).toFixed(4)} *
    vec2(abs(vextureV.x) + abs(vextureV.y), abs(vextureU.x) + abs(vextureU.y)) / vextureDet;
  vextureRim = min(vextureRim, ${MOST_RIM.toFixed(1)} * max(vextureSize.x, vextureSize.y));
  vextureAt += (2.0 * position.xy - 1.0) * vextureRim;
  transformed = ${GLYPH.place}.xyz + vextureTurned(vec3(vextureAt, 0.0));
  vextureUv = vextureAt / ${GLYPH.place}.w;
}
`;
