/** What a map has beside its picture: a legend of its colours, and what is known of the feature under the pointer. */
import { element } from '../viewer/dom.js';
import { keepEvents } from './own-events.js';

/**
 * @typedef {import('./widget.js').Model} Model
 * @typedef {{ title: string, kind: string, entries: { label: string, color: string }[] }} Legend
 */

/** Pixels between the pointer and what is told of the feature under it. */
const APART = 14;

/** Part of a picture: a legend that would cover more is closed at first, and a tap on its title opens it. */
const MOST = 0.15;

/** Pixels: in pictures that are lower there is no legend. */
const LOWEST = 60;

/**
 * Show a legend where there is room for it.
 *
 * @param {HTMLDetailsElement} legend
 * @param {HTMLElement} stage
 * @param {boolean | null} isOpen whether somebody has opened or closed it; null: nobody
 */
export function fit(legend, stage, isOpen) {
  legend.hidden = legend.childElementCount < 2 || stage.clientHeight < LOWEST;
  legend.open = isOpen ?? true;
  if (isOpen === null) legend.open = legend.offsetWidth * legend.offsetHeight <= MOST * stage.clientWidth * stage.clientHeight;
}

/**
 * @param {Legend | null | undefined} legend
 * @param {(isOpen: boolean) => void} chosen hears that somebody opens or closes it
 * @returns {HTMLDetailsElement} empty without a legend
 */
export function legendOf(legend, chosen) {
  const title = element('summary', { onclick: () => chosen(!box.open) }, legend?.title ?? '');
  /** @type {HTMLDetailsElement} */
  const box = element('details', { class: 'vexture-legend', hidden: !legend }, title);
  keepEvents(box);
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
    box.append(element('div', { class: 'entry' }, patch, element('span', { title: label }, label)));
  }
  return box;
}

/** Facts about a feature beside the pointer. */
export class Tip {
  element = element('div', { class: 'vexture-tip', hidden: true }); // pages of notebooks have a look of their own for lists

  /** @param {[string, string][] | null | undefined} facts @param {[number, number] | null} place in pixels @param {HTMLElement} stage */
  show(facts, place, stage) {
    const shown = Boolean(facts?.length && place);
    this.element.hidden = !shown;
    if (!shown || !place) return;
    this.element.replaceChildren(...(facts ?? []).flatMap(([name, value]) =>
      [element('span', { class: 'name' }, name), element('span', { class: 'value' }, value)]));
    const { clientWidth: width, clientHeight: height } = stage;
    const [x, y] = place;
    const left = x + APART + this.element.offsetWidth > width ? x - APART - this.element.offsetWidth : x + APART;
    const top = y + APART + this.element.offsetHeight > height ? y - APART - this.element.offsetHeight : y + APART;
    this.element.style.translate = `${Math.max(0, left)}px ${Math.max(0, top)}px`;
  }
}
