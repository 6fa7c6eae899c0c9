// Text that water inserts into a shader: declarations, and calls of the functions of packages/vexture/src/vexture/shaders/water.glsl.
import { fold } from '../../generated/fold-shader.js';
import { steps } from '../../generated/shaders.js';
import { WRAPS } from '../../generated/wraps.js';
import { depths, shore, water } from '../../generated/water-shader.js';
import { foldLines, footprint } from '../mask-shader.js';
import { FIELDS } from './fields.js';

/** Macro of programs with a fold. */
export const FOLD = 'VEXTURE_FOLD';

const VARYINGS = 'varying vec2 vextureUv;\nvarying vec2 vextureMeshUv;\n';

/** Beyond the unit square, water continues as on its border. */
const CLAMPED = `#define VEXTURE_WRAP ${WRAPS.clamp}\n`;

/** The fragment shader's declarations and functions. */
const DECLARATIONS = `${VARYINGS}uniform vec4 vextureShallow;
uniform vec4 vextureFoamColor;
uniform vec4 vextureFlatColor;
${steps}${CLAMPED}${water}#ifdef ${FOLD}
${fold}#endif
#ifdef ${FIELDS}
${depths}#endif
`;

const COVER = 'void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }';

/** The shader that draws the coverage of each texel of the shore raster. */
export const SHORE_SHADER = Object.freeze({
  vertexShader: COVER,
  fragmentShader: `#define VEXTURE_FLAT 1
${CLAMPED}${shore}uniform uint vextureRoot;
uniform float vextureTexel;
void main() { gl_FragColor = vec4(vextureTexelOf(vextureRoot, gl_FragCoord.xy * vextureTexel, vextureTexel)); }`,
});

/** The shader that blurs it with a box filter along one axis. */
export const SPREAD_SHADER = Object.freeze({
  vertexShader: COVER,
  fragmentShader: `${shore}uniform sampler2D vextureRaster;
uniform ivec2 vextureWay;
uniform int vextureReach;
uniform int vextureNear;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  gl_FragColor = vec4(vextureSpread(vextureRaster, at, vextureWay, vextureReach, vextureNear), 0.0, 1.0);
}`,
});

/** Declarations of the vertex shader. */
export const VERTEX_DECLARE = `uniform mat3 vextureTransform;\n${VARYINGS}`;

/** Text at vertexUv. */
export const VERTEX_UV = 'vextureMeshUv = uv;\nvextureUv = (vextureTransform * vec3(uv, 1.0)).xy;';

/**
 * Text at fragmentLight, where gl_FragColor is in linear colour: shallows and foam; and where fields are known, calm water.
 *
 * @param {{mirrored: string, facing: string}} calm expressions of what calm water mirrors, and of the cosine to the eye
 */
const light = ({ mirrored, facing }) => `#ifdef ${FOLD}
${foldLines({ fold })}VextureWater vextureHere = vextureWater(${footprint({ fold })});
#else
VextureWater vextureHere = vextureWater(${footprint({ fold: '' })});
#endif
vec4 vextureStrip = vextureShallow;
#ifdef ${FIELDS}
VextureField vextureKnown = vextureField(vextureMeshUv);
vextureHere.openness *= vextureKnown.openness;
vextureStrip.a *= vextureKnown.openness;
#endif
gl_FragColor.rgb = vextureInshore(gl_FragColor.rgb, vextureHere, normalSampler, time, vextureStrip, vextureFoamColor);
#ifdef ${FIELDS}
vec4 vextureStill = vextureCalm(vextureKnown.depth, ${mirrored}, ${facing});
gl_FragColor = vextureJoined(vextureStill, gl_FragColor, vextureKnown.openness);
#endif`;

/** For three.js's Water: its mirror, less distorted than by waves. */
const MIRROR = Object.freeze({
  mirrored: 'texture2D(mirrorSampler, mirrorCoord.xy / mirrorCoord.w + 0.12 * distortion).rgb',
  facing: 'max(eyeDirection.y, 0.0)',
});

/** For the simple water: its sky. */
const SKY = Object.freeze({
  mirrored: 'vextureSkyOf(vextureSun, max(normalize(cameraPosition - vextureWorld).y, 0.0))',
  facing: 'max(normalize(cameraPosition - vextureWorld).y, 0.0)',
});

/**
 * Text at fragmentLast, where gl_FragColor is in the colour space of the canvas: the flat colour, and the coverage,
 * which changes only alpha. Blending is colour * alpha + ground * (1 - alpha) of encoded (sRGB) values.
 */
export const LAST = `#ifdef ${FIELDS}
if (vextureClasses > 0) {
  vec4 vextureShown = vextureDepthColor(vextureKnown);
  gl_FragColor = linearToOutputTexel(vextureShown);
}
#endif
vec4 vexturePlain = linearToOutputTexel(vec4(vextureFlatColor.rgb, 1.0));
gl_FragColor = mix(gl_FragColor, vexturePlain, vextureFlatColor.a);
gl_FragColor.a *= vextureHere.coverage;
if (vextureHere.coverage == 0.0) discard;`;

/**
 * Text for each hook of the shader of three.js's Water.
 *
 * @type {Partial<Record<import('../hooks.js').HookName, string>>}
 */
export const WATER_TEXTS = Object.freeze({
  vertexDeclare: VERTEX_DECLARE,
  vertexUv: VERTEX_UV,
  fragmentDeclare: DECLARATIONS,
  fragmentLight: light(MIRROR),
  fragmentLast: LAST,
});

/** Uniforms of the simple water's functions, with the names of three.js's Water. */
const SIMPLE_UNIFORMS = `uniform sampler2D normalSampler;
uniform vec3 sunDirection, sunColor, waterColor, vextureZenith, vextureHorizon;
uniform float time, size, alpha;
varying vec3 vextureWorld;
`;

/** The simple water's own shader, around the same lines. */
export const SIMPLE_SHADER = Object.freeze({
  vertexShader: `#include <common>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
${VERTEX_DECLARE}varying vec3 vextureWorld;
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * mvPosition;
  vextureWorld = (modelMatrix * vec4(position, 1.0)).xyz;
  ${VERTEX_UV}
  #include <logdepthbuf_vertex>
  #include <fog_vertex>
}`,
  fragmentShader: `#include <common>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
${SIMPLE_UNIFORMS}${DECLARATIONS}
void main() {
  #include <logdepthbuf_fragment>
  VextureLight vextureSun = VextureLight(sunDirection, sunColor, waterColor, vextureZenith, vextureHorizon);
  gl_FragColor = vec4(vextureSea(vextureSun, cameraPosition, vextureWorld, size, normalSampler, time), alpha);
  ${light(SKY)}
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  #include <fog_fragment>
  ${LAST}
}`,
});
