// Splits a drawing into the shapes of its texture: faces in its colours, layers of one paint each, or a silhouette.
import { VextureError, line } from '../errors.js';
import { isVaried } from './paints.js';

/** @import { Drawing, Group, Paint, Path } from './drawing.js' */
/** @import { Note } from './notes.js' */

/** @typedef {'auto' | 'faces' | 'paint' | null} Split as `split` of `vexture.convert` in Python */

const SPLITS = ['auto', 'faces', 'paint', null];

/** Notes on what layers and silhouettes lose: neither has groups, and layers have no gradients either. */
const SHARED_OPACITY = 'opacity of a group, which each of its shapes has by itself';
const BLENDING = 'mix-blend-mode';
const MASKING = 'clip-path or mask';
const SOLID = 'pattern shown as solid';
const SHADED = 'gradient shown as its mean colour';

/**
 * Return the way in which a drawing is split. A drawing of one colour becomes a silhouette in that colour, unless it is
 * translucent and may overlap itself.
 *
 * @param {Drawing} drawing
 * @param {Split} split
 * @param {boolean} restyle
 * @returns {Exclude<Split, 'auto'>}
 * @throws {VextureError} if the options do not go together
 */
export function splitOf(drawing, split, restyle) {
  if (!SPLITS.includes(split)) {
    throw new VextureError(`\`split\` is ${line(split)}; it must be 'auto', 'faces', 'paint' or null`, 'split');
  }
  if (restyle && (split === null || split === 'paint')) {
    throw new VextureError(`\`split\` is ${line(split)}, but \`restyle\` is for a whole drawing in its colours: 'faces'`, 'split');
  }
  if (split !== 'auto') return split;
  return restyle || isColoured(drawing) || layersOf(drawing).length > 1 ? 'faces' : null;
}

/**
 * Return whether a drawing has more than one colour: several paints, a gradient, or groups, which change colours.
 *
 * @param {Drawing} drawing
 */
export function isColoured({ paths, groups }) {
  const first = paths.length ? keyOf(paths[0].paint) : '';
  return groups.length > 0 || paths.some(({ paint }) => isVaried(paint) || keyOf(paint) !== first);
}

/**
 * Split a drawing by paint; drawn in order, the layers reproduce the drawing in its colours.
 *
 * Consecutive paths with the same opaque paint form one layer. A translucent paint would show twice where two paths overlap,
 * so paths with such a paint share a layer only if their boxes do not touch.
 *
 * @param {Drawing} drawing
 * @returns {Drawing[]} in painting order, each with one paint, named `name/number-colour`
 */
export function layersOf(drawing) {
  if (drawing.groups.length || drawing.paths.some(({ paint }) => isVaried(paint))) return layersOf(flattened(drawing));
  const { paths, name } = drawing;
  const boxes = paths.map(boxOf);
  /** @type {number[]} */
  const starts = [];
  paths.forEach(({ paint }, place) => {
    const start = starts.at(-1);
    const goesOn = start !== undefined && keyOf(paths[start].paint) === keyOf(paint) &&
      (paint.opacity >= 1 || boxes.slice(start, place).every((below) => areApart(boxes[place], below)));
    if (!goesOn) starts.push(place);
  });
  return starts.map((start, k) => ({
    ...drawing, paths: paths.slice(start, starts[k + 1]), name: `${name}/${k + 1}-${hexOf(paths[start].paint)}`,
  }));
}

/**
 * Return a drawing without its masks, for its silhouette; a note counts the masks if there are any.
 *
 * @param {Drawing} drawing
 * @returns {Drawing}
 */
export function withoutMasks(drawing) {
  if (!drawing.groups.some(({ mask }) => mask)) return drawing;
  const plain = flattened(drawing);
  const lost = plain.notes.slice(drawing.notes.length).filter(({ message }) => message === MASKING || message === SOLID);
  return { ...plain, notes: [...drawing.notes, ...lost] };
}

/**
 * Replace gradients by their mean colours; a note gives their number.
 *
 * @param {Drawing} drawing
 * @returns {Drawing}
 */
export function withoutGradients(drawing) {
  const shaded = drawing.paths.filter(({ paint }) => isVaried(paint)).length;
  if (!shaded) return drawing;
  const paths = drawing.paths.map((path) => ({ ...path, paint: { ...path.paint, gradient: null, picture: null } }));
  return { ...drawing, paths, notes: [...drawing.notes, { kind: 'simplified', message: SHADED, count: shaded }] };
}

/**
 * Return a drawing without groups, masks and gradients.
 *
 * Each path gets the opacities of the groups around it, and a shape filled with a pattern becomes solid.
 *
 * @param {Drawing} drawing
 * @returns {Drawing}
 */
function flattened(drawing) {
  const { groups, paths } = drawing;
  const opacities = new Map([[-1, 1]]);
  const hidden = new Set();
  groups.forEach(({ outer, opacity, mask }, place) => {
    opacities.set(place, (opacities.get(outer) ?? 1) * opacity);
    const fillsPattern = outer >= 0 && groups[outer].pattern;
    if (hidden.has(outer) || Boolean(mask) !== Boolean(fillsPattern)) hidden.add(place);
  });
  groups.forEach(({ pattern }, place) => pattern && hidden.add(place));
  const flat = paths.filter(({ group }) => !hidden.has(group)).map((path) => {
    const { color, opacity } = path.paint;
    return { ...path, group: -1, paint: { color, opacity: opacity * (opacities.get(path.group) ?? 1), gradient: null } };
  });
  return { ...drawing, paths: flat, groups: [], notes: [...drawing.notes, ...lossesOf(drawing)] };
}

/**
 * Notes on what layers lose of groups and gradients; the opacity of a group of one path is not lost.
 *
 * @param {Drawing} drawing
 * @returns {Note[]}
 */
function lossesOf({ groups, paths }) {
  const sizes = groups.map((_, place) => paths.filter(({ group }) => group === place).length);
  for (let place = groups.length - 1; place >= 0; place--) {
    const { outer, pattern } = groups[place];
    if (pattern) sizes[place] = Math.min(sizes[place], 1); // the shape that it fills
    if (outer >= 0) sizes[outer] += sizes[place];
  }
  const count = (/** @type {(group: Group, size: number) => boolean} */ is) => groups.filter((group, k) => is(group, sizes[k])).length;
  const patterns = count(({ pattern }) => pattern);
  /** @type {[string, number][]} */
  const losses = [
    [SHARED_OPACITY, count(({ opacity }, size) => opacity < 1 && size > 1)],
    [BLENDING, count(({ blend }, size) => Boolean(blend) && size > 0)],
    [MASKING, count(({ mask }) => Boolean(mask)) - patterns],
    [SOLID, patterns],
    [SHADED, paths.filter(({ paint }) => isVaried(paint)).length],
  ];
  return losses.filter(([, number]) => number > 0).map(([message, number]) => ({ kind: 'simplified', message, count: number }));
}

/** @param {Paint} paint */
function keyOf({ color, opacity, gradient, picture }) {
  return gradient === null && !picture ? `${color} ${opacity}` : JSON.stringify({ color, opacity, gradient });
}

/**
 * Format a flat colour as #rrggbb, with two digits of opacity unless it is opaque.
 *
 * @param {Paint} paint
 */
export function hexOf({ color, opacity }) {
  const parts = opacity < 1 ? [...color, opacity] : color;
  return `#${parts.map((part) => Math.round(255 * part).toString(16).padStart(2, '0')).join('')}`;
}

/** @typedef {[number, number, number, number]} Box least x and y, greatest x and y */

/**
 * Bounding box of all control points.
 *
 * @param {Path} path
 * @returns {Box}
 */
function boxOf({ contours }) {
  /** @type {Box} */
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const contour of contours) {
    for (let k = 0; k < contour.length; k += 2) {
      box[0] = Math.min(box[0], contour[k]);
      box[1] = Math.min(box[1], contour[k + 1]);
      box[2] = Math.max(box[2], contour[k]);
      box[3] = Math.max(box[3], contour[k + 1]);
    }
  }
  return box;
}

/** @param {Box} one @param {Box} other */
function areApart(one, other) {
  return one[0] > other[2] || one[1] > other[3] || one[2] < other[0] || one[3] < other[1];
}
