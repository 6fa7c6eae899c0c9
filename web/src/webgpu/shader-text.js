// The shader in the language of a backend, for one choice of numbers; each choice has names of its own.
import { coverage } from '../../generated/coverage-nodes.js';
import { fold } from '../../generated/fold-nodes.js';
import { WRAPS } from '../../generated/wraps.js';
import { withMaps } from '../maps.js';

/**
 * @typedef {object} NodeVariant All that makes one text differ from another.
 * @property {boolean} colours whether it reads planar maps
 * @property {0 | 1 | 2} gradients whether maps hold gradients (1) or pictures as well (2)
 * @property {boolean} linear whether colours are averaged in linear light
 * @property {'none' | 'clamp' | 'repeat'} wrap
 * @property {boolean} flat
 * @property {boolean} fold
 *
 * @typedef {'glsl' | 'wgsl'} Language
 */

const colour = withMaps(async () => (await import('../../generated/colour-nodes.js')).colour);

/** What differs between the languages: `@GLSL$WGSL``. */
const PAIR = /@([^$]*)\$([^`]*)`/g;

const DIRECTIVE = /^#(\w+) ?(\w+)?(?: == (\w+))?/;

const NAME = /\b[vV]exture\w*/g;

/**
 * A text without its conditionals, which WGSL does not have; mirror of vexture.wgsl.chosen. What `#ifndef` defines
 * otherwise is always given.
 *
 * @param {string} text
 * @param {Readonly<Record<string, number>>} numbers
 */
function chosen(text, numbers) {
  /** @type {{ taken: boolean, here: boolean }[]} */
  const open = [];
  const kept = text.split('\n').filter((line) => {
    const [, word, name = '', value] = DIRECTIVE.exec(line) ?? [];
    if (word === undefined) return open.every(({ here }) => here);
    if (word === 'endif') open.pop();
    else if (word !== 'define') {
      const taken = word.startsWith('if') ? false : Boolean(open.pop()?.taken);
      const holds = word === 'else' || (word !== 'ifndef' && numbers[name] === Number(value ?? (numbers[name] || -1)));
      open.push({ taken: taken || holds, here: holds && !taken });
    }
    return false;
  });
  return kept.join('\n');
}

/**
 * Ending of all names of a variant, so that a program can hold several.
 *
 * @param {NodeVariant} variant
 */
export function endingOf({ colours, gradients, linear, wrap, flat, fold: folds }) {
  const bits = [gradients === 2, colours, gradients > 0, linear, flat, folds].reduce((sum, bit) => 2 * sum + Number(bit), 0);
  return `_${WRAPS[wrap]}${bits.toString(36)}`;
}

/**
 * @param {NodeVariant} variant
 * @param {Language} language
 * @returns {string}
 */
export function shaderText(variant, language) {
  const numbers = {
    VEXTURE_FLAT: Number(variant.flat),
    VEXTURE_GRADIENTS: variant.gradients,
    VEXTURE_LINEAR: Number(variant.linear),
    VEXTURE_WRAP: WRAPS[variant.wrap],
  };
  const both = coverage + (variant.colours ? colour() : '') + (variant.fold ? fold : '');
  const text = both.replace(PAIR, language === 'glsl' ? '$1' : '$2');
  return chosen(text, numbers).replace(NAME, `$&${endingOf(variant)}`);
}
