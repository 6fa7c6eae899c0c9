/**
 * The state of the page as one value, and its encoding in links.
 *
 * @typedef {'flat' | 'plane' | 'sphere' | 'cube'} Mode
 * @typedef {'light' | 'dark' | 'system'} Theme
 * @typedef {'theme' | 'white' | 'black' | 'checks' | `#${string}`} Background what lies below the drawing; #rrggbb: a colour
 * @typedef {'thesis16' | 'thesis8' | 'raster' | 'svg'} Rival what the texture is compared with
 *
 * @typedef {object} Overlays
 * @property {boolean} cells
 * @property {boolean} coverage
 * @property {boolean} depth
 * @property {number} cutoff levels by which the descent ends too early, 0..8
 * @property {boolean} inspect
 * @property {boolean} contents
 *
 * @typedef {object} ViewState
 * @property {string} shape its name; '' for the first
 * @property {string} drawing one of an atlas; '' for the first or only
 * @property {readonly [number, number]} center point of the unit square in the middle of the canvas
 * @property {number} zoom 1 shows the whole unit square
 * @property {Mode} mode
 * @property {number} yaw radians, of the mesh
 * @property {number} pitch radians
 * @property {number} distance how near the mesh is: 1 shows it whole, 2 twice as large
 * @property {Theme} theme of the page around the picture
 * @property {Background} background of the picture
 * @property {Rival | null} compare
 * @property {number} split where the divider stands, 0..1
 * @property {Overlays} overlays
 */
import { LEAST_ZOOM, MOST_ZOOM, clamp, held } from './view.js';

export const MODES = Object.freeze(/** @type {Mode[]} */ (['flat', 'plane', 'sphere', 'cube']));
export const THEMES = Object.freeze(/** @type {Theme[]} */ (['system', 'light', 'dark']));
/** What people read of each background. @type {Readonly<Record<string, string>>} */
export const BACKGROUND_NAMES = Object.freeze({
  white: 'White', black: 'Black', checks: 'Checkerboard', theme: 'As the page',
});
const COLOR = /^#[0-9a-f]{6}$/;
/** What people read of each rival. @type {Readonly<Record<Rival, string>>} */
export const RIVAL_NAMES = Object.freeze({
  thesis16: '16-bit original method (2018)', thesis8: '8-bit original method (2018)', raster: 'Raster of equal bytes',
  svg: 'Browser SVG',
});
export const RIVALS = Object.freeze(/** @type {Rival[]} */ (Object.keys(RIVAL_NAMES)));

export const LEAST_DISTANCE = 0.4;
export const MOST_DISTANCE = 12;
export const MOST_PITCH = Math.PI / 2;
export const MOST_CUTOFF = 8;

const VERSION = '1';
/** Of a link from before backgrounds could be chosen. */
const LAST_FIELDS = 15;

/** @type {Readonly<Overlays>} */
const NO_OVERLAYS = Object.freeze({
  cells: false, coverage: false, depth: false, cutoff: 0, inspect: false, contents: false,
});
/** The switches, in the order of their bits in a link. */
const SWITCHES = /** @type {const} */ (['cells', 'coverage', 'depth', 'inspect', 'contents']);

/** @type {Readonly<ViewState>} */
export const START = Object.freeze({
  shape: '', drawing: '', center: Object.freeze(/** @type {[number, number]} */ ([0.5, 0.5])), zoom: 1, mode: 'flat',
  yaw: -0.4, pitch: 0.3, distance: 1, theme: 'system', background: 'white', compare: null, split: 0.5, overlays: NO_OVERLAYS,
});

/** Where another shape is seen from first: all of it, from home. */
export const HOME = Object.freeze({
  center: START.center, zoom: START.zoom, yaw: START.yaw, pitch: START.pitch, distance: START.distance,
});

/** @param {ViewState} value @returns {Readonly<ViewState>} */
function within(value) {
  const view = held(value);
  const turn = 2 * Math.PI;
  return Object.freeze({
    ...value,
    center: Object.freeze(view.center),
    zoom: view.zoom,
    yaw: Math.abs(value.yaw) > Math.PI ? value.yaw - turn * Math.round(value.yaw / turn) : value.yaw,
    pitch: clamp(value.pitch, -MOST_PITCH, MOST_PITCH),
    distance: clamp(value.distance, LEAST_DISTANCE, MOST_DISTANCE),
    split: clamp(value.split, 0, 1),
    overlays: Object.freeze({ ...value.overlays, cutoff: clamp(value.overlays.cutoff, 0, MOST_CUTOFF) }),
  });
}

/** @param {unknown} one @param {unknown} other */
const same = (one, other) => one === other || JSON.stringify(one) === JSON.stringify(other);

/** The page's one changing value. `change` events carry `detail.changed`, the set of keys that have a new value. */
export class State extends EventTarget {
  /** @type {Readonly<ViewState>} */
  #value;

  /** @param {Partial<ViewState>} [value] */
  constructor(value = {}) {
    super();
    this.#value = within({ ...START, ...value });
  }

  /** What is shown; frozen. */
  get value() {
    return this.#value;
  }

  get overlays() {
    return this.#value.overlays;
  }

  /** @param {Partial<ViewState>} patch */
  update(patch) {
    const before = this.#value;
    const after = within({ ...before, ...patch });
    const keys = /** @type {(keyof ViewState)[]} */ (Object.keys(after));
    const changed = new Set(keys.filter((key) => !same(before[key], after[key])));
    if (changed.size === 0) return;
    this.#value = after;
    this.dispatchEvent(new CustomEvent('change', { detail: { changed } }));
  }

  /** @param {Partial<Overlays>} patch */
  updateOverlays(patch) {
    this.update({ overlays: { ...this.#value.overlays, ...patch } });
  }
}

/**
 * Text for `#view=`: fields with `~` between them, which URLs leave as it is.
 *
 * @param {ViewState} value
 */
export function encodeView(value) {
  const bits = SWITCHES.reduce((sum, key, bit) => sum + (value.overlays[key] ? 1 << bit : 0), 0);
  const fields = [
    VERSION, value.shape, value.drawing, value.center[0], value.center[1], value.zoom, value.mode, value.yaw,
    value.pitch, value.distance, value.theme, value.compare ?? '', value.split, bits, value.overlays.cutoff, value.background,
  ];
  return fields.map((field) => encodeURIComponent(String(field)).replaceAll('~', '%7E')).join('~');
}

/**
 * The state that a link's text means; null if it is damaged.
 *
 * @param {string} text
 * @returns {ViewState | null}
 */
export function decodeView(text) {
  let fields;
  try {
    fields = text.split('~').map(decodeURIComponent);
  } catch {
    return null;
  }
  if (fields.length === LAST_FIELDS) fields.push(START.background);
  if (fields.length !== LAST_FIELDS + 1 || fields[0] !== VERSION) return null;
  const [, shape, drawing, u, v, zoom, mode, yaw, pitch, distance, theme, compare, split, bits, cutoff, below] = fields;
  const texts = [u, v, zoom, yaw, pitch, distance, split, bits, cutoff];
  const numbers = texts.map((field) => (field.trim() === '' ? NaN : Number(field)));
  if (!numbers.every(Number.isFinite)) return null;
  const [un, vn, zoomn, yawn, pitchn, distancen, splitn, bitsn, cutoffn] = numbers;
  const known = /** @type {string[]} */ ([...MODES]).includes(mode)
    && /** @type {string[]} */ ([...THEMES]).includes(theme)
    && (below in BACKGROUND_NAMES || COLOR.test(below))
    && (compare === '' || /** @type {string[]} */ ([...RIVALS]).includes(compare));
  if (!known || zoomn < LEAST_ZOOM || zoomn > MOST_ZOOM || bitsn < 0 || bitsn >= 1 << SWITCHES.length) return null;
  const switches = Object.fromEntries(SWITCHES.map((key, bit) => [key, ((bitsn >> bit) & 1) === 1]));
  return within({
    shape, drawing, center: [un, vn], zoom: zoomn, mode: /** @type {Mode} */ (mode), yaw: yawn, pitch: pitchn,
    distance: distancen, theme: /** @type {Theme} */ (theme),
    background: /** @type {Background} */ (below), compare: /** @type {Rival | null} */ (compare || null),
    split: splitn, overlays: /** @type {Overlays} */ ({ ...NO_OVERLAYS, ...switches, cutoff: cutoffn }),
  });
}
