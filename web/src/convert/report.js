// Notes on one document.
import { Notes } from './notes.js';

/** @param {string} text @param {number} longest */
export const shortenText = (text, longest) => (text.length > longest ? `${text.slice(0, longest)}...` : text);

/** The notes on a document, of which it labels the elements. */
export class Report extends Notes {
  /** @param {import('./page-engine.js').Engine} engine */
  constructor(engine) {
    super();
    this.engine = engine;
    /** @type {Set<string>} */
    this.seen = new Set();
  }

  /** Note a value that the standard does not allow. @param {string} name @param {string} value @param {any} element */
  invalid(name, value, element) {
    const short = shortenText(value, 40).split(/\s+/).filter(Boolean).join(' ');
    this.count('invalid', `${name}='${short}' of ${this.describe(element)}`);
  }

  /** @param {any} element @returns {string} a label for messages; a page has no numbers of lines */
  describe(element) {
    const id = this.engine.attribute(element, 'id');
    return `<${this.engine.tag(element).slice(0, 40)}${id ? ` id="${id.slice(0, 40)}"` : ''}>`;
  }
}
