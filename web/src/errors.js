/**
 * Something that a person can act upon: a damaged file, a shape that is not there, a server that refuses.
 *
 * Its message is one line: what is wrong, what it must be, what to do.
 */
export class VextureError extends Error {
  /**
   * @param {string} message
   * @param {string} field name of what is at fault, such as `vkFormat`, `vexture.roots` or `quad 17`
   * @param {{ cause?: unknown }} [options]
   */
  constructor(message, field, options) {
    super(message, options);
    this.name = 'VextureError';
    /** Name of what is at fault. */
    this.field = field;
  }

  /**
   * The same error, of something that has a name.
   *
   * @param {string} where a file's name or address
   * @returns {VextureError}
   */
  in(where) {
    return new VextureError(`${where}: ${this.message}`, this.field, { cause: this });
  }
}

/** What to do about most damage. */
export const REMEDY = 'convert the drawing again';

const LONGEST = 60;

/**
 * Something of a stranger's as a part of one short line.
 *
 * @param {unknown} value
 * @returns {string}
 */
export function line(value) {
  const text = value instanceof Error ? value.message : (JSON.stringify(value) ?? String(value));
  const words = text.replace(/[\s\p{Cc}]+/gu, ' ').trim();
  return words.length > LONGEST ? `${words.slice(0, LONGEST)}...` : words;
}
