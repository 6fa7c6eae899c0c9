/** Legend of the colours of the water. */
import { element } from '../viewer/dom.js';
import { short } from './shades.js';

/**
 * Texts of the classes, each with its colour.
 *
 * @param {NonNullable<ReturnType<typeof import('./shades.js').shadeOf>>} shade
 * @returns {{color: string, text: string}[]}
 */
export function entries({ colors: { classes, smooth }, unit, texts, end }) {
  return classes.map(({ from, color }, at) => {
    if (texts) return { color: String(color), text: texts[at] };
    const next = classes[at + 1]?.from ?? end;
    const range = next === undefined ? `over ${short(from)}` : `${short(from)} to ${short(next)}`;
    return { color: String(color), text: `${smooth ? short(from) : range} ${unit}` };
  });
}

export class Legend {
  constructor() {
    this.element = element('section', { class: 'legend', 'aria-label': 'Legend', hidden: true });
  }

  /** @param {ReturnType<typeof import('./shades.js').shadeOf>} shade */
  show(shade) {
    this.element.hidden = shade === null;
    if (!shade) return;
    const rows = entries(shade).map(({ color, text }) => {
      const swatch = element('span', { class: 'swatch' });
      swatch.style.background = color;
      return element('li', {}, swatch, text);
    });
    this.element.replaceChildren(element('strong', {}, shade.title), element('ul', {}, ...rows));
  }
}
