// The coordinate system and the context of an element in the drawing.
import { LARGEST, MOST_MASKS } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { IDENTITY, determinant, multiply } from './affine.js';
import { clipContour } from './clip.js';
import { mapPoints } from './contours.js';
import { TooLargeError, exponential, lengthOf } from './lengths.js';

/** @typedef {import('./affine.js').Affine} Affine */
/** @typedef {import('./contours.js').Rectangle} Rectangle */

/** Smallest determinant; below it, floating point cannot compute sizes in user units. */
export const SMALLEST = 1 / LARGEST ** 4;

/**
 * @typedef {object} Space a coordinate system inside nested viewports
 * @property {Affine} matrix to the coordinates of `outer`, or of the drawing if there is none
 * @property {Rectangle | null} clip visible part, in those coordinates
 * @property {Space | null} outer
 * @property {Affine} whole to the coordinates of the drawing
 */

/** @type {Space} */
export const SPACE = { matrix: IDENTITY, clip: null, outer: null, whole: IDENTITY };

/** @param {Affine} whole @returns {Space} */
export const spaceOf = (whole) => ({ ...SPACE, whole });

/** @param {Space} space @returns {boolean} whether shapes in it have no area in the drawing */
export const isFlat = ({ whole }) => Math.abs(determinant(whole)) < SMALLEST;

/** @param {Space} space @param {Affine} matrix @returns {Space} that of an element with a transform */
export function withTransform(space, matrix) {
  const whole = multiply(space.whole, matrix);
  const largest = Math.max(...whole.map(Math.abs));
  if (!(largest <= LARGEST)) {
    const text = `the transforms multiply to ${exponential(largest)}; the limit is ${exponential(LARGEST)}`;
    throw new TooLargeError(text, 'transform');
  }
  return { ...space, matrix: multiply(space.matrix, matrix), whole };
}

/** @param {Space} space @param {Rectangle} visible @param {Affine} matrix @returns {Space} that inside a viewport */
export const windowIn = (space, visible, matrix) => ({ ...withTransform(space, matrix), matrix, clip: visible, outer: space });

/**
 * @param {Space} innermost
 * @param {Float64Array} contour
 * @returns {Float64Array} it in the drawing; empty if clipped
 */
export function toDrawing(innermost, contour) {
  let points = contour;
  for (let space = /** @type {Space | null} */ (innermost); space; space = space.outer) {
    points = mapPoints(points, space.matrix);
    if (space.clip && points.length) {
      const [x, y, width, height] = space.clip;
      points = clipContour(points, [x, y], [x + width, y + height]);
    }
  }
  return points;
}

/**
 * @typedef {object} Place the context of an element; `use` puts the same element in several places
 * @property {import('./lengths.js').Viewport} view reference of percentages
 * @property {Space} space user units
 * @property {import('./page-engine.js').Style} style of the element at the place, or of the one around it
 * @property {any} element the parent, or the `use` that shows it
 * @property {Place | null} outer the place of `element`
 * @property {number} depth number of elements around it
 * @property {boolean} used true if one of them is a `use`
 * @property {import('./page-engine.js').Style | null} use style of the `use` whose target is here
 * @property {import('./veils.js').Veil | null} veil innermost veil around it
 * @property {boolean} isClip true if only the outlines of shapes count here
 * @property {number} masks number of clips, markers, masks and patterns of which it is part
 * @property {string} name the nearest name around elements here, or that of the outermost `use`
 * @property {boolean} isInstance true if the name is that of a `use`
 * @property {{ place: Place, outlines: () => import('./contours.js').Outline[] } | null} context provides context paints
 *
 * @typedef {[element: any, place: Place]} Placed an element, and the place around it
 */

/** @param {Place} place @returns {[number, number]} values of `x` and `y` of the element here */
export function positionOf({ style, view }) {
  const x = lengthOf(view, style.get('x'), view.width, style.fontSize);
  const y = lengthOf(view, style.get('y'), view.height, style.fontSize);
  return [x ?? 0, y ?? 0];
}

/** @param {Place} place @returns {number} the depth inside one more clip, marker, mask or pattern */
export function deeper({ masks }) {
  if (masks < MOST_MASKS) return masks + 1;
  const text = `its clips, markers, masks and patterns are nested more than ${MOST_MASKS} deep; simplify them`;
  throw new VextureError(text, 'masks');
}

/**
 * The place of the content of a clip, marker, mask or pattern of the element at a place.
 *
 * @param {Place} place
 * @param {any} element
 * @param {Partial<Place>} own
 * @returns {Place}
 */
export function contentPlace(place, element, own) {
  return {
    ...place, element, outer: place, depth: place.depth + 1, used: true, use: null, veil: null, isClip: false,
    masks: deeper(place), name: '', isInstance: true, context: null, ...own,
  };
}

/**
 * @param {Place} innermost
 * @param {any} element
 * @param {(element: any) => any} original
 * @returns {boolean} whether it contains the place
 */
export function isInside(innermost, element, original) {
  for (let place = /** @type {Place | null} */ (innermost); place; place = place.outer) {
    if (place.element && original(place.element) === original(element)) return true;
  }
  return false;
}

/**
 * @typedef {object} ContentWindow a viewport, with the position of its content
 * @property {Rectangle | null} visible null if its content may extend beyond it
 * @property {Affine} content from the units of its content to those around it
 * @property {readonly [number, number]} size reference of percentages in its content
 */

/** @param {ContentWindow} window @param {Place} place @returns {Place} the place inside the viewport */
export function within({ visible, content, size }, place) {
  const space = visible ? windowIn(place.space, visible, content) : withTransform(place.space, content);
  return { ...place, view: { ...place.view, width: size[0], height: size[1] }, space };
}
