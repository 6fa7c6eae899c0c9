// Elements that become groups of the drawing: opacity, blend modes and isolation, if they change the picture.
import { BLENDS } from '../../generated/svg-reader.js';

/** Most paths in a veil that are compared with one another. */
const MOST_BOXES = 500;

/** @typedef {import('./contours.js').Bounds} Bounds */

/**
 * @typedef {{ outer: number, opacity: number, blend: number, mask: number, pattern: boolean }} Group as Python's
 *   `Group`
 */

/** Properties of a group that mask the group around it. */
export const MASK = { none: 0, opacity: 1, luminance: 2 };

/** An element that is composited by itself; it becomes a group only if the picture would differ without one. */
export class Veil {
  /** @param {Veil | null} outer @param {number} opacity @param {number} [blend] @param {number} [mask] */
  constructor(outer, opacity, blend = 0, mask = MASK.none) {
    this.outer = outer;
    this.opacity = opacity;
    this.blend = blend;
    this.mask = mask;
    /** @type {Bounds[]} */
    this.boxes = [];
    this.overlaps = false;
    this.mixes = false; // true if its content has a blend mode, which must not affect what is outside
    /** @type {Veil[]} */
    this.masks = [];
    this.isPattern = false;
  }

  /** Insert this independent veil of a pattern into another veil. @param {Veil | null} outer @param {Bounds} box */
  enter(outer, box) {
    this.outer = outer;
    outer?.add(box);
    for (let veil = outer; veil && this.overlaps; veil = veil.mask ? null : veil.outer) veil.overlaps = true;
  }

  /** Make this the veil of a pattern; return the veil of the shape that masks it. @param {number} opacity */
  maskPattern(opacity) {
    this.isPattern = true;
    const mask = new Veil(this, opacity, 0, MASK.opacity);
    this.masks.push(mask);
    return mask;
  }

  /** Add the box of a path; more than `MOST_BOXES` boxes count as overlapping. @param {Bounds} box */
  add(box) {
    /** @type {Veil | null} */
    let veil = this;
    while (veil && !veil.overlaps) { // around an overlapping veil, all veils overlap
      veil.overlaps = veil.boxes.length === MOST_BOXES || veil.boxes.some((other) => meet(box, other));
      veil.boxes.push(box);
      if (veil.mask) break;
      if (veil.outer && veil.blend) veil.outer.mixes = true;
      veil = veil.outer;
    }
  }

  /** True if its paths cannot have its opacity one by one, or if a blend mode reveals that they are together. */
  get isGroup() {
    const blends = this.blend !== 0 && (!this.outer || this.outer.overlaps);
    return Boolean(this.mask || this.masks.length) || blends || (this.overlaps && (this.opacity < 1 || this.mixes));
  }
}

/** @param {Bounds} a @param {Bounds} b @returns {boolean} whether the interiors of two boxes intersect */
const meet = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

/**
 * The veil of an element, or the veil around it if the element is not composited by itself.
 *
 * @param {import('./page-engine.js').Style} style
 * @param {Veil | null} outer
 * @param {boolean} [isClip]
 */
export function veilOf(style, outer, isClip = false) {
  const isIsolated = ['clip-path', 'filter', 'mask'].some((name) => style.get(name) !== 'none');
  if (isClip) return isIsolated ? new Veil(outer, 1) : outer;
  const opacity = style.opacity('opacity');
  const blend = Math.max(BLENDS.indexOf(style.get('mix-blend-mode')), 0);
  if (opacity === 1 && !blend && !isIsolated && style.get('isolation') !== 'isolate') return outer;
  return new Veil(outer, opacity, blend);
}

/**
 * Put paths into groups; multiply the opacities of other veils into the paths.
 *
 * @template {{ paint: import('./paints.js').Paint, group: number }} Path
 * @param {Path[]} paths
 * @param {(Veil | null)[]} veils the innermost veil of each
 * @param {(paint: import('./paints.js').Paint, opacity: number) => import('./paints.js').Paint} fade
 * @returns {{ paths: Path[], groups: Group[] }}
 */
export function groupPaths(paths, veils, fade) {
  /** @type {Group[]} */
  const groups = [];
  /** @type {Map<Veil | null, { place: number, opacity: number }>} */
  const places = new Map([[null, { place: -1, opacity: 1 }]]);
  const grouped = paths.map((path, k) => {
    /** @type {Veil[]} */
    const unknown = [];
    for (let veil = veils[k]; veil && !places.has(veil); veil = veil.outer) unknown.push(veil);
    while (unknown.length) {
      const veil = /** @type {Veil} */ (unknown.pop());
      if (!places.has(veil)) places.set(veil, placeOf(veil, groups, places));
      unknown.push(...veil.masks.filter((mask) => !unknown.includes(mask) && !places.has(mask)));
    }
    const { place, opacity } = /** @type {{ place: number, opacity: number }} */ (places.get(veils[k]));
    return veils[k] ? { ...path, paint: fade(path.paint, opacity), group: place } : path;
  });
  return { paths: grouped, groups };
}

/** @param {Veil} veil @param {Group[]} groups @param {Map<Veil | null, { place: number, opacity: number }>} places */
function placeOf(veil, groups, places) {
  let { place, opacity } = /** @type {{ place: number, opacity: number }} */ (places.get(veil.outer));
  if (veil.mask) opacity = 1;
  let own = veil.overlaps ? veil.opacity : 1;
  opacity *= veil.overlaps ? 1 : veil.opacity;
  if (veil.isGroup) {
    if (veil.isPattern) [own, opacity] = [own * opacity, 1]; // the opacity also belongs to the shape
    groups.push({ outer: place, opacity: own, blend: veil.blend, mask: veil.mask, pattern: veil.isPattern });
    place = groups.length - 1;
  }
  return { place, opacity };
}

/**
 * Drop groups without paths; an empty mask hides what it masks.
 *
 * @template {{ group: number }} Path
 * @param {Path[]} paths
 * @param {Group[]} groups
 * @returns {{ paths: Path[], groups: Group[] }}
 */
export function dropEmptyGroups(paths, groups) {
  const held = new Set(paths.map((path) => path.group));
  for (let k = groups.length - 1; k >= 0; k--) if (held.has(k)) held.add(groups[k].outer);
  groups.forEach((group, k) => {
    if (group.mask && held.has(group.outer)) held.add(k);
  });
  const places = new Map([[-1, -1]]);
  const remaining = groups.filter((_, k) => held.has(k) && places.set(k, places.size - 1));
  const moved = (/** @type {number} */ place) => /** @type {number} */ (places.get(place));
  return {
    paths: paths.map((path) => ({ ...path, group: moved(path.group) })),
    groups: remaining.map((group) => ({ ...group, outer: moved(group.outer) })),
  };
}
