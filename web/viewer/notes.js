/** Short messages over the picture, read out by screen readers. */
import { element } from './dom.js';

const SHOWN_FOR = 8000; // ms

export class Notes {
  #timer = 0;
  #lasting = '';

  constructor() {
    this.element = element('div', { role: 'status', 'aria-live': 'polite', class: 'notes' });
  }

  /** A message that goes by itself. @param {string} message */
  say(message) {
    this.#show(message);
    this.#timer = window.setTimeout(() => this.#show(this.#lasting), SHOWN_FOR);
  }

  /** A message that stays until it is taken back by ''. @param {string} message */
  keep(message) {
    const taken = this.#lasting;
    this.#lasting = message;
    if (message || this.element.textContent === taken) this.#show(message);
  }

  /** @param {string} message */
  #show(message) {
    clearTimeout(this.#timer);
    this.element.textContent = message;
  }
}
