// Clips and masks of an element (CSS Masking 1), painted as groups that mask the element's.
import { ROUND } from '../../generated/svg-reader.js';
import { IDENTITY, inverse, multiply, scale } from './affine.js';
import { clipShape } from './clip-shapes.js';
import { boundsOf, rectangleOf } from './contours.js';
import { elementTransform } from './element-transform.js';
import { lengthOf } from './lengths.js';
import { shapeOutlines } from './shapes.js';
import { contentPlace, isFlat, windowIn, withTransform } from './space.js';
import { MASK, Veil } from './veils.js';

/** @typedef {import('./space.js').Place} Place */
/** @typedef {import('./space.js').Placed} Placed */
/** @typedef {import('./scene.js').Scene} Scene */
/** @typedef {import('./affine.js').Affine} Affine */
/** @template Result @typedef {import('./pace.js').Steps<Result>} Steps */

/** Properties that mask an element, with the elements to which they refer. @type {Readonly<Record<string, string>>} */
export const MASKING = { 'clip-path': 'clipPath', mask: 'mask' };

/** Default region of a mask. */
const REGION = { x: '-10%', y: '-10%', width: '120%', height: '120%' };

const NOTHING = scale(IDENTITY, 0);

/**
 * The place inside an element, cut by its clips, and the elements to paint as its masks.
 *
 * @param {Scene} scene
 * @param {any} element
 * @param {Place} place with its own veil if the element has a clip or a mask
 * @param {readonly string[]} [names] the properties that have an effect
 * @returns {Steps<{ place: Place, shown: Placed[] }>}
 */
export function* addMasks(scene, element, place, names = Object.keys(MASKING)) {
  let inner = place;
  const shown = /** @type {Placed[]} */ ([]);
  for (const name of names) {
    if (inner.style.get(name) === 'none') continue;
    const shape = name === 'clip-path' ? yield* clipShape(scene, element, inner) : null;
    const target = shape ? null : scene.servers.referenced(name, MASKING[name], inner);
    if (shape) inner = addClipShape(scene, shape, inner, shown);
    if (target) inner = yield* addMask(scene, element, target, inner, shown);
  }
  return { place: inner, shown };
}

/**
 * Cut a place by a basic shape: by a window if it is an upright rectangle, else by a mask.
 *
 * @param {Scene} scene
 * @param {import('./clip-shapes.js').ClipShape} shape
 * @param {Place} place
 * @param {Placed[]} shown
 * @returns {Place}
 */
function addClipShape(scene, shape, place, shown) {
  const masks = contentPlace(place, null, {});
  if (shape.rectangle && !isFlat(place.space)) return { ...place, space: windowIn(place.space, shape.rectangle, IDENTITY) };
  const veil = new Veil(place.veil, 1, 0, MASK.opacity);
  place.veil?.masks.push(veil);
  shown.push([shape, { ...masks, space: place.space, veil, isClip: true }]);
  return place;
}

/**
 * @param {Scene} scene
 * @param {any} element
 * @param {any} target
 * @param {Place} place
 * @param {Placed[]} shown
 * @returns {Steps<Place>}
 */
function* addMask(scene, element, target, place, shown) {
  const { engine, report } = scene;
  const isClip = engine.name(target) === 'clipPath';
  const style = engine.style(target);
  let matrix = isClip ? elementTransform(scene, target, style, place) : IDENTITY;
  if (engine.attribute(target, isClip ? 'clipPathUnits' : 'maskContentUnits') === 'objectBoundingBox') {
    matrix = multiply(matrix, yield* boxMatrix(scene, element, place));
  }
  let space = withTransform(place.space, matrix);
  if (isClip && !isFlat(space)) {
    const box = onlyRectangle(scene, target, place);
    if (box) return { ...place, space: windowIn(space, box, inverse(matrix)) };
  }
  if (!isClip) {
    if (style.get('color-interpolation').toLowerCase() === 'linearrgb') {
      report.simplified('mask in linear light (color-interpolation) read as one in sRGB');
    }
    space = yield* region(scene, element, target, place, matrix);
  }
  const mode = place.style.get('mask-mode').split(',')[0].trim() || 'match-source';
  const kind = mode === 'match-source' ? style.get('mask-type') : mode;
  const veil = new Veil(place.veil, 1, 0, isClip || kind === 'alpha' ? MASK.opacity : MASK.luminance);
  place.veil?.masks.push(veil);
  const content = contentPlace(place, target, { space, style, veil, isClip });
  const inner = yield* addMasks(scene, target, content, isClip ? ['clip-path'] : undefined);
  shown.push(...inner.shown);
  for (const child of engine.children(target)) shown.push([child, inner.place]);
  return place;
}

/**
 * @param {Scene} scene
 * @param {any} element
 * @param {Place} place
 * @returns {Steps<Affine>} from the unit square to the bounding box
 */
export function* boxMatrix(scene, element, place) {
  const box = yield* scene.extent(element, place);
  return box ? [box[2], 0, 0, box[3], box[0], box[1]] : NOTHING;
}

/** @param {Scene} scene @param {any} element @param {any} target @param {Place} place @param {Affine} matrix */
function* region(scene, element, target, place, matrix) {
  const { engine, report } = scene;
  const byBox = engine.attribute(target, 'maskUnits') !== 'userSpaceOnUse';
  const whole = byBox ? [1, 1] : [place.view.width, place.view.height];
  const units = byBox ? yield* boxMatrix(scene, element, place) : IDENTITY;
  const [x, y, width, height] = Object.entries(REGION).map(([name, initial], k) => {
    const read = (/** @type {string} */ text) => lengthOf(place.view, text, whole[k % 2], place.style.fontSize);
    const text = engine.attribute(target, name) ?? initial;
    const length = read(text);
    if (length === null) report.invalid(name, text, target);
    return length ?? read(initial) ?? 0;
  });
  if (!(width > 0 && height > 0) || units === NOTHING) return withTransform(place.space, NOTHING);
  return windowIn(place.space, [units[4] + x * units[0], units[5] + y * units[3], width * units[0], height * units[3]], matrix);
}

/**
 * The rectangle, in the units of a clip's content, if the clip shows only an upright rectangle.
 *
 * @param {Scene} scene
 * @param {any} clip
 * @param {Place} place
 * @returns {import('./contours.js').Rectangle | null}
 */
function onlyRectangle({ engine, report }, clip, place) {
  const children = engine.children(clip).filter((child) => !['title', 'desc', 'metadata', ''].includes(engine.name(child) ?? ''));
  const [child] = children;
  if (children.length !== 1 || engine.name(child) !== 'rect') return null;
  const [style, around] = [engine.style(child), engine.style(clip)];
  const isMasked = Object.keys(MASKING).some((name) => style.get(name) !== 'none' || around.get(name) !== 'none');
  const isMoved = ['transform', 'translate', 'rotate', 'scale'].some((name) => !['', 'none'].includes(style.get(name)));
  if (isMasked || isMoved || style.get('display') !== 'inline' || style.get('visibility') !== 'visible') return null;
  const outlines = shapeOutlines({ element: child, style, view: place.view, tolerance: ROUND, report });
  if (outlines.length !== 1 || outlines[0].cubics.length !== 32) return null;
  return rectangleOf(boundsOf([outlines[0].cubics]));
}
