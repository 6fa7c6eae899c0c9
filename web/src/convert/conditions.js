// Which elements are drawn, and what a reader notes about the outermost one as a CSS box.
import { CONTAINERS, LANGUAGE } from '../../generated/svg-reader.js';
import { SHAPES } from './shapes.js';

/** Elements that are drawn; a `switch` prefers them to unknown ones. */
export const DRAWN = [...Object.keys(SHAPES), ...CONTAINERS, 'image', 'text', 'use'];

/** Properties of the outermost element as a CSS box, with the values that are visible. */
const BOX = {
  'background-image': { property: 'background-image', shows: /\(/ },
  border: { property: 'border-top-style', shows: /^(?!none|hidden)./ },
  'border-radius': { property: 'border-top-left-radius', shows: /[1-9]/ },
  'box-shadow': { property: 'box-shadow', shows: /px/ },
  outline: { property: 'outline-style', shows: /^(?!none|hidden)./ },
  padding: { property: 'padding-left', shows: /[1-9]/ },
};

/** Remarks on elements that do not change the picture. */
const REMARKS = {
  cursor: 'its cursors are left out, which no picture shows',
  view: 'its views are not followed; all of it is shown',
};

/**
 * Note what is left out of a document, and what the outermost element shows as a CSS box.
 *
 * @param {import('./page-engine.js').Engine} engine
 * @param {import('./report.js').Report} report
 * @param {import('./page-engine.js').Style} style of the outermost element
 */
export function noteParts(engine, report, style) {
  for (const [message, count] of engine.stripped) report.count('left out', message, count);
  for (const { name, value, element } of engine.invalid) report.invalid(name, value, element);
  for (const [name, message] of Object.entries(REMARKS)) if (engine.has(name)) report.remark(message);
  for (const [name, { property, shows }] of Object.entries(BOX)) {
    if (shows.test(style.get(property))) report.leftOut(`${name} of the outermost <svg>`);
  }
}

/**
 * @param {import('./page-engine.js').Engine} engine
 * @param {any} element
 * @returns {boolean} whether its conditions hold (SVG 2, 5.9)
 */
export function applies(engine, element) {
  if (engine.attribute(element, 'requiredExtensions') !== null) return false;
  const languages = engine.attribute(element, 'systemLanguage');
  return languages === null || languages.split(',').some((tag) => tag.trim().toLowerCase().split('-')[0] === LANGUAGE);
}

/**
 * @param {import('./page-engine.js').Engine} engine
 * @param {any} element
 * @returns {any[]} the child that a `switch` shows, or all for their notes
 */
export function switchChildren(engine, element) {
  const children = engine.children(element).filter((child) => engine.name(child) !== null && applies(engine, child));
  const first = children.find((child) => DRAWN.includes(engine.name(child) ?? ''));
  return first ? [first] : children;
}

