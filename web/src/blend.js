// Blend modes that treat each component by itself (Compositing and Blending Level 1 of the W3C), by their numbers in
// FORMAT.md, D.6.

/** @typedef {import('./planar-map.js').Color} Color */

const NORMAL = 0;
const PLUS_LIGHTER = 16;

/** As in Python: a component this near to 0 or 1 is that, but for rounding. Dodge and burn jump there. */
const ROUNDING = 1e-9;

const hardLight = (/** @type {number} */ b, /** @type {number} */ s) =>
  s <= 0.5 ? 2 * b * s : 1 - 2 * (1 - b) * (1 - s);

/**
 * B(cb, cs) of one component, b of what is below and s of what is laid over it, by the number of the mode.
 *
 * @type {Readonly<Record<number, (b: number, s: number) => number>>}
 */
const MODES = Object.freeze({
  1: (b, s) => b * s,
  2: (b, s) => b + s - b * s,
  3: (b, s) => hardLight(s, b),
  4: Math.min,
  5: Math.max,
  6: (b, s) => (b <= ROUNDING ? 0 : s >= 1 - ROUNDING ? 1 : Math.min(1, b / (1 - s))),
  7: (b, s) => (b >= 1 - ROUNDING ? 1 : s <= ROUNDING ? 0 : 1 - Math.min(1, (1 - b) / s)),
  8: hardLight,
  9: (b, s) => {
    const root = b <= 0.25 ? ((16 * b - 12) * b + 4) * b : Math.sqrt(b);
    return b + (2 * s - 1) * (s <= 0.5 ? b * (1 - b) : root - b);
  },
  10: (b, s) => Math.abs(b - s),
  11: (b, s) => b + s - 2 * b * s,
});

/**
 * Whether a mode has this number.
 *
 * @param {number} mode
 */
export function isBlend(mode) {
  return mode === NORMAL || mode === PLUS_LIGHTER || Object.hasOwn(MODES, mode);
}

/**
 * One premultiplied colour over another, 0..1.
 *
 * @param {Color} below
 * @param {Color} above
 * @param {number} mode
 * @returns {Color}
 */
export function blended(below, above, mode) {
  const [under, over] = [below[3], above[3]];
  if (mode === PLUS_LIGHTER) return /** @type {Color} */ (below.map((part, k) => Math.min(part + above[k], 1)));
  if (mode === NORMAL) return /** @type {Color} */ (below.map((part, k) => above[k] + (1 - over) * part));
  const straight = (/** @type {number} */ part, /** @type {number} */ opacity) => (opacity ? Math.min(part / opacity, 1) : 0);
  const mixed = [0, 1, 2].map((k) => {
    const both = MODES[mode](straight(below[k], under), straight(above[k], over));
    return above[k] * (1 - under) + below[k] * (1 - over) + over * under * both;
  });
  return /** @type {Color} */ ([...mixed, over + under * (1 - over)]);
}
