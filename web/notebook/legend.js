/** What a map has beside its picture: a legend of its colours, and what is known of the feature under the pointer. */
import { element } from '../viewer/dom.js';
import { keepEvents } from './own-events.js';

/**
 * @typedef {import('./widget.js').Model} Model
 * @typedef {{ title: string, kind: string, entries: { label: string, color: string }[] }} Legend
 */

/** Pixels between the pointer and what is told of the feature under it. */
const APART = 14;

/** Pages that are narrower have the legend closed at first: a tap on its title opens it. */
const NARROW = '(max-width: 480px)';

/** @returns {boolean} whether a legend is open before somebody has opened or closed it */
export const isWide = () => !matchMedia(NARROW).matches;

/**
 * @param {Legend | null | undefined} legend
 * @param {boolean} open
 * @returns {HTMLDetailsElement} empty without a legend
 */
export function legendOf(legend, open) {
  const title = element('summary', {}, legend?.title ?? '');
  const box = element('details', { class: 'vexture-legend', hidden: !legend, open }, title);
  keepEvents(title);
  if (!legend) return box;
  const steps = legend.kind === 'continuous' ? legend.entries.filter(({ label }) => label !== 'no data') : [];
  if (steps.length > 0) {
    const ramp = element('div', { class: 'ramp' });
    ramp.style.background = `linear-gradient(to right, ${steps.map(({ color }) => color).join(', ')})`;
    const ends = element('div', { class: 'ends' }, ...[steps[0], steps[steps.length - 1]].map(({ label }) => element('span', {}, label)));
    box.append(ramp, ends);
    legend = { ...legend, entries: legend.entries.filter((entry) => !steps.includes(entry)) };
  }
  for (const { label, color } of legend.entries) {
    const patch = element('i', {});
    patch.style.background = color;
    box.append(element('div', { class: 'entry' }, patch, label));
  }
  return box;
}

/** Facts about a feature beside the pointer. */
export class Tip {
  element = element('dl', { class: 'vexture-tip', hidden: true });

  /** @param {[string, string][] | null | undefined} facts @param {[number, number] | null} place in pixels @param {HTMLElement} stage */
  show(facts, place, stage) {
    const shown = Boolean(facts?.length && place);
    this.element.hidden = !shown;
    if (!shown || !place) return;
    this.element.replaceChildren(...(facts ?? []).flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
    const { clientWidth: width, clientHeight: height } = stage;
    const [x, y] = place;
    const left = x + APART + this.element.offsetWidth > width ? x - APART - this.element.offsetWidth : x + APART;
    const top = y + APART + this.element.offsetHeight > height ? y - APART - this.element.offsetHeight : y + APART;
    this.element.style.translate = `${Math.max(0, left)}px ${Math.max(0, top)}px`;
  }
}
