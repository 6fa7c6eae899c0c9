// Paints of a planar map that hold gradients and pictures (FORMAT.md, D.6): their programs are checked, and give the colour at a point.
// Plain data, without three.js.
import {
  COORDINATE_BITS,
  KIND_FOCAL,
  KIND_FOLLOWS,
  KIND_KEEP,
  KIND_LINEAR,
  KIND_MIX,
  KIND_PICTURE,
  KIND_RADIAL,
  KIND_SHIFT,
  KIND_SOLID,
  MASKS,
  MOST_KEPT,
  MOST_PROGRAM,
  MOST_STOPS,
  PAINT_ONE,
  STOP_BITS,
  STOP_COUNT_BITS,
} from '../generated/layout.js';
import { blended, isBlend, masking } from './blend.js';
import { REMEDY, VextureError } from './errors.js';
import { PICTURE_TEXELS, faultOfPicture, faultOfPixels, pictureColor } from './pictures.js';

/**
 * @typedef {import('./planar-map.js').Head} Head
 * @typedef {import('./planar-map.js').Color} Color
 *
 * @typedef {object} Run The texels of a program.
 * @property {number} first index of the first one
 * @property {number} count
 *
 * @typedef {object} Gradient As a program's texels say.
 * @property {number} kind
 * @property {number[]} across a, b, c
 * @property {number[]} up d, e, f
 * @property {number[]} focus fx, fr
 * @property {number} spread
 * @property {number} stops index of the first one
 * @property {number} number of stops
 */

/** How a group ends that masks what is around it: by its opacity, by its luminance. */
const MASKS_BY = [MASKS + 1, MASKS + 2];

const SPREAD_SHIFT = STOP_BITS + STOP_COUNT_BITS;
const PAD = 0;
const REFLECT = 1;
const MOST_SPREAD = 2;

/** Texels of the kind FOLLOWS after the first of an operation. @type {Readonly<Record<number, number>>} */
const FOLLOWING = { [KIND_RADIAL]: 1, [KIND_FOCAL]: 2 };

/** @param {Uint32Array} texels */
const floats = (texels) => new Float32Array(texels.buffer, texels.byteOffset, texels.length);

/** Four numbers of 16 bits in two words. @returns {Color} */
const halves = (/** @type {number} */ low, /** @type {number} */ high) => [
  low & PAINT_ONE,
  low >>> COORDINATE_BITS,
  high & PAINT_ONE,
  high >>> COORDINATE_BITS,
];

/**
 * The program of a paint; null if it is a colour.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} paint
 * @returns {Run | null}
 */
export function programOf(texels, head, paint) {
  const at = 4 * head.paints + 2 * paint;
  const [first, count] = [texels[at], texels[at + 1]];
  return first !== 0 && count >>> COORDINATE_BITS === 0 ? { first, count } : null;
}

/**
 * Check the programs of a map whose parts lie within the texels.
 *
 * @param {Uint32Array} texels
 * @param {Head} head
 */
export function checkPrograms(texels, head) {
  let next = head.programs;
  /** @type {number[]} */
  const pictures = [];
  for (let paint = 0; paint < head.used; paint++) {
    const run = programOf(texels, head, paint);
    if (!run) continue;
    need(run.count >= 1 && run.count <= MOST_PROGRAM, 'one is empty or too long');
    need(run.first === next && next + run.count <= head.programs + head.operations, 'they leave gaps');
    pictures.push(...checkProgram(texels, head, run));
    next += run.count;
  }
  need(next === head.programs + head.operations, 'they leave gaps');
  for (let stop = next; stop < next + head.stops; stop++) checkStop(texels, stop);
  const fault = faultOfPixels(texels, pictures);
  need(fault === '', fault);
}

/**
 * @param {boolean} holds
 * @param {string} what
 */
function need(holds, what) {
  if (!holds) throw new VextureError(`a map's programs: ${what}; ${REMEDY}`, 'program');
}

/**
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {Run} run
 * @returns {number[]} the first texel of each picture
 */
function checkProgram(texels, head, { first, count }) {
  let kept = 0;
  let stops = 0;
  const pictures = [];
  for (let texel = first; texel < first + count; texel++) {
    const words = texels.subarray(4 * texel, 4 * texel + 4);
    const kind = words[3] >>> KIND_SHIFT;
    need(kind !== KIND_FOLLOWS, 'half of an operation');
    if (kind === KIND_PICTURE) {
      need(texel + PICTURE_TEXELS <= first + count, 'an operation of the wrong length');
      const fault = faultOfPicture(texels, texel, head.programs + head.operations + head.stops, head.pixels);
      need(fault === '', fault);
      pictures.push(texel);
      texel += PICTURE_TEXELS - 1;
      continue;
    }
    if (kind === KIND_LINEAR || kind === KIND_RADIAL || kind === KIND_FOCAL) {
      const following = FOLLOWING[kind] ?? 0;
      need(texel + following < first + count, 'an operation of the wrong length');
      stops += checkGradient(texels, head, texel, following);
      texel += following;
      continue;
    }
    need((words[3] & ((1 << KIND_SHIFT) - 1)) === 0 && words[2] === 0, 'a word that is not 0');
    if (kind === KIND_SOLID) {
      const [red, green, blue, opacity] = halves(words[0], words[1]);
      need(Math.max(red, green, blue) <= opacity, 'a colour above its opacity');
    } else if (kind === KIND_KEEP) {
      need(words[0] === 0 && words[1] === 0, 'a word that is not 0');
      kept++;
    } else {
      need(words[0] <= PAINT_ONE && (isBlend(words[1]) || MASKS_BY.includes(words[1])), 'no such group');
      kept--;
    }
    need(kept >= 0 && kept <= MOST_KEPT, 'too many groups in one another');
  }
  need(kept === 0, 'a group is not ended');
  need(stops <= MOST_STOPS, 'one has too many stops');
  return pictures;
}

/**
 * @param {Uint32Array} texels
 * @param {Head} head
 * @param {number} texel its first one
 * @param {number} following how many follow
 * @returns {number} its stops
 */
function checkGradient(texels, head, texel, following) {
  const values = floats(texels);
  for (let k = 1; k <= following; k++) {
    need(texels[4 * (texel + k) + 3] === KIND_FOLLOWS * 2 ** KIND_SHIFT, 'an operation of the wrong length');
  }
  for (let k = 0; k <= following; k++) {
    need(values.subarray(4 * (texel + k), 4 * (texel + k) + 3).every(Number.isFinite), 'a number is not finite');
  }
  if (following === 2) {
    const circle = texels.subarray(4 * (texel + 2), 4 * (texel + 2) + 3);
    need(circle[2] === 0 && circle[0] >>> 31 === 0 && circle[1] >>> 31 === 0, 'a focal circle');
  }
  const { stops, number, spread } = gradientAt(texels, texel);
  const begin = head.programs + head.operations;
  need(number >= 1 && stops >= begin && stops + number <= begin + head.stops, 'stops elsewhere');
  need(spread <= MOST_SPREAD, 'no such spread, or a word that is not 0');
  for (let stop = stops + 1; stop < stops + number; stop++) {
    need(values[4 * stop] >= values[4 * stop - 4], 'stops that are not in order');
  }
  return number;
}

/**
 * @param {Uint32Array} texels
 * @param {number} stop index of its texel
 */
function checkStop(texels, stop) {
  const offset = floats(texels)[4 * stop];
  need(offset >= 0 && offset <= 1, 'a stop that is not in 0..1');
  need(texels[4 * stop + 3] === 0, 'no such spread, or a word that is not 0');
}

/**
 * @param {Uint32Array} texels
 * @param {number} texel
 * @returns {Gradient}
 */
function gradientAt(texels, texel) {
  const values = floats(texels);
  const numbers = (/** @type {number} */ row) => [...values.subarray(4 * (texel + row), 4 * (texel + row) + 3)];
  const word = texels[4 * texel + 3];
  const kind = word >>> KIND_SHIFT;
  return {
    kind,
    across: numbers(0),
    up: kind === KIND_LINEAR ? [0, 0, 0] : numbers(1),
    focus: kind === KIND_FOCAL ? numbers(2) : [0, 0],
    spread: (word >>> SPREAD_SHIFT) & 3,
    stops: texel + (word & ((1 << STOP_BITS) - 1)),
    number: (word >>> STOP_BITS) & MOST_STOPS,
  };
}

/**
 * The colour of a checked program at a point of the unit square: premultiplied sRGB and opacity, 0..1.
 *
 * @param {Uint32Array} texels
 * @param {Run} run
 * @param {number} u
 * @param {number} v upwards
 * @returns {Color}
 */
export function programColor(texels, { first, count }, u, v) {
  /** @type {Color} */
  let color = [0, 0, 0, 0];
  /** @type {Color[]} */
  const kept = [];
  for (let texel = first; texel < first + count; texel++) {
    const [low, high, , word] = texels.subarray(4 * texel, 4 * texel + 4);
    const kind = word >>> KIND_SHIFT;
    if (kind === KIND_KEEP) {
      kept.push(color);
      color = [0, 0, 0, 0];
    } else if (kind === KIND_MIX) {
      const faded = /** @type {Color} */ (color.map((part) => (part * low) / PAINT_ONE));
      color = ended(kept.pop() ?? [0, 0, 0, 0], faded, high);
    } else if (kind === KIND_SOLID) {
      color = blended(color, /** @type {Color} */ (halves(low, high).map((part) => part / PAINT_ONE)), 0);
    } else if (kind === KIND_PICTURE) {
      color = blended(color, pictureColor(texels, texel, u, v), 0);
    } else if (kind !== KIND_FOLLOWS) {
      color = blended(color, gradientColor(texels, gradientAt(texels, texel), u, v), 0);
    }
  }
  return color;
}

/**
 * What was kept when a group began, with the group's colour on it, or masked by it.
 *
 * @param {Color} kept
 * @param {Color} color
 * @param {number} how
 * @returns {Color}
 */
function ended(kept, color, how) {
  if (how < MASKS) return blended(kept, color, how);
  const left = masking(color, how === MASKS_BY[0]);
  return /** @type {Color} */ (kept.map((part) => part * left));
}

/**
 * @param {Uint32Array} texels
 * @param {Gradient} gradient
 * @param {number} u
 * @param {number} v
 * @returns {Color}
 */
function gradientColor(texels, gradient, u, v) {
  const place = placeOn(gradient, u, v);
  if (place === null) return [0, 0, 0, 0];
  let t = place;
  if (gradient.spread === PAD) t = Math.min(Math.max(t, 0), 1);
  else if (gradient.spread === REFLECT) t = 1 - Math.abs(1 - (t - 2 * Math.floor(t / 2)));
  else t -= Math.floor(t);
  const values = floats(texels);
  const { stops, number } = gradient;
  const stopColor = (/** @type {number} */ stop) => halves(texels[4 * stop + 1], texels[4 * stop + 2]);
  let after = stops;
  while (after < stops + number && values[4 * after] <= t) after++;
  const before = Math.max(after - 1, stops);
  after = Math.min(after, stops + number - 1);
  const [from, to] = [values[4 * before], values[4 * after]];
  const share = to > from ? Math.min(Math.max((t - from) / (to - from), 0), 1) : 0;
  const [one, other] = [stopColor(before), stopColor(after)];
  const [red, green, blue, opacity] = one.map((part, k) => (part + share * (other[k] - part)) / PAINT_ONE);
  return [red * opacity, green * opacity, blue * opacity, opacity];
}

/**
 * The place t on a gradient's ramp, before it spreads; null beside a cone.
 *
 * @param {Gradient} gradient
 * @param {number} u
 * @param {number} v
 * @returns {number | null}
 */
function placeOn({ kind, across, up, focus }, u, v) {
  const [x, y] = [across, up].map(([a, b, c]) => a * u + b * v + c);
  if (kind === KIND_LINEAR) return x;
  if (kind === KIND_RADIAL) return Math.hypot(x, y);
  const [fx, fr] = focus;
  // |q + fx t|^2 = (fr + grows t)^2, where q is the point less the focal one
  const [qx, grows] = [x - fx, 1 - fr];
  const a = fx * fx - grows * grows;
  const b = qx * fx - fr * grows;
  const c = qx * qx + y * y - fr * fr;
  const inside = b * b - a * c;
  if (inside < 0) return null;
  const far = b < 0 ? Math.sqrt(inside) - b : -Math.sqrt(inside) - b;
  const roots = [a !== 0 ? far / a : NaN, far !== 0 ? c / far : NaN].filter((t) => fr + grows * t >= 0);
  return roots.length ? Math.max(...roots) : null;
}
