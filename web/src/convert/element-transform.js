// The transform of an element by its attribute and its CSS properties.
import { IDENTITY, aboutOrigin, angle, isIdentity, multiply, parseTransform, single } from './affine.js';
import { boundsOf, rectangleOf } from './contours.js';
import { lengthOf, words } from './lengths.js';
import { SHAPES, shapeOutlines } from './shapes.js';

/** @typedef {import('./affine.js').Affine} Affine */
/** @typedef {import('./page-engine.js').Style} Style */
/** @typedef {Pick<import('./scene.js').Scene, 'engine' | 'report'>} Scene */

/** Properties that move an element, in the order of their effect. */
const TRANSFORMS = ['translate', 'rotate', 'scale', 'transform'];

/**
 * The transform of an element by its properties, about its origin.
 *
 * @param {Scene} scene
 * @param {any} element
 * @param {Style} style
 * @param {import('./space.js').Place} place
 * @returns {Affine}
 */
export function elementTransform(scene, element, style, place) {
  if (TRANSFORMS.every((name) => ['', 'none'].includes(style.get(name)))) return IDENTITY;
  let [left, top, width, height] = [0, 0, place.view.width, place.view.height];
  if (!['', 'view-box'].includes(style.get('transform-box'))) {
    const isShape = (scene.engine.name(element) ?? '') in SHAPES;
    const shape = { element, style, view: place.view, tolerance: Infinity, report: scene.report };
    const outlines = isShape ? shapeOutlines(shape) : [];
    if (outlines.length) [left, top, width, height] = rectangleOf(boundsOf(outlines.map(({ cubics }) => cubics)));
    else scene.report.simplified('transform-box of a group read as view-box');
  }
  const length = (/** @type {string} */ text, /** @type {number} */ axis) => {
    return lengthOf(place.view, text, axis ? height : width, style.fontSize);
  };
  const matrix = ownTransform(scene, element, style, length);
  const origin = style.get('transform-origin');
  if (isIdentity(matrix) || (!origin && !left && !top)) return matrix;
  const about = aboutOrigin(matrix, origin || '0 0', length);
  return left || top ? multiply([1, 0, 0, 1, left, top], multiply(about, [1, 0, 0, 1, -left, -top])) : about;
}

/**
 * The product of the properties that move an element, without its origin.
 *
 * @param {Scene} scene
 * @param {any} element
 * @param {Style} style
 * @param {import('./affine.js').AxisLength} length
 * @returns {Affine}
 */
export function ownTransform(scene, element, style, length) {
  let product = IDENTITY;
  for (const name of TRANSFORMS) {
    const text = style.get(name);
    if (!text || text === 'none') continue;
    const parts = words(text);
    const isAxial = name === 'rotate' && parts.length > 1;
    const one = name === 'transform' ? parseTransform(text, length) : isAxial ? rotation(parts) : single(name, parts, length);
    if (!one) scene.report.invalid(name, text, element);
    else product = isIdentity(product) ? one : multiply(product, one);
  }
  return product;
}

/**
 * A rotation about an axis in space, projected onto the plane (CSS Transforms 2, 5).
 *
 * @param {string[]} parts a computed value: the axis and the angle, in either order
 * @returns {Affine | null}
 */
function rotation(parts) {
  const turn = parts.map((part) => (/[a-z]{3}$/.test(part) ? angle(part) : null)).find((value) => value !== null);
  const words = parts.filter((part) => !/[a-z]{3}$/.test(part));
  const axis = words.length === 1 ? ['x', 'y', 'z'].map((name) => Number(name === words[0])) : words.map(Number);
  const size = Math.hypot(...axis);
  if (turn === undefined || axis.length !== 3 || !(size > 0)) return null;
  const [x, y, z] = axis.map((part) => part / size);
  const [c, rest, up] = [Math.cos(turn), 1 - Math.cos(turn), Math.sin(turn)];
  return [c + rest * x * x, rest * x * y + up * z, rest * x * y - up * z, c + rest * y * y, 0, 0];
}
