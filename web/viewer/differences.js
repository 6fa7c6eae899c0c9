/** A badge that says how the picture differs from its source; it opens the list, and marks what is drawn of it. */
import { element } from './dom.js';
import { svgElement, svgLayer } from './svg.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./library.js').Note} Note
 * @typedef {import('./library.js').Subject} Subject
 */

/** @type {Record<Note['kind'], string>} */
const HEADINGS = { 'left out': 'Left out', simplified: 'Simplified', invalid: 'Invalid and ignored', remark: 'Remark' };

/** Pixels between what is drawn and its mark. */
const MARGIN = 4;

/** @param {Note} note */
const textOf = ({ message, count }) => (count > 1 ? `${message} (${count})` : message);

/**
 * @param {Engine} engine
 * @param {import('./state.js').State} state
 */
export function create(engine, state) {
  const layer = svgLayer(engine, 'differences-layer');
  const list = element('ul', { id: 'differences', class: 'differences-list', 'aria-label': 'Differences', hidden: true });
  const button = element('button', {
    type: 'button', class: 'badge', 'aria-controls': 'differences', 'aria-expanded': 'false',
    onclick: () => open(list.hidden),
  });
  const box = element('div', { class: 'differences', hidden: true, onkeydown: (/** @type {KeyboardEvent} */ event) => {
    if (event.key !== 'Escape' || list.hidden) return;
    open(false);
    button.focus();
  } }, button, list);
  /** @type {Subject[]} */
  let marked = [];
  /** @type {Subject | null} */
  let chosen = null;

  /** @param {boolean} isOpen */
  function open(isOpen) {
    list.hidden = !isOpen;
    button.setAttribute('aria-expanded', String(isOpen));
    mark();
  }

  function mark() {
    const isShown = !list.hidden && state.value.mode === 'flat';
    layer.replaceChildren(...(isShown ? marked.map(markOf) : []));
  }

  /** @param {Subject} subject */
  function markOf(subject) {
    const [left, bottom, right, top] = /** @type {NonNullable<Subject['box']>} */ (subject.box);
    const [x, y] = engine.toScreen(left, top);
    const [ex, ey] = engine.toScreen(right, bottom);
    return svgElement('rect', { class: subject === chosen ? 'difference chosen' : 'difference', x: x - MARGIN,
      y: y - MARGIN, width: ex - x + 2 * MARGIN, height: ey - y + 2 * MARGIN, rx: MARGIN });
  }

  /** @param {Subject | null} subject */
  const choose = (subject) => {
    chosen = subject;
    mark();
  };

  /** @param {Subject} subject */
  function rowOf(subject) {
    const { name, box: place } = subject;
    if (!place) return element('li', {}, `${name}, not drawn`);
    const [left, bottom, right, top] = place;
    return element('li', {}, element('button', {
      type: 'button', title: 'Show it in the middle',
      onclick: () => state.update({ mode: 'flat', center: [(left + right) / 2, (bottom + top) / 2] }),
      onfocus: () => choose(subject), onblur: () => choose(null),
      onpointerenter: () => choose(subject), onpointerleave: () => choose(null),
    }, name));
  }

  function update() {
    const notes = (engine.document?.manifest.facts?.notes ?? []).filter(({ kind }) => kind !== 'remark');
    const subjects = notes.flatMap(({ elements }) => elements);
    box.hidden = notes.length === 0;
    if (box.hidden) open(false);
    button.textContent = `differs from the source: ${notes.map(textOf).join(', ')}`;
    list.replaceChildren(...notes.map((note) => element('li', {},
      element('span', { class: 'kind' }, HEADINGS[note.kind]), ` ${textOf(note)}`,
      ...(note.elements.length ? [element('ul', {}, ...note.elements.map(rowOf))] : []))));
    chosen = null;
    marked = subjects.filter(({ box: place }) => place);
    mark();
  }

  engine.addEventListener('shape', update);
  engine.addEventListener('view', mark);
  state.addEventListener('change', mark);
  update();
  return box;
}
