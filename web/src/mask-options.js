// What a mask can be told, and which of it goes together.
import { Matrix3 } from 'three';
import { QUALITIES, WRAPS } from '../generated/shaders.js';
import { VextureError, line } from './errors.js';

/**
 * @typedef {object} MaskOptions
 * @property {string | number} [root] name or place of the shape; `NAME` also stands for the layers `NAME/...` when they
 *   are painted. Without it the first shape, or in mode `paint` the whole drawing.
 * @property {Matrix3} [transform] from the mesh's uv to the unit square; it may be changed at any time
 * @property {'alpha' | 'mix' | 'cut' | 'paint'} [mode] `alpha`: opacity outside of the shape is 0. `mix`: inside it is
 *   another colour or map. `cut`: outside of it nothing is drawn, not even depth. `paint`: a drawing in its colours.
 * @property {'none' | 'clamp' | 'repeat'} [wrap] what lies beyond the unit square: nothing, what its border shows, or
 *   the shape again
 * @property {'exact' | 'fast'} [quality]
 * @property {boolean} [invert] the shape is where it is not; not in mode `paint`
 * @property {import('three').ColorRepresentation} [color] mode `mix`: colour inside; a `Color` may be changed at any time
 * @property {import('three').Texture | null} [map] mode `mix`: map inside, by the mesh's uv and its own transform
 * @property {number} [threshold] mode `cut`: coverage of a pixel from which it is drawn
 * @property {'own' | 'none'} [background] mode `paint`: what is around the drawing, the material's own colour or nothing
 * @property {boolean} [instanced] each instance shows the root that its attribute `vextureRoot` says (`rootAttribute`);
 *   in mode `paint` that one layer
 * @property {import('./fold-texture.js').FoldTexture | null} [fold] moves the shape with time; packed textures only
 * @property {number} [time] seconds of the fold
 */

const NAMES = Object.freeze([
  'root', 'transform', 'mode', 'wrap', 'quality', 'invert', 'color', 'map', 'threshold', 'background', 'instanced',
  'fold', 'time',
]);

const MODES = Object.freeze(['alpha', 'mix', 'cut', 'paint']);

/** Materials that have no colour, and what a mask can be to them. */
const COLORLESS = Object.freeze({
  MeshNormalMaterial: ['alpha', 'cut'],
  MeshDepthMaterial: ['cut'],
  MeshDistanceMaterial: ['cut'],
});

/**
 * @template T
 * @param {string} name
 * @param {T} value
 * @param {readonly T[]} allowed
 */
function choose(name, value, allowed) {
  if (allowed.includes(value)) return value;
  throw new VextureError(`${name} is ${line(value)}; it must be one of ${allowed.join(', ')}`, name);
}

/**
 * @param {MaskOptions} options
 * @returns {Required<Omit<MaskOptions, 'root'>> & { root?: string | number }}
 */
export function complete(options) {
  const given = Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined));
  const all = {
    transform: new Matrix3(),
    mode: /** @type {const} */ ('alpha'),
    wrap: /** @type {const} */ ('none'),
    quality: /** @type {const} */ ('exact'),
    invert: false,
    color: 0xffffff,
    map: null,
    threshold: 0.5,
    background: /** @type {const} */ ('own'),
    instanced: false,
    fold: null,
    time: 0,
    ...given,
  };
  for (const name of Object.keys(given)) choose('an option', name, [...NAMES]);
  return all;
}

/**
 * Whether a mask needs blending; it then makes its material transparent.
 *
 * @param {MaskOptions} options
 */
export function isTranslucent({ mode, background }) {
  return mode === 'alpha' || (mode === 'paint' && background === 'none');
}

/**
 * @param {ReturnType<typeof complete>} options
 * @param {string} type of the material
 * @param {import('./vector-texture.js').VectorTexture} texture
 * @throws {VextureError} if they do not go together
 */
export function checkOptions(options, type, texture) {
  const { mode, wrap, quality, background, invert, instanced, threshold, transform, fold, time } = options;
  choose('mode', mode, MODES);
  choose('wrap', wrap, Object.keys(WRAPS));
  choose('quality', quality, Object.keys(QUALITIES));
  choose('background', background, ['own', 'none']);
  if (!texture?.isVectorTexture) {
    throw new VextureError(`the texture is ${line(texture?.constructor?.name)}; load one by VectorTextureLoader`, 'texture');
  }
  if (!(threshold >= 0 && threshold <= 1)) {
    throw new VextureError(`threshold is ${line(threshold)}; it must be a coverage, 0 to 1`, 'threshold');
  }
  if (transform?.elements?.length !== 9) {
    throw new VextureError(`transform is ${line(transform)}; it must be a Matrix3`, 'transform');
  }
  if (fold && !fold.isFoldTexture) {
    throw new VextureError(`fold is ${line(fold)}; load one by FoldTexture.parse`, 'fold');
  }
  if (!Number.isFinite(time)) throw new VextureError(`time is ${line(time)}; it must be a number of seconds`, 'time');
  const possible = COLORLESS[/** @type {keyof typeof COLORLESS} */ (type)];
  if (possible && !possible.includes(mode)) {
    throw new VextureError(`${type} has no colours for mode ${mode}; use ${possible.join(' or ')}`, 'mode');
  }
  if (invert && mode === 'paint') throw new VextureError('mode paint cannot be inverted; use another mode', 'invert');
  if (texture.encoding === 'thesis' && (wrap !== 'none' || instanced || fold)) {
    throw new VextureError(
      `${texture.name}: a thesis texture has one root, no wrap and no fold; convert the drawing to KTX2`,
      'encoding',
    );
  }
}
