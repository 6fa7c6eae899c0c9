// What a mask adds to a material's shader: declarations, and lines that call the functions of src/vexture/glsl.
import { FOLD_HEIGHT, QUALITIES, WRAPS, packed, steps } from '../generated/shaders.js';

/**
 * @typedef {object} Variant All that makes one program differ from another.
 * @property {'packed' | 'thesis'} encoding
 * @property {string} thesis what reads a thesis texture
 * @property {'alpha' | 'mix' | 'cut' | 'paint'} mode
 * @property {boolean} inLayers whether the shape is a drawing's layers together
 * @property {'none' | 'clamp' | 'repeat'} wrap
 * @property {'exact' | 'fast'} quality
 * @property {boolean} invert
 * @property {'own' | 'none'} background
 * @property {boolean} instanced
 * @property {boolean} hasMap
 * @property {string} fold what moves the places with time, or nothing
 */

/** Name of the attribute with each instance's root. */
export const ROOT_ATTRIBUTE = 'vextureRoot';

/** The derivatives are those of a position that has no jumps: borders are looked at below. */
const FOOTPRINT = 'vextureUv, vextureStepX(vextureUv), vextureStepY(vextureUv)';

/**
 * What must stand before the first `footprint`.
 *
 * @param {Pick<Variant, 'fold'>} variant
 */
export function foldLines({ fold }) {
  return fold ? `VextureFolded vextureFolded = vextureFold(${FOOTPRINT});\n` : '';
}

/**
 * Arguments of the functions that give a coverage: where a pixel is looked up, and the steps to the next ones.
 *
 * @param {Pick<Variant, 'fold'>} variant
 */
export function footprint({ fold }) {
  return fold ? 'vextureFolded.uv, vextureFolded.dx, vextureFolded.dy' : FOOTPRINT;
}

/** @param {Variant} variant */
function coverage(variant) {
  const { encoding, inLayers, instanced, invert } = variant;
  const root = instanced ? 'vextureQuad(vextureInstance)' : 'vextureRootQuad';
  const layers = instanced ? 'int(vextureInstance), 1' : 'vextureFirst, vextureCount';
  let text = `vextureWrapped(${root}, ${footprint(variant)})`;
  if (inLayers) text = `vextureLayers(${layers}, ${footprint(variant)}).a`;
  if (encoding === 'thesis') text = `thesis_coverage(vextureQuads, vextureCurves, ${FOOTPRINT})`;
  return invert ? `(1.0 - ${text})` : text;
}

/** @param {Variant} variant */
function paint(variant) {
  const { encoding, instanced } = variant;
  if (encoding === 'thesis') return `vec4(vec3(0.0), thesis_coverage(vextureQuads, vextureCurves, ${FOOTPRINT}))`;
  return `vextureLayers(${instanced ? 'int(vextureInstance), 1' : 'vextureFirst, vextureCount'}, ${footprint(variant)})`;
}

/** @param {Variant} variant */
function reader({ encoding, thesis, wrap, quality, fold }) {
  if (encoding === 'packed') {
    const declared = 'uniform uint vextureRootQuad;\nuniform int vextureFirst;\nuniform int vextureCount;\n';
    return `#define VEXTURE_QUALITY ${QUALITIES[quality]}\n#define VEXTURE_WRAP ${WRAPS[wrap]}\n${packed}${fold}${declared}`;
  }
  return thesis;
}

/**
 * What reads a thesis texture; nothing for others.
 *
 * @param {import('./data.js').TextureData} data
 */
export function thesisReader(data) {
  if (data.encoding !== 'thesis') return '';
  const sizes = `const int thesis_LEVELS = ${data.levels};\nconst int thesis_FOLD_HEIGHT = ${FOLD_HEIGHT};\n`;
  const lists = 'precision highp sampler2D;\nuniform sampler2D vextureQuads;\nuniform sampler2D vextureCurves;\n';
  return sizes + lists + data.glsl;
}

/** What is not there at all must not hide what lies behind it: it writes no depth. */
const NOTHING = 'if (diffuseColor.a == 0.0) discard;';

/** @param {Variant} variant */
function colorLines(variant) {
  if (variant.mode === 'alpha') return `diffuseColor.a *= ${coverage(variant)};\n${NOTHING}`;
  if (variant.mode === 'mix') {
    const map = variant.hasMap ? ' * texture2D(vextureInsideMap, vextureMapUv)' : '';
    return `diffuseColor = mix(diffuseColor, vec4(vextureInside, opacity)${map}, ${coverage(variant)});`;
  }
  const over =
    variant.background === 'own'
      ? 'diffuseColor.rgb = mix(diffuseColor.rgb, vexturePaint.rgb, vexturePaint.a);'
      : `diffuseColor = vec4(vexturePaint.rgb, vexturePaint.a * diffuseColor.a);\n${NOTHING}`;
  const straight = variant.encoding === 'packed' ? `vextureStraight(${paint(variant)})` : paint(variant);
  return `vec4 vexturePaint = ${straight};\n${over}`;
}

/**
 * Texts for the hooks.
 *
 * @param {Variant} variant
 * @returns {Partial<Record<import('./hooks.js').HookName, string>>}
 */
export function texts(variant) {
  const { mode, instanced, hasMap } = variant;
  const inside = mode === 'mix';
  const mapped = inside && hasMap;
  const varyings = `varying vec2 vextureUv;\n${mapped ? 'varying vec2 vextureMapUv;\n' : ''}${
    instanced ? 'flat varying highp uint vextureInstance;\n' : ''
  }`;
  const vertexDeclare = `uniform mat3 vextureTransform;\n${mapped ? 'uniform mat3 vextureMapTransform;\n' : ''}${
    instanced ? `attribute uint ${ROOT_ATTRIBUTE};\n` : ''
  }${varyings}`;
  const vertexUv = `vextureUv = (vextureTransform * vec3(uv, 1.0)).xy;\n${
    mapped ? 'vextureMapUv = (vextureMapTransform * vec3(uv, 1.0)).xy;\n' : ''
  }${instanced ? `vextureInstance = ${ROOT_ATTRIBUTE};\n` : ''}`;
  const fragmentDeclare = `${varyings}${inside ? 'uniform vec3 vextureInside;\n' : ''}${
    mapped ? 'uniform sampler2D vextureInsideMap;\n' : ''
  }${mode === 'cut' ? 'uniform float vextureThreshold;\n' : ''}${steps}${reader(variant)}`;
  const common = { vertexDeclare, vertexUv, fragmentDeclare };
  if (mode === 'cut') {
    return { ...common, fragmentCut: `${foldLines(variant)}if (${coverage(variant)} < vextureThreshold) discard;` };
  }
  return { ...common, fragmentColor: foldLines(variant) + colorLines(variant) };
}
