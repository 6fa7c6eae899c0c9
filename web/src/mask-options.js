// The options of a mask, their defaults and their validation.
import { Matrix3 } from 'three';
import { WRAPS } from '../generated/wraps.js';
import { VextureError, line, unfit } from './errors.js';

/**
 * @typedef {object} MaskOptions How a mask shows its shape. In a `VectorMaterial`, `mode` is never `mix`, and `background`
 *   is `none` by default.
 * @property {string | number | null} [root] name or place of the shape; in mode `paint` `NAME` also selects the layers
 *   `NAME/...`. Needed if the texture holds several shapes, in mode `paint` if it holds several drawings, unless
 *   `instanced` is set.
 * @property {Matrix3} [transform] from the mesh's uv to the unit square; its elements may be changed at any time. By
 *   default the identity
 * @property {0 | 1} [channel] set of texture coordinates: the mesh's `uv`, by default, or its `uv1`
 * @property {'alpha' | 'mix' | 'cut' | 'paint' | null} [mode] `alpha`: opacity is 0 outside the shape. `mix`: another colour or map
 *   inside the shape. `cut`: nothing is drawn outside the shape, not even depth. `paint`: the drawing's own colours. null:
 *   `paint` of what has colours, else `alpha`. `alpha` by default
 * @property {'none' | 'clamp' | 'repeat'} [wrap] beyond the unit square: nothing (the default), the value at its border,
 *   or the shape again
 * @property {boolean} [flat] a cheaper method for views straight at a plane, as of an orthographic camera, in which all
 *   pixels are upright in the drawing and of equal size. In any other view the picture is wrong. It has no effect on a
 *   fold. `false` by default
 * @property {boolean} [invert] exchange inside and outside, by default `false`; not in mode `paint`
 * @property {import('three').ColorRepresentation} [color] mode `mix`: colour inside, by default white; a `Color` may be
 *   changed at any time
 * @property {import('three').Texture | null} [map] mode `mix`: map inside, with the mesh's uv and its own transform. By
 *   default none
 * @property {number} [threshold] mode `cut`: pixels with at least this coverage are drawn, by default 0.5
 * @property {boolean} [linear] mode `paint`, of a planar map: average the colours of a pixel in linear light, as light
 *   mixes, or in sRGB, as browsers do. By default `true` on lit materials; without effect on a drawing of several layers
 * @property {'own' | 'none'} [background] mode `paint`: around the drawing, the material's own colour (the default), or
 *   nothing
 * @property {boolean | 'glyphs' | { isLabels: true, texture: import('three').DataTexture, areSprites: boolean }} [instanced] each instance shows the root in its attribute
 *   `vextureRoot` (see `rootAttribute`), in mode `paint` one layer. `glyphs` and labels are for the parts of texts. `false`
 *   by default
 * @property {import('./fold-texture.js').FoldTexture | null} [fold] moves the shape with time; packed textures only. By default
 *   none
 * @property {number} [time] seconds of the fold, by default 0
 */

export const MODES = Object.freeze(['alpha', 'mix', 'cut', 'paint']);

export const BACKGROUNDS = Object.freeze(['own', 'none']);

/**
 * Whether instances are glyphs, of a text or of labels.
 *
 * @param {unknown} instanced an option, or what a program has
 */
export const isOfGlyphs = (instanced) => instanced !== true && Boolean(instanced);

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
 * @typedef {Required<Omit<MaskOptions, 'root'>> & Pick<MaskOptions, 'root'>} AllOptions the options of a mask, those that
 *   were not given as well
 * @typedef {AllOptions & { mode: NonNullable<AllOptions['mode']> }} ShownOptions those of what is shown
 */

/**
 * Each option and its value where it is not given; the one list of the options.
 *
 * @param {string} [type] of the material
 * @returns {AllOptions}
 */
const defaults = (type = '') => ({
  root: undefined,
  transform: new Matrix3(),
  mode: 'alpha',
  wrap: 'none',
  flat: false,
  invert: false,
  color: 0xffffff,
  map: null,
  threshold: 0.5,
  background: 'own',
  instanced: false,
  fold: null,
  time: 0,
  linear: LIT.includes(type),
  channel: 0,
});

/** @type {readonly string[]} */
export const NAMES = Object.freeze(Object.keys(defaults()));

/**
 * A class whose objects have the options as properties, which are those of `options`; `change` takes a new value.
 *
 * @template {new (...parameters: any[]) => { options: object }} T
 * @param {T} base
 * @param {readonly string[]} names of options
 * @param {'set' | 'setValues'} change name of the method
 * @returns {any}
 */
export function withOptions(base, names, change) {
  class Live extends base {}
  for (const name of names) {
    Object.defineProperty(Live.prototype, name, {
      configurable: true,
      get() {
        return this.options[name];
      },
      set(value) {
        this[change]({ [name]: value });
      },
    });
  }
  return Live;
}

/**
 * @param {MaskOptions} options
 * @param {string} type of the material
 * @returns {AllOptions}
 */
export function complete(options, type) {
  const given = Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined));
  for (const name of Object.keys(given)) choose('an option', name, NAMES);
  return { ...defaults(type), ...given };
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
 * @param {Pick<AllOptions, 'wrap' | 'fold'>} options where a shape is
 * @throws {VextureError} if one is out of range
 */
function checkPlace({ wrap, fold }) {
  choose('wrap', wrap, Object.keys(WRAPS));
  if (fold && !fold.isFoldTexture) {
    throw new VextureError(`fold is ${line(fold)}; load one by FoldTexture.parse`, 'fold');
  }
}

/**
 * @param {Record<string, any>} options of a node
 * @param {readonly string[]} names of all that it has
 * @throws {VextureError} if one is out of range, or there is no such option
 */
export function checkNodeOptions({ wrap = 'none', fold = null, ...others }, names) {
  for (const name of Object.keys(others)) choose('an option', name, names);
  checkPlace({ wrap, fold });
}

/**
 * @param {AllOptions} options
 * @param {string} type of the material
 * @throws {VextureError} if an option is out of range, or options exclude each other
 */
export function checkOptions(options, type) {
  const { mode, wrap, background, invert, threshold, transform, fold, time, channel } = options;
  if (mode !== null) choose('mode', mode, MODES);
  checkPlace({ wrap, fold });
  choose('background', background, BACKGROUNDS);
  choose('channel', channel, CHANNELS);
  if (!(threshold >= 0 && threshold <= 1)) {
    throw new VextureError(`threshold is ${line(threshold)}; it must be a coverage, 0 to 1`, 'threshold');
  }
  if (transform?.elements?.length !== 9) {
    throw new VextureError(`transform is ${line(transform)}; it must be a Matrix3`, 'transform');
  }
  if (!Number.isFinite(time)) throw new VextureError(`time is ${line(time)}; it must be a number of seconds`, 'time');
  const possible = COLORLESS[/** @type {keyof typeof COLORLESS} */ (type)];
  if (possible && !possible.includes(/** @type {string} */ (mode))) {
    throw new VextureError(`${type} has no colours for mode ${mode}; use ${possible.join(' or ')}`, 'mode');
  }
  if (invert && mode === 'paint') throw new VextureError('mode paint cannot be inverted; use another mode', 'invert');
}

/**
 * @param {import('./vector-texture.js').AnyVectorTexture} texture
 * @param {AllOptions} options
 * @throws {VextureError} if it is no texture, or one without what the options ask for
 */
export function checkTexture(texture, { wrap, instanced, fold }) {
  if (!texture?.isVectorTexture) throw unfit('texture', texture, 'load one by VectorTextureLoader');
  if (texture.encoding !== 'packed' && (wrap !== 'none' || instanced || fold)) {
    throw new VextureError(
      `${texture.name}: a ${texture.encoding} texture has one root, no wrap and no fold; convert the drawing to KTX2`,
      'encoding',
    );
  }
}
