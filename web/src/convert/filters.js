// Filters (Filter Effects 1), which notes list but which are not drawn.
import { FILTER_STEPS } from '../../generated/svg-reader.js';
import { number } from './lengths.js';

/** Name of a filter without steps, which hides its element. */
export const HIDING = '';

const MOST_STEPS = 4;
const TOKEN = /\s*(?:url\(\s*(['"]?)(.*?)\1\s*\)|([\w-]+)\((?:[^()]|\([^()]*\))*\))\s*/y;

/**
 * The name of a filter for a note: `HIDING`, or null if there is no filter.
 *
 * @param {string} value
 * @param {import('./page-engine.js').Engine} engine
 * @returns {string | null}
 */
export function filterLabel(value, engine) {
  const lists = [];
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < value.length) {
    const match = TOKEN.exec(value);
    if (!match) return null;
    if (match[3]) lists.push([match[3].toLowerCase().replaceAll('-', ' ')]);
    else {
      const target = engine.target(match[2]);
      if (!target || engine.name(target) !== 'filter') return null;
      lists.push(stepsOf(target, engine));
    }
  }
  return lists.every((list) => list.length) ? `filter of ${joinNames([...new Set(lists.flat())])}` : HIDING;
}

/**
 * @param {any} element
 * @param {import('./page-engine.js').Engine} engine
 * @returns {string[]} names of a filter's steps
 */
function stepsOf(element, engine) {
  for (const name of ['width', 'height']) {
    const side = number((engine.attribute(element, name) ?? '1').trim().replace(/%$/, ''));
    if (side !== null && side <= 0) return [];
  }
  const names = engine.children(element).map((child) => engine.name(child) ?? '').filter((name) => FILTER_STEPS.includes(name));
  return names.map((name) => name.slice(2).replace(/(?<=[a-z])(?=[A-Z])/g, ' ').toLowerCase().replace(/^gaussian /, ''));
}

/** @param {string[]} all @returns {string} names as in a sentence */
function joinNames(all) {
  const names = all.length > MOST_STEPS ? [...all.slice(0, MOST_STEPS), 'more'] : all;
  return [names.slice(0, -1).join(', '), names[names.length - 1]].filter(Boolean).join(' and ');
}
