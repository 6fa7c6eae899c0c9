// The vertices of glyphs as nodes: what `glyph-shader.js` says in GLSL.
import {
  Fn, abs, attribute, cameraProjectionMatrix, cross, int, inverse, ivec2, length, mat3, max, min, mix, modelViewMatrix, normalGeometry,
  normalLocal, normalize, positionGeometry, screenSize, select, step, textureLoad, varying, vec2, vec3, vec4,
} from 'three/tsl';
import { GLYPH, LABEL_TEXELS, LABEL_WIDTH, MARGIN, MOST_RIM } from '../glyph-shader.js';
import { wordsNode } from './shape-inputs.js';

/** @import { Labels } from '../glyph-shader.js' */

/** @typedef {any} Node three.js's types know few of the methods of nodes */

/** @param {string} name @returns {Node} */
const glyphAttribute = (name) => attribute(name, 'vec4');

/** @param {Node} at @param {Node} turn quaternion @returns {Node} */
const rotated = (at, turn) => at.add(cross(turn.xyz, cross(turn.xyz, at).add(turn.w.mul(at))).mul(2));

/** @returns {Node} */
const toClip = () => /** @type {Node} */ (cameraProjectionMatrix).mul(modelViewMatrix);

/**
 * What reads the table of labels, which may get another texture.
 *
 * @param {Labels} labels
 * @returns {(part: number) => Node}
 */
function labelReader(labels) {
  const table = wordsNode(() => labels.texture);
  return (part) => {
    const texel = /** @type {Node} */ (int(/** @type {Node} */ (attribute(GLYPH.label, 'uint')))).mul(LABEL_TEXELS).add(part);
    return textureLoad(table, ivec2(texel.mod(LABEL_WIDTH), texel.div(LABEL_WIDTH)));
  };
}

/**
 * Where a point of a label is in the object.
 *
 * @param {(part: number) => Node} read
 * @param {boolean} isSprite
 * @returns {(at: Node) => Node}
 */
function labelPlacer(read, isSprite) {
  const place = read(0), turn = read(1), view = /** @type {Node} */ (modelViewMatrix);
  const depth = toClip().mul(vec4(place.xyz, 1)).w;
  const across = /** @type {Node} */ (screenSize).y.mul(/** @type {Node} */ (cameraProjectionMatrix)[1].y);
  const whole = isSprite ? across : across.mul(length(view[1].xyz));
  const size = select(place.w.lessThan(0), place.w.mul(-2).mul(depth).div(whole), place.w).toVar();
  const back = isSprite ? /** @type {Node} */ (inverse(mat3(view[0].xyz, view[1].xyz, view[2].xyz))) : null;
  return (at) => {
    const scaled = at.mul(size);
    return place.xyz.add(back ? back.mul(scaled) : rotated(scaled, turn));
  };
}

/**
 * Nodes of the vertices of glyphs.
 *
 * @param {'glyphs' | Labels} instanced
 * @returns {{ position: Node, uv: Node, tint: Node | null }} position in the object, position in the unit square of the
 *   glyph's shape, and colour of a label
 */
export function glyphNodes(instanced) {
  const labels = instanced === 'glyphs' ? null : instanced;
  const read = labels && labelReader(labels);
  const vertex = Fn(() => {
    const put = read ? labelPlacer(read, labels?.kind === 'sprites') : (/** @type {Node} */ at) => at;
    const place = glyphAttribute(GLYPH.place), box = glyphAttribute(GLYPH.box), turn = glyphAttribute(GLYPH.turn);
    const ofGlyph = (/** @type {number} */ x, /** @type {number} */ y) => put(place.xyz.add(rotated(vec3(x, y, 0), turn)));
    const corner = /** @type {Node} */ (positionGeometry).xy;
    const high = abs(box.zw), size = high.sub(box.xy).mul(place.w);
    const at = /** @type {Node} */ (mix(box.xy, high, corner).mul(place.w).toVar());
    const outwards = /** @type {Node} */ (mix(step(box.xy, vec2(0)).negate(), step(0, box.zw), corner)); // see `GLYPH.box`
    const origin = ofGlyph(0, 0).toVar(), alongU = ofGlyph(1, 0).sub(origin).toVar(), alongV = ofGlyph(0, 1).sub(origin).toVar();
    const clip = toClip();
    const atClip = clip.mul(vec4(origin.add(alongU.mul(at.x)).add(alongV.mul(at.y)), 1)).toVar();
    const depth = max(atClip.w, 1e-6).toVar();
    const onScreen = (/** @type {Node} */ along) => {
      const way = clip.mul(vec4(along, 0)).toVar();
      return way.xy.sub(atClip.xy.mul(way.w).div(depth)).mul(screenSize).mul(0.5).div(depth).toVar();
    };
    const u = onScreen(alongU), v = onScreen(alongV);
    const area = max(abs(u.x.mul(v.y).sub(u.y.mul(v.x))), 1e-12);
    const rim = vec2(abs(v.x).add(abs(v.y)), abs(u.x).add(abs(u.y))).mul(0.5 * (1 + MARGIN)).div(area);
    at.addAssign(outwards.mul(min(rim, vec2(max(size.x, size.y).mul(MOST_RIM)))));
    return vec4(at, 0, 0);
  });
  const at = /** @type {Node} */ (vertex()).xy.toVar();
  const position = Fn(() => {
    const put = read ? labelPlacer(read, labels?.kind === 'sprites') : (/** @type {Node} */ point) => point;
    const normal = rotated(/** @type {Node} */ (normalGeometry), glyphAttribute(GLYPH.turn)), view = /** @type {Node} */ (modelViewMatrix);
    const facing = vec3(view[0].z, view[1].z, view[2].z);
    const whole = read ? (labels?.kind === 'sprites' ? normalize(facing) : rotated(normal, read(1))) : normal;
    /** @type {Node} */ (normalLocal).assign(whole); // as three.js does for instances
    const moved = put(glyphAttribute(GLYPH.place).xyz.add(rotated(vec3(at, 0), glyphAttribute(GLYPH.turn))));
    return read ? select(read(2).w.equal(0), put(glyphAttribute(GLYPH.place).xyz), moved) : moved;
  })();
  return { position, uv: varying(at.div(glyphAttribute(GLYPH.place).w)), tint: read && varying(read(2)) };
}
