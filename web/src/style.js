// What of a planar map can be restyled (FORMAT.md, D.10): its elements, and which of them each paint is made of.
import { blended, masking, modeNamed } from './blend.js';
import { REMEDY, VextureError, line } from './errors.js';
import { paintAt } from './walk-map.js';

/**
 * @typedef {import('./planar-map.js').Color} Color
 *
 * @typedef {object} StyleElement Part of a drawing that is recoloured as a whole.
 * @property {string} name may be empty, and several elements may share it
 * @property {[number, number, number]} color sRGB components, 0..1
 * @property {number} opacity 0..1
 * @property {number} group the innermost group around it, as a place in `groups`; -1 if there is none
 * @property {boolean} hides whether the map lacks something below it, so that it must stay opaque
 *
 * @typedef {object} StyleGroup Elements that are composited together before the rest.
 * @property {number} outer the group around it, or -1
 * @property {number} opacity 0..1
 * @property {number} blend number of the blend mode
 * @property {'none' | 'opacity' | 'luminance'} mask whether it masks the group around it
 *
 * @typedef {object} Style Elements of a planar map that can be recoloured.
 * @property {StyleElement[]} elements in painting order
 * @property {StyleGroup[]} groups each after the group around it
 * @property {number[][]} stacks of each paint, the elements seen in it, from below
 */

const MASKS = ['none', 'opacity', 'luminance'];

/** Groups in one another; deeper ones are refused, as Python does. */
const MOST_NESTED = 100;

/**
 * A style from JSON.
 *
 * @param {any} value
 * @param {string} what names the root in messages
 * @returns {Style}
 */
export function readStyle(value, what) {
  need(isObject(value), `${what}: style`, value);
  const { elements, groups, stacks } = value;
  for (const [name, list] of Object.entries({ elements, groups, stacks })) need(Array.isArray(list), `${what}: ${name}`, list);
  const read = groups.map((/** @type {any} */ group, /** @type {number} */ place) => readGroup(group, place, what));
  checkNesting(read, what);
  const style = {
    elements: elements.map((/** @type {any} */ element) => readElement(element, groups.length, what)),
    groups: read,
    stacks: stacks.map((/** @type {any} */ stack) => {
      need(Array.isArray(stack), `${what}: a stack`, stack);
      for (const one of stack) need(isPlace(one, elements.length), `${what}: an element of a stack`, one);
      return stack;
    }),
  };
  checkOrder(style, what);
  return style;
}

/**
 * @param {any} value
 * @param {number} groups
 * @param {string} what
 * @returns {StyleElement}
 */
function readElement(value, groups, what) {
  need(isObject(value), `${what}: an element`, value);
  const { name, color, opacity = 1, group = -1, hides = false } = value;
  need(typeof name === 'string' && typeof hides === 'boolean', `${what}: an element`, value);
  need(Array.isArray(color) && color.length === 3 && [...color, opacity].every(isPart), `${what}: an element`, value);
  need(group === -1 || isPlace(group, groups), `${what}: the group of an element`, group);
  return { name, color: [color[0], color[1], color[2]], opacity, group, hides };
}

/**
 * @param {any} value
 * @param {number} place
 * @param {string} what
 * @returns {StyleGroup}
 */
function readGroup(value, place, what) {
  need(isObject(value), `${what}: a group`, value);
  const { outer, opacity, blend, mask = 'none' } = value;
  const mode = modeNamed(blend);
  need((outer === -1 || isPlace(outer, place)) && isPart(opacity) && mode !== null, `${what}: a group`, value);
  need(MASKS.includes(mask) && (mask === 'none' || outer >= 0), `${what}: the mask of a group`, mask);
  return { outer, opacity, blend: mode ?? 0, mask };
}

/**
 * @param {StyleGroup[]} groups
 * @param {string} what
 */
function checkNesting(groups, what) {
  /** @type {number[]} */
  const depth = [];
  for (const { outer } of groups) depth.push(outer >= 0 ? depth[outer] + 1 : 1);
  need(depth.every((one) => one <= MOST_NESTED), `${what}: the depth of groups`, Math.max(0, ...depth));
}

/**
 * The elements of a group follow one another.
 *
 * @param {Pick<Style, 'elements' | 'groups'>} style
 * @param {string} what
 */
function checkOrder({ elements, groups }, what) {
  const ended = new Set();
  /** @type {number[]} */
  let open = [];
  for (const { group } of elements) {
    const around = groupsAround(groups, group);
    for (const one of open) if (!around.includes(one)) ended.add(one);
    need(!around.some((one) => ended.has(one)), `${what}: a group that goes on`, group);
    open = around;
  }
}

/**
 * @param {boolean} holds
 * @param {string} what
 * @param {unknown} value
 */
function need(holds, what, value) {
  if (!holds) throw new VextureError(`${what} is ${line(value)}, which no style has; ${REMEDY}`, 'style');
}

/** @param {unknown} value */
const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** @param {unknown} value */
const isPart = (value) => typeof value === 'number' && value >= 0 && value <= 1;

/** @param {unknown} value @param {number} length */
const isPlace = (value, length) => Number.isInteger(value) && /** @type {number} */ (value) >= 0 && /** @type {number} */ (value) < length;

/**
 * The groups from the outermost to a given one.
 *
 * @param {StyleGroup[]} groups
 * @param {number} inner may be -1
 */
export function groupsAround(groups, inner) {
  const around = [];
  for (let group = inner; group >= 0; group = groups[group].outer) around.unshift(group);
  return around;
}

/**
 * The colour of a stack: premultiplied sRGB and opacity, 0..1.
 *
 * @param {Style} style
 * @param {number[]} stack
 * @returns {Color}
 */
export function composited({ elements, groups }, stack) {
  /** @typedef {{ group: number, color: Color, left: number, missing: number }} Level */
  /** @param {number} group @returns {Level} */
  const level = (group) => ({ group, color: [0, 0, 0, 0], left: 1, missing: masksOf(groups, group) });
  const open = [level(-1)];
  const close = () => {
    const { group, color, left, missing } = /** @type {Level} */ (open.pop());
    const onto = open[open.length - 1];
    const { opacity, blend, mask } = groups[group];
    const share = missing ? 0 : left * opacity;
    if (mask === 'none') {
      onto.color = blended(onto.color, /** @type {Color} */ (color.map((part) => part * share)), blend);
      return;
    }
    onto.left *= share * masking(color, mask === 'opacity');
    onto.missing--;
  };
  for (const number of stack) {
    const { color, opacity, group } = elements[number];
    const around = [-1, ...groupsAround(groups, group)];
    while (open[open.length - 1].group !== around[open.length - 1]) close();
    while (open.length < around.length) open.push(level(around[open.length]));
    const top = open[open.length - 1];
    top.color = blended(top.color, [color[0] * opacity, color[1] * opacity, color[2] * opacity, opacity], 0);
  }
  while (open.length > 1) close();
  return open[0].color;
}

/**
 * How many masks a group has.
 *
 * @param {StyleGroup[]} groups
 * @param {number} group
 */
function masksOf(groups, group) {
  return groups.filter(({ outer, mask }) => mask !== 'none' && outer === group).length;
}

/**
 * The topmost element of a stack that is no mask, and that no mask hides of which nothing is there; null without any.
 *
 * @param {Style} style
 * @param {number[]} stack
 * @returns {number | null}
 */
function topmost({ elements, groups }, stack) {
  const met = new Set(stack.flatMap((number) => groupsAround(groups, elements[number].group)));
  const isHidden = (/** @type {number} */ group) =>
    groups[group].mask !== 'none' || groups.some(({ outer, mask }, place) => mask !== 'none' && outer === group && !met.has(place));
  const seen = stack.filter((number) => !groupsAround(groups, elements[number].group).some(isHidden));
  return seen.at(-1) ?? null;
}

/**
 * The topmost element of a map at a point of the unit square; null where nothing is.
 *
 * @param {import('./data.js').PackedData} data
 * @param {import('./data.js').Root} root a map with a style
 * @param {number} u
 * @param {number} v upwards
 */
export function topmostAt(data, { style, quad }, u, v) {
  const { paint } = paintAt(data, quad, u, v);
  const element = style && paint !== null ? topmost(style, style.stacks[paint]) : null;
  return style && element !== null ? { name: style.elements[element].name, element } : null;
}
