/** What a map has beside its picture: a legend of its colours, and what is known of the feature under the pointer. */
import { element } from '../viewer/dom.js';
import { keepEvents } from './own-events.js';

/**
 * @typedef {import('./widget.js').Model} Model
 * @typedef {{ title: string, kind: string, entries: { label: string, color: string }[] }} Legend
 */

/** Pixels between the pointer and what is told of the feature under it. */
const APART = 14;

/** Part of a narrow stage that a legend may cover without having been opened: a tap on its title opens it. */
const COVERED = 0.1;

/** Open a legend where it leaves enough of the map. @param {HTMLDetailsElement} legend @param {HTMLElement} stage @param {boolean} isWide */
export function openIfSmall(legend, stage, isWide) {
  legend.open = true; // so that it has its size
  legend.open = isWide || legend.offsetWidth * legend.offsetHeight < COVERED * stage.clientWidth * stage.clientHeight;
}

/**
 * @param {Legend | null | undefined} legend
 * @param {boolean} open
 * @returns {HTMLDetailsElement} empty without a legend
 */
export function legendOf(legend, open) {
  const box = element('details', { class: 'vexture-legend', hidden: !legend, open }, element('summary', {}, legend?.title ?? ''));
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
    box.append(element('div', { class: 'entry', title: label }, patch, element('span', {}, label)));
  }
  return box;
}

/** Facts about a feature beside the pointer; of elements that no notebook styles, as JupyterLab does lists. */
export class Tip {
  element = element('div', { class: 'vexture-tip', hidden: true });

  /** @param {[string, string][] | null | undefined} facts @param {[number, number] | null} place in pixels @param {HTMLElement} stage */
  show(facts, place, stage) {
    const shown = Boolean(facts?.length && place);
    this.element.hidden = !shown;
    if (!shown || !place) return;
    this.element.replaceChildren(...(facts ?? []).flatMap(([name, value]) => [element('div', { class: 'name' }, name), element('div', {}, value)]));
    const { clientWidth: width, clientHeight: height } = stage;
    while (this.element.offsetHeight > height && this.element.childElementCount > 2) this.#shorten();
    const [x, y] = place;
    const left = x + APART + this.element.offsetWidth > width ? x - APART - this.element.offsetWidth : x + APART;
    const top = y + APART + this.element.offsetHeight > height ? y - APART - this.element.offsetHeight : y + APART;
    this.element.style.translate = `${Math.max(0, left)}px ${Math.max(0, top)}px`;
  }

  /** Leave out the last fact. */
  #shorten() {
    for (let k = 0; k < 2; k++) this.element.lastElementChild?.remove();
  }
}
