/** Short messages over the picture, read out by screen readers. */
import { element } from './dom.js';

const SHOWN_FOR = 8000; // ms

export class Notes {
  #timer = 0;
  /** What is wrong, or under way, by what it is about. @type {Map<string, string>} */
  #lasting = new Map();

  constructor() {
    this.element = element('div', { role: 'status', 'aria-live': 'polite', class: 'notes' });
  }

  /** A message that disappears after a while. @param {string} message */
  say(message) {
    this.#show(message);
    this.#timer = window.setTimeout(() => this.#show(this.#all()), SHOWN_FOR);
  }

  /**
   * A message that stays until it is replaced by another one of the same subject, or by null.
   *
   * @param {string} subject @param {string} message
   */
  keep(subject, message) {
    const before = this.#all();
    this.#lasting.delete(subject);
    if (message) this.#lasting.set(subject, message);
    if (message || this.element.textContent === before) this.#show(this.#all());
  }

  #all() {
    return [...this.#lasting.values()].join(' · ');
  }

  /** @param {string} message */
  #show(message) {
    clearTimeout(this.#timer);
    this.element.textContent = message;
  }
}
