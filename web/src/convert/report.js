// Notes on one document: everything left out, simplified or invalid, with the words of Python's reader.

/** @typedef {'left out' | 'simplified' | 'invalid' | 'remark'} Kind */

/** @typedef {{ kind: Kind, message: string, count: number }} Note */

/** @type {readonly Kind[]} */
const KINDS = ['left out', 'simplified', 'invalid', 'remark'];

/** @param {string} text @param {number} longest */
export const shortenText = (text, longest) => (text.length > longest ? `${text.slice(0, longest)}...` : text);

/** Collects notes and counts repeated ones. */
export class Report {
  /** @param {import('./page-engine.js').Engine} engine */
  constructor(engine) {
    this.engine = engine;
    /** @type {Map<string, Note>} */
    this.counts = new Map();
    /** @type {Set<string>} */
    this.seen = new Set();
  }

  /** @param {Kind} kind @param {string} message @param {number} [times] */
  count(kind, message, times = 1) {
    const text = message.replace(/(?! )[\p{C}\p{Z}]/gu, '\ufffd');
    const key = `${kind}\n${text}`;
    const note = this.counts.get(key);
    if (note) note.count += times;
    else this.counts.set(key, { kind, message: text, count: times });
  }

  /** Note an unsupported feature, which paints nothing or has no effect. @param {string} message */
  leftOut(message) {
    this.count('left out', message);
  }

  /** Note a part of the result that differs from the standard. @param {string} message */
  simplified(message) {
    this.count('simplified', message);
  }

  /** Note a sentence about the whole source. @param {string} message */
  remark(message) {
    this.count('remark', message);
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

  /** All notes by kind; within a kind, by first occurrence. @returns {Note[]} */
  get inOrder() {
    const notes = [...this.counts.values()];
    return KINDS.flatMap((kind) => notes.filter((note) => note.kind === kind));
  }
}
