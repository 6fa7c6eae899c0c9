// Text that a mask inserts into a material's shader: declarations, and calls of the functions of packages/vexture/src/vexture/shaders.
import { packed, steps } from '../generated/shaders.js';
import { WRAPS } from '../generated/wraps.js';
import { ROOT_ATTRIBUTE } from './attributes.js';
import { glyphHooks } from './glyph-hooks.js';
import { withMaps } from './maps.js';

const planar = withMaps(async () => (await import('../generated/planar-shader.js')).planar);

/**
 * @typedef {object} Variant All that makes one program differ from another.
 * @property {{ declared: string, coverage: string } | null} other GLSL declarations and coverage expression of an
 *   encoding other than the packed one
 * @property {'alpha' | 'mix' | 'cut' | 'paint'} mode
 * @property {boolean} inLayers whether the shape is the union of a drawing's layers
 * @property {'none' | 'some' | 'all'} maps which of the shapes that may be shown are planar maps; all of several only if
 *   each is shown alone
 * @property {0 | 1 | 2} gradients whether maps hold gradients (1) or pictures as well (2)
 * @property {boolean} linear
 * @property {'none' | 'clamp' | 'repeat'} wrap
 * @property {boolean} flat
 * @property {boolean} invert
 * @property {'own' | 'none'} background
 * @property {import('./glyph-shader.js').Instances} instanced
 * @property {boolean} hasMap
 * @property {string} uv attribute with the texture coordinates
 * @property {string} fold GLSL of the fold that moves the shape, or ''
 */

/** Position and derivatives. The position is continuous: wrapping comes later, so that derivatives have no jumps. */
export const FOOTPRINT = 'vextureUv, vextureStepX(vextureUv), vextureStepY(vextureUv)';

/**
 * Lines that must precede the first `footprint`.
 *
 * @param {Pick<Variant, 'fold'>} variant
 */
export function foldLines({ fold }) {
  return fold ? `VextureFolded vextureFolded = vextureFold(${FOOTPRINT});\n` : '';
}

/**
 * Arguments of the coverage functions: the position looked up for a pixel, and its two derivatives.
 *
 * @param {Pick<Variant, 'fold'>} variant
 */
export function footprint({ fold }) {
  return fold ? 'vextureFolded.uv, vextureFolded.dx, vextureFolded.dy' : FOOTPRINT;
}

/** @param {Variant} variant */
function coverage(variant) {
  const { other, invert } = variant;
  const text = other ? other.coverage : coverageOf(variant);
  return invert ? `(1.0 - ${text})` : text;
}

/** @param {Variant} variant */
function coverageOf(variant) {
  if (variant.inLayers || variant.maps === 'all') return `${paint(variant)}.a`;
  if (variant.maps === 'some') return `vextureSheetCoverage(vextureInstance, ${footprint(variant)})`;
  return `vextureWrapped(${quad(variant)}, ${footprint(variant)})`;
}

/** @param {Variant} variant */
const quad = ({ instanced }) => (instanced ? 'vextureQuad(vextureInstance)' : 'vextureRootQuad');

/** Premultiplied colour. @param {Variant} variant */
function paint(variant) {
  if (variant.maps === 'all') return `vextureWrappedColor(${quad(variant)}, ${footprint(variant)})`;
  const drawn = variant.instanced ? 'int(vextureInstance), 1' : 'vextureFirst, vextureCount';
  return `${variant.maps === 'some' ? 'vextureSheets' : 'vextureLayers'}(${drawn}, ${footprint(variant)})`;
}

/** @param {Variant} variant */
function reader({ other, maps, gradients, wrap, flat, fold, linear }) {
  if (other) return other.declared;
  const declared = 'uniform uint vextureRootQuad;\nuniform int vextureFirst;\nuniform int vextureCount;\n';
  const chosen = `#define VEXTURE_FLAT ${Number(flat && !fold)}\n#define VEXTURE_WRAP ${WRAPS[wrap]}\n`;
  if (maps === 'none') return `${chosen}${packed}${fold}${declared}`;
  const colors = `#define VEXTURE_LINEAR ${Number(linear)}\n#define VEXTURE_GRADIENTS ${gradients}\n`;
  return `${chosen}${colors}${packed}${planar()}${fold}${declared}`;
}

/** Fully transparent pixels write no depth, so that they hide nothing. */
const NOTHING = 'if (diffuseColor.a == 0.0) discard;';

/** Lines of the colour of a label. @param {Variant} variant @param {'declared' | 'used'} [part] */
const tinted = ({ instanced }, part = 'used') => glyphHooks.tint?.(instanced)[part] ?? '';

/** @param {Variant} variant */
function colorLines(variant) {
  if (variant.mode === 'alpha') return `${tinted(variant)}diffuseColor.a *= ${coverage(variant)};\n${NOTHING}`;
  if (variant.mode === 'mix') {
    const map = variant.hasMap ? ' * texture2D(vextureInsideMap, vextureMapUv)' : '';
    return `diffuseColor = mix(diffuseColor, vec4(vextureInside, opacity)${map}, ${coverage(variant)});`;
  }
  const over =
    variant.background === 'own'
      ? 'diffuseColor.rgb = mix(diffuseColor.rgb, vexturePaint.rgb, vexturePaint.a);'
      : `${tinted(variant)}diffuseColor = vec4(vexturePaint.rgb, vexturePaint.a * diffuseColor.a);\n${NOTHING}`;
  const light = variant.maps === 'none' ? 'vextureStraight' : 'vextureLight';
  const straight = variant.other ? `vec4(vec3(0.0), ${variant.other.coverage})` : `${light}(${paint(variant)})`;
  return `vec4 vexturePaint = ${straight};\n${over}`;
}

/**
 * Text for each hook.
 *
 * @param {Variant} variant
 * @returns {Partial<Record<import('./hooks.js').HookName, string>>}
 */
export function texts(variant) {
  const { mode, instanced, hasMap, uv } = variant;
  const inside = mode === 'mix';
  const mapped = inside && hasMap;
  const varyings = `varying vec2 vextureUv;\n${mapped ? 'varying vec2 vextureMapUv;\n' : ''}${
    instanced ? 'flat varying highp uint vextureInstance;\n' : ''
  }`;
  // three.js declares the first set, and others if a map of the material needs them
  const declared = uv === 'uv' ? '' : `#ifndef USE_${uv.toUpperCase()}\nattribute vec2 ${uv};\n#endif\n`;
  const vertexDeclare = `uniform mat3 vextureTransform;\n${declared}${mapped ? 'uniform mat3 vextureMapTransform;\n' : ''}${
    instanced ? `attribute uint ${ROOT_ATTRIBUTE};\n` : ''
  }${varyings}${glyphHooks.declared?.(instanced) ?? ''}`;
  const vertexUv = `vextureUv = (vextureTransform * vec3(${uv}, 1.0)).xy;\n${
    mapped ? 'vextureMapUv = (vextureMapTransform * vec3(uv, 1.0)).xy;\n' : ''
  }${instanced ? `vextureInstance = ${ROOT_ATTRIBUTE};\n` : ''}`;
  const fragmentDeclare = `${varyings}${tinted(variant, 'declared')}${inside ? 'uniform vec3 vextureInside;\n' : ''}${
    mapped ? 'uniform sampler2D vextureInsideMap;\n' : ''
  }${mode === 'cut' ? 'uniform float vextureThreshold;\n' : ''}${steps}${reader(variant)}`;
  const common = { vertexDeclare, vertexUv, fragmentDeclare, ...glyphHooks.placed?.(instanced) };
  if (mode === 'cut') {
    return { ...common, fragmentCut: `${foldLines(variant)}if (${coverage(variant)} < vextureThreshold) discard;` };
  }
  return { ...common, fragmentColor: foldLines(variant) + colorLines(variant) };
}
