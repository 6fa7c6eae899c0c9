/** The time of a map that has steps: a slider, and a button that lets it run. */
import { element } from '../viewer/dom.js';
import { keepEvents } from './own-events.js';

/** Steps a second while it runs. */
const PACE = 4;

const PLAY = '▶';
const PAUSE = '❚❚';

export class TimeBar {
  #label = element('output', {});
  #slider = element('input', { type: 'range', min: 0, step: 1, 'aria-label': 'Time', oninput: () => this.#chosen(Number(this.#slider.value)) });
  #button = element('button', { type: 'button', 'aria-label': 'Play', onclick: () => (this.#frame === 0 ? this.#play() : this.stop()) }, PLAY);
  element = element('div', { class: 'vexture-time', hidden: true }, this.#button, this.#slider, this.#label);
  #frame = 0;
  /** @type {string[]} */
  #names = [];
  #time = 0;
  #go;

  /** @param {(time: number) => void} go called with a time in steps that was chosen */
  constructor(go) {
    this.#go = go;
    keepEvents(this.element);
  }

  /** @param {string[]} names of the steps; none hide it @param {number} time in steps */
  show(names, time) {
    this.element.hidden = names.length === 0;
    if (this.element.hidden) this.stop();
    this.#names = names;
    this.#time = time;
    this.#slider.max = String(names.length - 1);
    this.#slider.value = String(Math.round(time));
    this.#label.textContent = names[Math.round(time)] ?? '';
    this.#slider.setAttribute('aria-valuetext', this.#label.textContent);
  }

  stop() {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#button.textContent = PLAY;
    this.#button.ariaLabel = 'Play';
  }

  /** @param {number} time */
  #chosen(time) {
    this.stop();
    this.#go(time);
  }

  /** Go on step by step, from the first one again at the end. */
  #play() {
    const start = performance.now();
    const first = Math.round(this.#time);
    let shown = first;
    const count = this.#names.length;
    const next = (/** @type {number} */ now) => {
      const step = (first + Math.floor(PACE * (now - start) / 1000)) % count;
      if (step !== shown) this.#go(shown = step);
      this.#frame = requestAnimationFrame(next);
    };
    this.#frame = requestAnimationFrame(next);
    this.#button.textContent = PAUSE;
    this.#button.ariaLabel = 'Pause';
  }
}
