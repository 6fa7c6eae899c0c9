// The shape or the layers that `root` selects. Without a root a texture is used whole if that is unambiguous.
import { VextureError, line, shortened } from './errors.js';

/** Near names listed by the message about an unknown root. */
const MOST_NEAR = 5;

/** End of a layer's name. */
const LAYER = /^(.+)\/\d+(-[^/]*)?$/;

/** Names listed by the message about a missing root. */
const MOST_LISTED = 6;

/**
 * @typedef {string | number | null | undefined} RootChoice name of a shape or its place in `roots`; null and undefined:
 *   no choice
 * @typedef {Pick<import('./data.js').TextureData, 'name' | 'roots'>} Shapes
 */


/**
 * Levenshtein distance: letters to change, add or remove between two words.
 *
 * @param {string} one
 * @param {string} other
 */
function distance(one, other) {
  let row = Array.from({ length: other.length + 1 }, (_, place) => place);
  for (let i = 1; i <= one.length; i++) {
    const next = [i];
    for (let j = 1; j <= other.length; j++) {
      next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (one[i - 1] === other[j - 1] ? 0 : 1)));
    }
    row = next;
  }
  return row[other.length];
}

/**
 * Name of the drawing that a shape belongs to: that of a layer is followed by `/NUMBER-COLOUR` or `/NUMBER-faces`.
 *
 * @param {import('./data.js').Root} root
 */
export function drawingOf({ name, paint, isMap }) {
  return paint || isMap ? name.replace(LAYER, '$1') : name;
}

/**
 * Place in `roots` of one shape: the chosen one, or the only one.
 *
 * @param {Shapes} texture
 * @param {RootChoice} choice
 * @param {string} [otherwise] another remedy for a missing choice, for the end of the message
 * @returns {number}
 * @throws {VextureError} if there is no such shape, or several and no choice
 */
export function shapeIndex({ name, roots }, choice, otherwise = '') {
  if (choice === undefined || choice === null) {
    if (roots.length > 1) throw ambiguous(name, 'shapes', roots.map((root) => root.name), otherwise);
    return 0;
  }
  if (typeof choice === 'number') {
    if (Number.isInteger(choice) && choice >= 0 && choice < roots.length) return choice;
    throw new VextureError(`${name}: no root ${choice}; they are numbered 0 to ${roots.length - 1}`, 'root');
  }
  const place = roots.findIndex((root) => root.name === choice);
  if (place >= 0) return place;
  throw new VextureError(`${name}: no root ${line(choice)}; ${nearNames(`${choice}`, roots.map((root) => root.name))}`, 'root');
}

/**
 * End of a message about a name that is not there.
 *
 * @param {string} wanted
 * @param {string[]} names that are
 */
export function nearNames(wanted, names) {
  const far = new Map(names.map((name) => [name, distance(wanted.slice(0, 99), name.slice(0, 99))]));
  const near = [...far].sort((a, b) => a[1] - b[1]).slice(0, MOST_NEAR);
  return `near names are ${near.map(([other]) => line(other)).join(', ') || 'none'}; there are ${names.length}`;
}

/**
 * Range in `roots` of a drawing's layers: of the chosen drawing or shape, or of the only drawing. The layers of a drawing
 * in an atlas are consecutive.
 *
 * @param {Shapes} texture
 * @param {RootChoice} choice
 * @returns {{ first: number, count: number }}
 * @throws {VextureError} if there is no such drawing, or several and no choice
 */
export function layerRange(texture, choice) {
  const { name, roots } = texture;
  if (choice === undefined || choice === null) {
    const drawings = [...new Set(roots.map(drawingOf))];
    if (drawings.length > 1) throw ambiguous(name, 'drawings', drawings);
    return { first: 0, count: roots.length };
  }
  const isLayer = (/** @type {import('./data.js').Root} */ root) => drawingOf(root) === choice;
  const first = typeof choice === 'string' ? roots.findIndex(isLayer) : -1;
  if (first < 0 || roots.some((root) => root.name === choice)) return { first: shapeIndex(texture, choice), count: 1 };
  let end = first;
  while (end < roots.length && isLayer(roots[end])) end++;
  return { first, count: end - first };
}

/**
 * @param {string} texture its name
 * @param {'shapes' | 'drawings'} what
 * @param {string[]} names
 * @param {string} [otherwise]
 */
function ambiguous(texture, what, names, otherwise = '') {
  const more = names.length > MOST_LISTED ? ` and ${names.length - MOST_LISTED} more` : '';
  const listed = names.slice(0, MOST_LISTED).map(shortened).join(', ') + more;
  return new VextureError(`${texture} holds ${names.length} ${what} (${listed}); choose one by root${otherwise}`, 'root');
}

/**
 * Which of some shapes are planar maps: `all` only if each is shown alone.
 *
 * @param {Pick<import('./data.js').Root, 'isMap'>[]} shown
 * @param {boolean} isAlone
 * @returns {'none' | 'some' | 'all'}
 */
export function mapsAmong(shown, isAlone) {
  if (!shown.some(({ isMap }) => isMap)) return 'none';
  return isAlone && shown.every(({ isMap }) => isMap) ? 'all' : 'some';
}

/**
 * What the shader of some shapes needs for paints that are programs, as `VEXTURE_GRADIENTS`: 0 nothing, 1 gradients, 2 pictures
 * as well.
 *
 * @param {Pick<import('./data.js').Root, 'hasGradients' | 'hasPictures'>[]} shown
 * @returns {0 | 1 | 2}
 */
export const gradientsAmong = (shown) =>
  shown.some(({ hasPictures }) => hasPictures) ? 2 : shown.some(({ hasGradients }) => hasGradients) ? 1 : 0;

/**
 * Which of the shapes of a mesh of glyphs are planar maps: it shows either glyphs in one colour, or those in their own.
 *
 * @param {string | null} mode
 * @returns {'none' | 'all'}
 */
export const mapsOfGlyphs = (mode) => (mode === 'paint' ? 'all' : 'none');

/**
 * What of a map can get other colours.
 *
 * @param {import('./data.js').Root} root
 * @returns {import('./style.js').Style}
 * @throws {VextureError} if it is nothing
 */
export function styleOf({ name, style }) {
  if (!style) throw new VextureError(`"${name}" has no elements; convert the drawing with --restyle`, 'style');
  return style;
}
