/** The drawings of an atlas as a sheet of thumbnails, with a search and names to copy. Only what is seen is there. */
import { copyText } from './copy.js';
import { element } from './dom.js';
import { drawingsIn } from './drawing.js';
import { HOME } from './state.js';
import { svgElement } from './svg.js';
import { Thumbnails } from './thumbnails.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 * @typedef {import('./drawing.js').Range} Range
 */

/** Sizes of a cell in CSS pixels: its least width, and the height of the name below its picture. */
const FINE = Object.freeze({ least: 132, label: 36 });
/** Where fingers point. */
const COARSE = Object.freeze({ least: 160, label: 48 });
const MARGIN = 8;
const TOUCHED = matchMedia('(pointer: coarse), (max-width: 720px)');
/** Rows beyond what is seen that are there, too. */
const OVERSCAN = 1;
const COPY_ICON = 'M5 1h9v10h-2v-8h-7zM2 4h9v11h-9zM3.5 5.5v8h6v-8z';

/**
 * The drawings whose names hold all words of a search.
 *
 * @param {Range[]} all
 * @param {string} search
 */
function matching(all, search) {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  return words.length ? all.filter(({ name }) => words.every((word) => name.toLowerCase().includes(word))) : all;
}

/**
 * Where the cells of a sheet lie.
 *
 * @param {number} width of the sheet, in CSS pixels
 * @param {number} count of cells
 * @param {{least: number, label: number}} sizes
 */
function layoutOf(width, count, sizes) {
  const columns = Math.max(1, Math.floor(width / sizes.least));
  const cell = Math.floor(width / columns);
  const row = cell + sizes.label;
  return { columns, cell, row, thumb: cell - 2 * MARGIN, height: row * Math.ceil(count / columns) };
}

class Sheet {
  /** @type {Range[]} */
  #all = [];
  /** @type {Range[]} */
  #found = [];
  /** What is there of them, by their place among those found. @type {Map<number, HTMLElement>} */
  #cells = new Map();
  /** @type {WeakMap<HTMLElement, HTMLCanvasElement>} */
  #blank = new WeakMap();
  #turn = 0;
  #frame = 0;
  /** For which the cells were made. */
  #width = 0;

  /** @param {Engine} engine @param {State} state @param {(message: string) => void} note */
  constructor(engine, state, note) {
    this.engine = engine;
    this.state = state;
    this.note = note;
    this.thumbnails = new Thumbnails(engine);
    this.search = element('input', {
      type: 'search', placeholder: 'Search names', 'aria-label': 'Search names', autocomplete: 'off', spellcheck: 'false',
      oninput: () => this.#find(), onkeydown: (/** @type {KeyboardEvent} */ event) => this.#searchKey(event),
    });
    this.count = element('output', { class: 'sheet-count', 'aria-live': 'polite' });
    this.list = element('ul', { role: 'list', 'aria-label': 'Drawings', onkeydown: (/** @type {KeyboardEvent} */ event) => this.#listKey(event) });
    this.scroller = element('div', { class: 'sheet-scroll', onscroll: () => this.#later() }, this.list);
    this.element = element('section', { class: 'sheet', 'aria-label': 'All drawings', hidden: true },
      element('div', { class: 'sheet-head' }, this.search, this.count), this.scroller);
    new ResizeObserver(() => this.#resized()).observe(this.scroller);
  }

  get isOpen() {
    return !this.element.hidden;
  }

  /** @param {Range[]} all */
  open(all) {
    const isNew = all.map(({ name }) => name).join('\n') !== this.#all.map(({ name }) => name).join('\n');
    this.#all = all;
    this.engine.covered = true;
    this.element.hidden = false;
    if (isNew) this.search.value = '';
    this.#find(isNew);
  }

  close() {
    if (!this.isOpen) return;
    this.element.hidden = true;
    this.engine.covered = false;
    this.engine.render(); // its canvas holds thumbnails
  }

  /** Draw all again, on another background. */
  redraw() {
    if (this.isOpen) this.#refill();
  }

  /** Take the focus to the cell of a drawing, if it is found. @param {string} name */
  focus(name) {
    const place = this.#found.findIndex((one) => one.name === name);
    if (place >= 0) this.#go(place);
  }

  /** @param {boolean} [fromTop] */
  #find(fromTop = true) {
    this.#found = matching(this.#all, this.search.value);
    const text = (/** @type {number} */ value) => value.toLocaleString('en');
    this.count.value = this.search.value.trim() ? `${text(this.#found.length)} of ${text(this.#all.length)}` : text(this.#all.length);
    if (fromTop) this.scroller.scrollTop = 0;
    this.#refill();
  }

  #resized() {
    const { clientWidth } = this.list;
    if (clientWidth === 0 || clientWidth === this.#width) return this.#later();
    this.#width = clientWidth;
    this.#refill();
  }

  #refill() {
    for (const cell of this.#cells.values()) cell.remove();
    this.#cells.clear();
    this.#later();
  }

  #layout() {
    return layoutOf(this.list.clientWidth, this.#found.length, TOUCHED.matches ? COARSE : FINE);
  }

  #later() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      if (this.isOpen) this.#fill();
    });
  }

  /** Make the cells that are seen, and remove the others. */
  #fill() {
    const { columns, row, thumb, height } = this.#layout();
    const { scrollTop, clientHeight } = this.scroller;
    this.list.style.height = `${height}px`;
    const first = Math.max(0, (Math.floor(scrollTop / row) - OVERSCAN) * columns);
    const end = Math.min(this.#found.length, (Math.ceil((scrollTop + clientHeight) / row) + OVERSCAN) * columns);
    for (const [place, cell] of this.#cells) {
      if (place >= first && place < end) continue;
      if (cell.contains(document.activeElement)) continue; // or the keys would lead nowhere
      cell.remove();
      this.#cells.delete(place);
    }
    for (let place = first; place < end; place++) {
      if (!this.#cells.has(place)) this.#cells.set(place, this.#cellOf(place));
    }
    const inOrder = [...this.#cells].sort(([one], [other]) => one - other).map(([, cell]) => cell);
    inOrder.forEach((cell, i) => {
      if (this.list.children[i] !== cell) this.list.insertBefore(cell, this.list.children[i] ?? null);
    });
    void this.#draw(thumb);
  }

  /** @param {number} place */
  #cellOf(place) {
    const { columns, cell, row, thumb } = this.#layout();
    const { name } = this.#found[place];
    const canvas = element('canvas', { 'aria-hidden': 'true' });
    canvas.style.cssText = `width: ${thumb}px; height: ${thumb}px`;
    const icon = svgElement('svg', { viewBox: '0 0 16 16', 'aria-hidden': 'true' }, svgElement('path', { d: COPY_ICON, 'fill-rule': 'evenodd' }));
    const made = element('li', { 'aria-setsize': this.#found.length, 'aria-posinset': place + 1, 'data-place': place },
      element('button', { type: 'button', class: 'sheet-open', title: name, onclick: () => this.#choose(name) },
        canvas, element('span', {}, name)),
      element('button', {
        type: 'button', class: 'sheet-copy', 'aria-label': `Copy the name ${name}`, title: 'Copy the name', onclick: () => void this.#copy(name),
      }, icon));
    made.style.cssText = `left: ${cell * (place % columns)}px; top: ${row * Math.floor(place / columns)}px; width: ${cell}px; height: ${row}px`;
    this.#blank.set(made, canvas);
    return made;
  }

  /** @param {number} thumb side in CSS pixels */
  async #draw(thumb) {
    const { texture, ratio } = this.engine;
    const mine = ++this.#turn;
    const blank = [...this.#cells].filter(([, cell]) => this.#blank.has(cell));
    if (!texture || blank.length === 0) return;
    const wanted = blank.map(([place, cell]) => ({
      range: this.#found[place], canvas: /** @type {HTMLCanvasElement} */ (this.#blank.get(cell)),
    }));
    let isDone = true;
    await this.thumbnails.draw(texture, wanted, Math.round(thumb * ratio), () =>
      (isDone = mine === this.#turn && this.isOpen && this.engine.texture === texture));
    if (isDone) for (const [, cell] of blank) this.#blank.delete(cell);
  }

  /** @param {string} name */
  #choose(name) {
    this.state.update({ drawing: name, ...HOME });
  }

  /** @param {string} name */
  async #copy(name) {
    this.note(await copyText(name) ? `${name} is copied.` : `This browser does not let the page copy; the name is ${name}.`);
  }

  /** Bring a cell into view, and the focus to it. @param {number} place */
  #go(place) {
    const { columns, row } = this.#layout();
    const [top, { scrollTop, clientHeight }] = [row * Math.floor(place / columns), this.scroller];
    if (top < scrollTop) this.scroller.scrollTop = top;
    else if (top + row > scrollTop + clientHeight) this.scroller.scrollTop = top + row - clientHeight;
    this.#fill();
    this.#cells.get(place)?.querySelector('button')?.focus({ preventScroll: true });
  }

  /** @param {KeyboardEvent} event */
  #searchKey(event) {
    if (event.key === 'ArrowDown' && this.#found.length) this.#go(0);
    else if (event.key === 'Enter' && this.#found.length) this.#choose(this.#found[0].name);
    else return;
    event.preventDefault();
  }

  /** @param {KeyboardEvent} event */
  #listKey(event) {
    const cell = /** @type {HTMLElement | null} */ (/** @type {HTMLElement} */ (event.target).closest('li'));
    if (!cell || event.ctrlKey || event.metaKey || event.altKey) return;
    const { columns } = this.#layout();
    const place = Number(cell.dataset.place);
    /** @type {Record<string, number>} */
    const to = {
      ArrowLeft: place - 1, ArrowRight: place + 1, ArrowUp: place - columns, ArrowDown: place + columns, Home: 0,
      End: this.#found.length - 1,
    };
    if (event.key in to) {
      event.preventDefault();
      if (to[event.key] < 0) this.search.focus();
      else if (to[event.key] < this.#found.length) this.#go(to[event.key]);
    } else if (event.key === 'Escape' || (event.key.length === 1 && event.key !== ' ')) this.search.focus(); // the letter goes there
  }
}

/**
 * The sheet, which opens where a texture holds several drawings and none is chosen, and the button that leads back to it.
 *
 * @param {Engine} engine
 * @param {State} state
 * @param {HTMLElement} app gets the class `choosing` while the sheet is open
 * @param {(message: string) => void} note
 */
export function createSheet(engine, state, app, note) {
  const sheet = new Sheet(engine, state, note);
  let last = '';
  const leave = () => state.update({ drawing: '' });
  const back = element('button', { type: 'button', class: 'back', hidden: true, onclick: leave }, '‹ All drawings');
  const follow = () => {
    const all = engine.texture ? drawingsIn(engine.texture) : [];
    const isOpen = all.length > 1 && state.value.drawing === '';
    app.classList.toggle('choosing', isOpen);
    back.hidden = isOpen || all.length < 2;
    if (!isOpen) {
      last = state.value.drawing;
      return sheet.close();
    }
    sheet.open(all);
    if (last) sheet.focus(last);
    last = '';
  };
  engine.addEventListener('shape', follow);
  engine.addEventListener('restored', () => sheet.redraw());
  state.addEventListener('change', (event) => {
    const { changed } = /** @type {CustomEvent} */ (event).detail;
    if (changed.has('background') || changed.has('theme')) sheet.redraw();
  });
  engine.canvas.parentElement?.addEventListener('keydown', ({ key }) => {
    if (key === 'Escape' && !back.hidden) leave();
  });
  return [sheet.element, back];
}
