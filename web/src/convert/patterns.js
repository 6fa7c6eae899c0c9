// SVG patterns: their elements, and the position of their tiles on the painted shapes (SVG 2, 14.3).
import { IDENTITY, aboutOrigin, multiply, parseAttribute, parseTransform, scale, translate } from './affine.js';
import { boundsOf } from './contours.js';
import { BOXED, SHORTEST, WHOLE, serverTransform } from './gradients.js';
import { along, lengthOf, number } from './lengths.js';
import { fadePaint, isSingular } from './paints.js';
import { SMALLEST, contentPlace, spaceOf, windowIn } from './space.js';
import { CENTRED, THINNEST, parseFit, viewBox, viewTransform } from './viewport.js';

/** @typedef {import('./affine.js').Affine} Affine */
/** @typedef {import('./contours.js').Rectangle} Rectangle */

/**
 * @typedef {object} Pattern a pattern without a position yet
 * @property {any} element
 * @property {any} holder its children are painted
 * @property {string[]} lengths x, y, width and height
 * @property {number} fontSize
 * @property {boolean} isBoxed true if the lengths are parts of the bounding box
 * @property {boolean} boxIsUnit true if the content is in parts of the bounding box
 * @property {Affine} moved `patternTransform`
 * @property {string} origin of the transform
 * @property {Rectangle | null} view
 * @property {import('./viewport.js').Fit} fit
 *
 * @typedef {object} Tiling a pattern with its position on a painted shape
 * @property {Pattern} pattern
 * @property {Rectangle} tile the first tile, in the units of `whole`
 * @property {Affine} whole to the drawing
 * @property {Affine} content from the units of the pattern's content to those of the tile
 * @property {import('./lengths.js').Viewport} view reference of percentages in the content
 * @property {import('./paints.js').Paint} solid fallback where tiles are not possible
 * @property {number} opacity
 */

/** @param {Tiling} tiling @param {number} opacity @returns {Tiling} */
export function fadeTiling(tiling, opacity) {
  return { ...tiling, solid: fadePaint(tiling.solid, opacity), opacity: opacity * tiling.opacity };
}

/**
 * The tiles on outlines at a place; null if they have no area there.
 *
 * @param {Pattern} pattern
 * @param {import('./space.js').Place} place
 * @param {import('./contours.js').Outline[]} outlines
 * @param {import('./paints.js').Paint} solid
 * @returns {Tiling | null}
 */
export function tilingOn(pattern, place, outlines, solid) {
  const [left, top, right, bottom] = boundsOf(outlines.map(({ cubics }) => cubics));
  const [width, height] = [right - left, bottom - top];
  const view = pattern.isBoxed ? WHOLE : place.view;
  const moved = aboutOrigin(pattern.moved, pattern.origin, along(place.view, pattern.fontSize));
  const whole = multiply(place.space.whole, moved);
  if (isSingular(whole, SMALLEST)) return null;
  const lengths = pattern.lengths.map((text, k) => lengthOf(view, text, k % 2 ? view.height : view.width, pattern.fontSize) ?? 0);
  let tile = /** @type {Rectangle} */ ([lengths[0], lengths[1], lengths[2], lengths[3]]);
  if (pattern.isBoxed) tile = [left + tile[0] * width, top + tile[1] * height, tile[2] * width, tile[3] * height];
  const isThin = pattern.view && Math.min(pattern.view[2], pattern.view[3]) < THINNEST;
  if (Math.min(tile[2], tile[3]) < SHORTEST || isThin) return null;
  let content = translate(IDENTITY, tile[0], tile[1]);
  let inner = place.view;
  if (pattern.view) {
    content = multiply(content, viewTransform(pattern.view, pattern.fit, tile[2], tile[3]));
    inner = { ...inner, width: pattern.view[2], height: pattern.view[3] };
  } else if (pattern.boxIsUnit) content = scale(content, width, height);
  return { pattern, tile, whole, content, view: inner, solid, opacity: 1 };
}

/**
 * The elements to paint as the first tile, for a shape at a place, the last one first.
 *
 * @param {Tiling} tiling
 * @param {import('./space.js').Place} place
 * @param {import('./veils.js').Veil} veil
 * @param {import('./page-engine.js').Engine} engine
 * @returns {import('./space.js').Placed[]}
 */
export function firstTileContent({ pattern, tile, whole, content, view }, place, veil, engine) {
  const space = windowIn(spaceOf(whole), tile, content);
  const inner = contentPlace(place, pattern.holder, { view, space, style: engine.style(pattern.holder), veil });
  return engine.children(pattern.holder).reverse().map((child) => [child, inner]);
}

/**
 * Read the first of some pattern elements, each of which refers to the next.
 *
 * @param {any[]} chain
 * @param {import('./report.js').Report} report
 * @returns {Pattern | null} null if they have no content
 */
export function readPattern(chain, report) {
  const { engine } = report;
  /**
   * @template Value
   * @param {string} name
   * @param {(text: string) => Value | null | undefined} parse
   * @param {Value} initial
   * @returns {Value}
   */
  const read = (name, parse, initial) => {
    const element = chain.find((one) => engine.attribute(one, name) !== null);
    if (!element) return initial;
    const text = engine.attribute(element, name) ?? '';
    const value = parse(text);
    if (value === null || value === undefined) report.invalid(name, text, element);
    return value ?? initial;
  };
  const holder = chain.find((one) => engine.children(one).some((child) => engine.name(child)));
  if (!holder) return null;
  const style = engine.style(chain[0]);
  const own = serverTransform(style);
  return {
    element: chain[0], holder, fontSize: style.fontSize,
    lengths: ['x', 'y', 'width', 'height'].map((name, k) => read(name, (text) => lengthText(text, k > 1), '0')),
    isBoxed: read('patternUnits', (text) => BOXED[text.trim()], true),
    boxIsUnit: read('patternContentUnits', (text) => BOXED[text.trim()], false),
    moved: (own && parseTransform(own, number)) || read('patternTransform', parseAttribute, IDENTITY),
    origin: style.get('transform-origin') || '0 0',
    view: read('viewBox', viewBox, /** @type {Rectangle | null} */ (null)),
    fit: read('preserveAspectRatio', parseFit, CENTRED),
  };
}

/** @param {string} text @param {boolean} isSize @returns {string | null} a valid length unchanged */
function lengthText(text, isSize) {
  const length = lengthOf(WHOLE, text, 1, 1);
  return length === null || (isSize && length < 0) ? null : text;
}
