// The options of a mask, their defaults and their validation.
import { Matrix3 } from 'three';
import { WRAPS } from '../generated/shaders.js';
import { VextureError, line } from './errors.js';

/**
 * @typedef {object} MaskOptions
 * @property {string | number | null} [root] name or place of the shape; in mode `paint` `NAME` also selects the layers
 *   `NAME/...`. Needed if the texture holds several shapes, in mode `paint` if it holds several drawings, unless
 *   `instanced` is set.
 * @property {Matrix3} [transform] from the mesh's uv to the unit square; its elements may be changed at any time
 * @property {0 | 1} [channel] set of texture coordinates: the mesh's `uv`, or its `uv1`
 * @property {'alpha' | 'mix' | 'cut' | 'paint'} [mode] `alpha`: opacity is 0 outside the shape. `mix`: another colour or
 *   map inside the shape. `cut`: nothing is drawn outside the shape, not even depth. `paint`: the drawing's own colours.
 * @property {'none' | 'clamp' | 'repeat'} [wrap] beyond the unit square: nothing, the value at its border, or the shape
 *   again
 * @property {boolean} [flat] for views straight at a plane, as of an orthographic camera, in which pixels are upright in
 *   the drawing and all alike: they cost less. In any other view the picture is wrong. Without effect on a fold
 * @property {boolean} [invert] exchange inside and outside; not in mode `paint`
 * @property {import('three').ColorRepresentation} [color] mode `mix`: colour inside; a `Color` may be changed at any time
 * @property {import('three').Texture | null} [map] mode `mix`: map inside, with the mesh's uv and its own transform
 * @property {number} [threshold] mode `cut`: pixels with at least this coverage are drawn
 * @property {boolean} [linear] mode `paint`, of a planar map: average the colours of a pixel in linear light, as light
 *   mixes, or in sRGB, as browsers do. By default `true` on lit materials; without effect on a drawing of several layers
 * @property {'own' | 'none'} [background] mode `paint`: around the drawing, the material's own colour or nothing
 * @property {boolean} [instanced] each instance shows the root in its attribute `vextureRoot` (see `rootAttribute`), in
 *   mode `paint` one layer
 * @property {import('./fold-texture.js').FoldTexture | null} [fold] moves the shape with time; packed textures only
 * @property {number} [time] seconds of the fold
 */

const NAMES = Object.freeze([
  'root', 'transform', 'mode', 'wrap', 'flat', 'invert', 'color', 'map', 'threshold', 'background', 'instanced',
  'fold', 'time', 'linear', 'channel',
]);

export const MODES = Object.freeze(['alpha', 'mix', 'cut', 'paint']);

export const BACKGROUNDS = Object.freeze(['own', 'none']);

export const CHANNELS = Object.freeze([0, 1]);

/** Materials without colour, and the modes that they allow. */
const COLORLESS = Object.freeze({
  MeshNormalMaterial: ['alpha', 'cut'],
  MeshDepthMaterial: ['cut'],
  MeshDistanceMaterial: ['cut'],
});

/** Materials that light falls on. */
const LIT = Object.freeze([
  'MeshLambertMaterial', 'MeshPhongMaterial', 'MeshStandardMaterial', 'MeshPhysicalMaterial', 'MeshToonMaterial',
]);

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
 * @param {string} type of the material
 * @returns {Required<Omit<MaskOptions, 'root'>> & { root?: string | number }}
 */
export function complete(options, type) {
  const given = Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined));
  const all = {
    transform: new Matrix3(),
    mode: /** @type {const} */ ('alpha'),
    wrap: /** @type {const} */ ('none'),
    flat: false,
    invert: false,
    color: 0xffffff,
    map: null,
    threshold: 0.5,
    background: /** @type {const} */ ('own'),
    instanced: false,
    fold: null,
    time: 0,
    linear: LIT.includes(type),
    channel: /** @type {const} */ (0),
    ...given,
  };
  for (const name of Object.keys(given)) choose('an option', name, [...NAMES]);
  return all;
}

/**
 * Whether a mask needs blending, for which it makes its material transparent.
 *
 * @param {MaskOptions} options
 */
export function isTranslucent({ mode, background }) {
  return mode === 'alpha' || (mode === 'paint' && background === 'none');
}

/**
 * @param {ReturnType<typeof complete>} options
 * @param {string} type of the material
 * @param {import('./vector-texture.js').AnyVectorTexture} texture
 * @throws {VextureError} if an option is out of range, or options exclude each other
 */
export function checkOptions(options, type, texture) {
  const { mode, wrap, background, invert, instanced, threshold, transform, fold, time, channel } = options;
  choose('mode', mode, MODES);
  choose('wrap', wrap, Object.keys(WRAPS));
  choose('background', background, BACKGROUNDS);
  choose('channel', channel, CHANNELS);
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
  if (texture.encoding !== 'packed' && (wrap !== 'none' || instanced || fold)) {
    throw new VextureError(
      `${texture.name}: a ${texture.encoding} texture has one root, no wrap and no fold; convert the drawing to KTX2`,
      'encoding',
    );
  }
}
