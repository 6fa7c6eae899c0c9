// Notes of a reader: everything left out, simplified or invalid, with the words of Python's readers.

/** @typedef {'left out' | 'simplified' | 'invalid' | 'remark'} Kind kind of a note */

/**
 * @typedef {object} Note One observation about a source.
 * @property {Kind} kind `left out`: not in the result. `simplified`: not as it should be. `invalid`: against the standard and
 *   ignored. `remark`: a sentence about the whole
 * @property {string} message such as `<text>`
 * @property {number} count of occurrences
 */

/** @type {readonly Kind[]} */
const KINDS = ['left out', 'simplified', 'invalid', 'remark'];

/** Collects notes and counts repeated ones. */
export class Notes {
  /** @type {Map<string, Note>} */
  counts = new Map();

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

  /** All notes by kind; within a kind, by first occurrence. @returns {Note[]} */
  get inOrder() {
    const notes = [...this.counts.values()];
    return KINDS.flatMap((kind) => notes.filter((note) => note.kind === kind));
  }
}
