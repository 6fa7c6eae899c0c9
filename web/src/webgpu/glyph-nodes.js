// The vertices of glyphs as nodes: what `glyph-shader.js` says in GLSL.
import { Fn, abs, attribute, cameraProjectionMatrix, cross, float, max, min, mix, modelViewMatrix, positionGeometry, screenSize, varying, vec2, vec3, vec4 } from 'three/tsl';
import { GLYPH, MARGIN, MOST_RIM } from '../glyph-shader.js';

/** @typedef {any} Node three.js's types know few of the methods of nodes */

/** @param {string} name @returns {Node} */
const glyphAttribute = (name) => attribute(name, 'vec4');

/** @param {Node} turn quaternion @param {Node} at @returns {Node} */
const turned = (turn, at) => at.add(cross(turn.xyz, cross(turn.xyz, at).add(turn.w.mul(at))).mul(2));

/** Place of a vertex in its glyph: a corner of the glyph's box, moved outwards by what half a pixel is there. */
const movedCorner = Fn(() => {
  const place = glyphAttribute(GLYPH.place), box = glyphAttribute(GLYPH.box), turn = glyphAttribute(GLYPH.turn);
  const corner = /** @type {Node} */ (positionGeometry).xy;
  const size = box.zw.sub(box.xy).mul(place.w);
  const at = /** @type {Node} */ (mix(box.xy, box.zw, corner).mul(place.w).toVar());
  const toClip = /** @type {Node} */ (cameraProjectionMatrix).mul(modelViewMatrix);
  const atClip = toClip.mul(vec4(place.xyz.add(turned(turn, vec3(at, 0))), 1)).toVar();
  const depth = max(atClip.w, 1e-6).toVar();
  const step = (/** @type {Node} */ along) => {
    const clip = toClip.mul(vec4(turned(turn, along), 0)).toVar();
    return clip.xy.sub(atClip.xy.mul(clip.w).div(depth)).mul(screenSize).mul(0.5).div(depth).toVar();
  };
  const u = step(vec3(1, 0, 0)), v = step(vec3(0, 1, 0));
  const area = max(abs(u.x.mul(v.y).sub(u.y.mul(v.x))), 1e-12);
  const rim = vec2(abs(v.x).add(abs(v.y)), abs(u.x).add(abs(u.y))).mul(0.5 * (1 + MARGIN)).div(area);
  const most = max(size.x, size.y).mul(MOST_RIM);
  return at.add(corner.mul(2).sub(1).mul(min(rim, vec2(/** @type {Node} */ (float(most))))));
});

/**
 * Nodes of the vertices of glyphs.
 *
 * @returns {{ position: Node, uv: Node }} position in the object, and position in the unit square of the glyph's shape
 */
export function glyphNodes() {
  const place = glyphAttribute(GLYPH.place), turn = glyphAttribute(GLYPH.turn);
  const at = /** @type {Node} */ (movedCorner()).toVar();
  return { position: place.xyz.add(turned(turn, vec3(at, 0))), uv: varying(at.div(place.w)) };
}
