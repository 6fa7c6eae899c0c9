// Named places in three.js's own shaders where text is inserted.
import { ShaderLib } from 'three';
import { VextureError } from './errors.js';
import { takePartIn } from './methods.js';

/**
 * @typedef {'vertexDeclare' | 'vertexUv' | 'vertexNormal' | 'vertexPlace' | 'fragmentDeclare' | 'fragmentCut' | 'fragmentColor' | 'fragmentLight'
 *   | 'fragmentLast'} HookName
 *
 * @typedef {object} Shader
 * @property {string} vertexShader
 * @property {string} fragmentShader
 *
 * @typedef {import('three').Material} Material
 * @typedef {import('three').WebGLProgramParametersWithUniforms} Program
 */

/**
 * The include that each text follows. vertexDeclare and fragmentDeclare are outside functions. At vertexUv the
 * attribute uv is available. At vertexNormal `objectNormal` is the normal, where a material needs one. At vertexPlace `transformed` is the position of the vertex in the object. At fragmentCut nothing has been computed. At fragmentColor `diffuseColor` is complete,
 * before alphaTest. fragmentLight precedes its include; there `gl_FragColor` is the outgoing light in linear colour. At
 * fragmentLast `gl_FragColor` is in the colour space of the canvas.
 *
 * @type {Readonly<Record<HookName, { stage: 'vertexShader' | 'fragmentShader', include: string, before?: boolean }>>}
 */
const HOOKS = Object.freeze({
  vertexDeclare: { stage: 'vertexShader', include: 'common' },
  vertexUv: { stage: 'vertexShader', include: 'uv_vertex' },
  vertexNormal: { stage: 'vertexShader', include: 'beginnormal_vertex' },
  vertexPlace: { stage: 'vertexShader', include: 'begin_vertex' },
  fragmentDeclare: { stage: 'fragmentShader', include: 'clipping_planes_pars_fragment' },
  fragmentCut: { stage: 'fragmentShader', include: 'clipping_planes_fragment' },
  fragmentColor: { stage: 'fragmentShader', include: 'alphamap_fragment' },
  fragmentLight: { stage: 'fragmentShader', include: 'tonemapping_fragment', before: true },
  fragmentLast: { stage: 'fragmentShader', include: 'fog_fragment' },
});

/**
 * Materials whose shader has a different include at a hook.
 *
 * @type {Readonly<Record<string, Partial<Record<HookName, string>>>>}
 */
const EXCEPTIONS = Object.freeze({
  MeshNormalMaterial: { fragmentColor: 'clipping_planes_fragment' },
  Water: { vertexUv: 'logdepthbuf_vertex', fragmentDeclare: 'common' },
});

const REMEDY = 'use a built-in mesh material';

/**
 * Remedies for shaders that the user did not choose.
 *
 * @type {Readonly<Record<string, string>>}
 */
const REMEDIES = Object.freeze({ Water: 'this three.js is not known to work: use another version of it' });

/**
 * @param {Material} material
 * @returns {Shader | undefined} what it is compiled from, where that can be known before
 */
function shaderOf(material) {
  if ('isShaderMaterial' in material) return /** @type {import('three').ShaderMaterial} */ (material);
  const library = /** @type {Record<string, Shader>} */ (/** @type {unknown} */ (ShaderLib));
  const name = material.type.replace(/^Mesh|Material$/g, '').toLowerCase();
  const known = [name, `${name}RGBA`].find((one) => Object.hasOwn(library, one)); // that of distances has had two names
  return known === undefined ? undefined : library[known];
}

/**
 * Insert texts into a shader, each after its hook's include.
 *
 * @param {Shader} shader
 * @param {string} type of its material
 * @param {Partial<Record<HookName, string>>} texts
 * @throws {VextureError} if the shader lacks an include
 */
export function insert(shader, type, texts) {
  for (const [key, text] of Object.entries(texts)) {
    const name = /** @type {HookName} */ (key);
    const { stage, include, before } = HOOKS[name];
    const line = `#include <${EXCEPTIONS[type]?.[name] ?? include}>`;
    if (!shader[stage].includes(line)) {
      throw new VextureError(
        `${type}: its ${stage} lacks '${line}', which the hook ${name} needs; ${REMEDIES[type] ?? REMEDY}`,
        name,
      );
    }
    shader[stage] = shader[stage].replace(line, () => (before ? `${text}\n${line}` : `${line}\n${text}`));
  }
}

/**
 * Check that a material's shader has the includes of these hooks.
 *
 * @param {Material} material
 * @param {Partial<Record<HookName, string>>} texts
 */
export function check(material, texts) {
  const shader = shaderOf(material);
  if (shader) insert({ vertexShader: shader.vertexShader, fragmentShader: shader.fragmentShader }, material.type, texts);
}

/**
 * Run a function when a material is compiled, after its own `onBeforeCompile`, even if that is set later.
 *
 * @param {Material} material
 * @param {() => string} key identifies the change: programs with the same key are shared
 * @param {(program: Program) => void} compile
 * @returns {() => void} takes it back
 */
export function takePart(material, key, compile) {
  /** @type {WeakSet<Program>} */
  const compiled = new WeakSet();
  const takeBack = [
    takePartIn(material, 'onBeforeCompile', (own, program, renderer) => {
      own(program, renderer);
      if (!compiled.has(program)) compile(program); // a later function may have called the one before it
      compiled.add(program);
    }),
    takePartIn(material, 'customProgramCacheKey', (own) => `${own()} ${key()}`),
  ];
  material.needsUpdate = true;
  return () => {
    for (const restore of takeBack) restore();
    material.needsUpdate = true;
  };
}
