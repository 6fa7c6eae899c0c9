// The vertices of glyphs: each instance is a rectangle around one glyph, and what half a pixel is larger on each side.
//
// A pixel is a box, so it shows something of a glyph up to half a pixel beside it. What half a pixel is in the plane of
// the glyph follows from the derivatives of the projection (the inverse of its Jacobian): at any size, turn and tilt the
// rectangle is as large as needed, and no larger, because each of its pixels costs time.
import { Vector2 } from 'three';
import { ROOT_ATTRIBUTE } from './attributes.js';
import { glyphHooks } from './glyph-hooks.js';
import { isOfGlyphs } from './mask-options.js';

/** Names of the attributes of glyphs. */
export const GLYPH = Object.freeze({
  /** x, y and z of the lower left corner of the unit square of the shape, and its side. */
  place: 'vextureGlyph',
  /**
   * The part of the unit square that is shown: left, bottom, right and top. Of what is clipped, left and bottom are above
   * 0, and right and top have a minus sign: it has no rim there.
   */
  box: 'vextureBox',
  /** Quaternion of the rotation of the glyph around that corner. */
  turn: 'vextureTurn',
  /** Row of its label in the table of labels. */
  label: 'vextureLabel',
  root: ROOT_ATTRIBUTE,
});

/**
 * Texels of a label: position and size; rotation as a quaternion; colour and opacity. The size is that of a unit of the
 * text: in units of the scene, or in pixels if it is negative.
 */
export const LABEL_TEXELS = 3;

/** Texels in a row of the table of labels. */
export const LABEL_WIDTH = 1536;

/** Share by which the rim is wider than half a pixel, because a perspective is linear only nearly. */
export const MARGIN = 0.125;

/** Rims are at most so many times as wide as the glyph: more is seen only of glyphs seen from the edge. */
export const MOST_RIM = 4;

/** Width and height in pixels of what is drawn to; set before each draw. */
export const VIEWPORT = new Vector2(1, 1);

/**
 * @typedef {object} Labels The table of labels.
 * @property {true} isLabels
 * @property {import('three').DataTexture} texture
 * @property {'labels' | 'sprites'} kind sprites face the camera
 */

/** @typedef {boolean | 'glyphs' | 'labels' | 'sprites'} Instances whether a mesh has instances, and what they are */

/** Where a point and a normal of a text are in the object. */
const PUT = `vec3 vexturePut(vec3 at) {
  return at;
}
vec3 vextureFacing(vec3 normal) {
  return normal;
}
`;

/** Where a point and a normal of a label are in the object; sprites face the camera. @param {boolean} isSprite */
const putLabel = (isSprite) => `uniform highp sampler2D vextureLabels;
attribute uint ${GLYPH.label};
varying vec4 vextureTint;
vec4 vextureOfLabel(uint part) {
  uint texel = ${LABEL_TEXELS}u * ${GLYPH.label} + part;
  return texelFetch(vextureLabels, ivec2(texel % ${LABEL_WIDTH}u, texel / ${LABEL_WIDTH}u), 0);
}
vec3 vexturePut(vec3 at) {
  vec4 place = vextureOfLabel(0u);
  float size = place.w;
  if (size < 0.0) {
    float depth = (projectionMatrix * modelViewMatrix * vec4(place.xyz, 1.0)).w;
    size *= -2.0 * depth / (vextureViewport.y * projectionMatrix[1][1]${isSprite ? '' : ' * length(modelViewMatrix[1].xyz)'});
  }
  at *= size;
  return place.xyz + ${isSprite ? 'inverse(mat3(modelViewMatrix)) * at' : 'vextureRotated(at, vextureOfLabel(1u))'};
}
vec3 vextureFacing(vec3 normal) {
  return ${isSprite ? 'normal * mat3(modelViewMatrix)' : 'vextureRotated(normal, vextureOfLabel(1u))'};
}
`;

/**
 * Lines outside of functions.
 *
 * @param {Instances} instances
 */
function glyphDeclared(instances) {
  if (!isOfGlyphs(instances)) return '';
  const put = instances === 'glyphs' ? PUT : putLabel(instances === 'sprites');
  return `uniform vec2 vextureViewport;
attribute vec4 ${GLYPH.place};
attribute vec4 ${GLYPH.box};
attribute vec4 ${GLYPH.turn};
vec3 vextureRotated(vec3 at, vec4 turn) {
  return at + 2.0 * cross(turn.xyz, cross(turn.xyz, at) + turn.w * at);
}
${put}vec3 vextureOfGlyph(vec2 at) {
  return vexturePut(${GLYPH.place}.xyz + vextureRotated(vec3(at, 0.0), ${GLYPH.turn}));
}
`;
}

/** The normal of a glyph. */
const NORMAL = `objectNormal = vextureFacing(vextureRotated(objectNormal, ${GLYPH.turn}));\n`;

/**
 * Lines that follow those that make `objectNormal` of the normal, and `transformed` of the position, which is a corner of a
 * unit square here.
 *
 * @param {Instances} instances
 */
const glyphPlaced = (instances) => (isOfGlyphs(instances) ? { vertexNormal: NORMAL, vertexPlace: placedLines(instances) } : {});

/** @param {Instances} instances */
const placedLines = (instances) => `{
  vec2 vextureSize = (abs(${GLYPH.box}.zw) - ${GLYPH.box}.xy) * ${GLYPH.place}.w;
  vec2 vextureAt = mix(${GLYPH.box}.xy, abs(${GLYPH.box}.zw), position.xy) * ${GLYPH.place}.w;
  vec2 vextureOutwards = mix(-step(${GLYPH.box}.xy, vec2(0.0)), step(0.0, ${GLYPH.box}.zw), position.xy);
  mat4 vextureToClip = projectionMatrix * modelViewMatrix;
  vec3 vextureCorner = vextureOfGlyph(vec2(0.0));
  vec3 vextureAlongU = vextureOfGlyph(vec2(1.0, 0.0)) - vextureCorner;
  vec3 vextureAlongV = vextureOfGlyph(vec2(0.0, 1.0)) - vextureCorner;
  vec4 vextureAtClip = vextureToClip * vec4(vextureCorner + vextureAt.x * vextureAlongU + vextureAt.y * vextureAlongV, 1.0);
  vec4 vextureStepU = vextureToClip * vec4(vextureAlongU, 0.0);
  vec4 vextureStepV = vextureToClip * vec4(vextureAlongV, 0.0);
  float vextureDepth = max(vextureAtClip.w, 1e-6);
  vec2 vextureScale = 0.5 * vextureViewport / vextureDepth;
  vec2 vextureU = (vextureStepU.xy - vextureStepU.w * vextureAtClip.xy / vextureDepth) * vextureScale;
  vec2 vextureV = (vextureStepV.xy - vextureStepV.w * vextureAtClip.xy / vextureDepth) * vextureScale;
  float vextureArea = max(abs(vextureU.x * vextureV.y - vextureU.y * vextureV.x), 1e-12);
  vec2 vextureRim = ${(0.5 * (1 + MARGIN)).toFixed(4)} *
    vec2(abs(vextureV.x) + abs(vextureV.y), abs(vextureU.x) + abs(vextureU.y)) / vextureArea;
  vextureRim = min(vextureRim, ${MOST_RIM.toFixed(1)} * max(vextureSize.x, vextureSize.y));
  vextureAt += vextureOutwards * vextureRim;
  transformed = vextureCorner + vextureAt.x * vextureAlongU + vextureAt.y * vextureAlongV;
  vextureUv = vextureAt / ${GLYPH.place}.w;
${instances === 'glyphs' ? '' : '  vextureTint = vextureOfLabel(2u);\n  if (vextureTint.a == 0.0) transformed = vextureCorner;\n'}}
`;

/** @param {any} instanced */
const glyphUniforms = (instanced) => (isOfGlyphs(instanced) ? { vextureViewport: VIEWPORT, ...(instanced.isLabels && { vextureLabels: instanced.texture }) } : {});

/** Lines of the colour of a label. @param {Instances} instances */
const glyphTint = (instances) => ({
  declared: instances !== 'labels' && instances !== 'sprites' ? '' : 'varying vec4 vextureTint;\n',
  used: instances !== 'labels' && instances !== 'sprites' ? '' : 'diffuseColor *= vextureTint;\n',
});

/** Let masks show glyphs. */
export function installGlyphShader() {
  const kindOf = (/** @type {any} */ instanced) => instanced?.kind ?? instanced;
  Object.assign(glyphHooks, {
    declared: (/** @type {any} */ instanced) => glyphDeclared(kindOf(instanced)),
    placed: (/** @type {any} */ instanced) => glyphPlaced(kindOf(instanced)),
    tint: (/** @type {any} */ instanced) => glyphTint(kindOf(instanced)),
    uniforms: glyphUniforms,
  });
}
