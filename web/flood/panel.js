/** The panel over the canvas: title, views, relief, waves, notes. */
import { element } from '../viewer/dom.js';

/** @typedef {import('./presets.js').View} View */

const NARROW = matchMedia('(max-width: 720px), (max-height: 480px)');

/**
 * @param {import('./stage.js').Stage} stage
 * @param {import('./relief.js').Surface} surface
 * @param {{title: string, credits: import('./page-data.js').Credits, notes: string[], readout: Element, shades: Element, takeaway: Element,
 *   all: View[], viewed: (view: View) => void}} what
 */
export function createPanel(stage, surface, { title, credits, notes, readout, shades, takeaway, all, viewed }) {
  const views = element('div', { class: 'views', role: 'group', 'aria-label': 'Views' },
    ...all.map((view, at) => element('button', {
      type: 'button', title: `${view.name} (${at + 1})`, onclick: () => viewed(view),
    }, view.name)));
  const panel = element('aside', { class: 'panel', 'aria-label': 'Controls' });
  const body = element('div', { class: 'body', id: 'panel-body' },
    shades, reliefRow(stage, surface), wavesRow(stage), takeaway,
    element('div', { class: 'about' }, ...[...creditLines(credits), ...notes].map((note) => element('p', {}, note))));
  const fold = element('button', {
    type: 'button', class: 'fold', 'aria-label': 'Settings', title: 'Settings', 'aria-controls': 'panel-body',
    onclick: () => folded(!body.hidden),
  }, '⌄');
  const folded = (/** @type {boolean} */ wanted) => {
    body.hidden = wanted;
    fold.setAttribute('aria-expanded', String(!wanted));
  };
  folded(NARROW.matches);
  stage.canvas.addEventListener('pointerdown', () => {
    if (NARROW.matches) folded(true); // the map is what is looked at
  });
  panel.append(element('header', {}, element('h1', {}, title, ...badge(credits)), fold), views, body, readout);
  return { panel, mark: (/** @type {View | null} */ shown) => {
    for (const button of views.children) button.setAttribute('aria-pressed', String(button.textContent === shown?.name));
  } };
}

/** @param {import('./page-data.js').Credits} credits */
const badge = ({ synthetic }) => (synthetic ? [' ', element('span', { class: 'badge' }, 'synthetic')] : []);

/** What the data say of themselves. @param {import('./page-data.js').Credits} credits */
export function creditLines({ source, institution, licence, references, comment }) {
  const from = [source, institution].filter(Boolean).join(', ');
  return [comment, from && `Source: ${from}.`, licence && `Licence: ${licence}.`, references].filter(Boolean);
}

/** @param {import('./stage.js').Stage} stage @param {import('./relief.js').Surface} surface */
function reliefRow(stage, surface) {
  const most = Math.max(2, Math.ceil(surface.exaggeration * 2));
  const value = element('span', { class: 'value' });
  const slider = element('input', {
    type: 'range', id: 'relief', 'aria-label': 'Relief', min: 0, max: most, step: most / 100,
    value: surface.exaggeration,
    oninput: () => {
      stage.relief(Number(slider.value));
      follow();
    },
  });
  const follow = () => {
    const times = surface.exaggeration;
    value.textContent = `${times < 10 ? times.toFixed(1) : Math.round(times)}×`;
    slider.setAttribute('aria-valuetext', `heights ${value.textContent}`);
    if (document.activeElement !== slider) slider.value = String(times);
  };
  stage.addEventListener('relief', follow);
  follow();
  return element('div', { class: 'row' }, element('label', { for: 'relief' }, 'Relief'), slider, value);
}

/** @param {import('./stage.js').Stage} stage */
function wavesRow(stage) {
  const button = element('button', { type: 'button', 'aria-pressed': String(stage.waving), onclick: () => {
    stage.waving = !stage.waving;
    button.setAttribute('aria-pressed', String(stage.waving));
  } }, 'Waves');
  return element('div', { class: 'row' }, button);
}
