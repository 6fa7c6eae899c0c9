/**
 * An error that the user can act on: a damaged file, a missing shape, a refused request.
 *
 * The message is one line: what is wrong, what is allowed, what to do.
 */
export class VextureError extends Error {
  /**
   * @param {string} message one line
   * @param {string} field name of the value at fault, such as `vkFormat`, `vexture.roots` or `quad 17`
   * @param {{ cause?: unknown }} [options] the error that this one is due to
   */
  constructor(message, field, options) {
    super(message, options);
    /** `VextureError`. */
    this.name = 'VextureError';
    /** Name of the value at fault. */
    this.field = field;
  }

  /**
   * The same error with the name of the file or address in front of its message.
   *
   * @param {string} where
   * @returns {VextureError}
   */
  in(where) {
    return new VextureError(`${where}: ${this.message}`, this.field, { cause: this });
  }
}

/** Remedy for most damaged files. */
export const REMEDY = 'convert the drawing again';

const LONGEST = 60;

/**
 * Text as part of a one-line message: white space and control characters collapsed, cut to 60 characters.
 *
 * @param {string} text
 */
export function shortened(text) {
  const words = text.replace(/[\s\p{Cc}]+/gu, ' ').trim();
  return words.length > LONGEST ? `${words.slice(0, LONGEST)}...` : words;
}

/**
 * An untrusted value as part of a one-line message: an error's own message, anything else as JSON if it has any.
 *
 * @param {unknown} value
 * @returns {string}
 */
export function line(value) {
  return shortened(value instanceof Error ? value.message : typeof value === 'number' ? String(value) : json(value));
}

/**
 * The error about a value of a wrong kind, such as undefined where a texture is needed.
 *
 * @param {string} name of the parameter
 * @param {unknown} value
 * @param {string} remedy
 */
export function unfit(name, value, remedy) {
  const kind = typeof value === 'object' && value !== null ? `of the class ${line(value.constructor?.name)}` : line(value);
  return new VextureError(`the ${name} is ${kind}; ${remedy}`, name);
}

/**
 * Options that were given, or none; null stands for none, too.
 *
 * @template {object} T
 * @param {T | null | undefined} options
 * @param {string} [name]
 * @returns {T}
 * @throws {VextureError} if they are no object
 */
export function givenOptions(options, name = 'options') {
  const given = options ?? /** @type {T} */ ({});
  if (typeof given === 'object' && !Array.isArray(given)) return given;
  throw new VextureError(`the ${name} are ${line(given)}; give an object, such as { ... } or none`, name);
}

/** @param {unknown} value */
function json(value) {
  try {
    return JSON.stringify(value) ?? String(value);
  } catch { // it is a bigint, or holds itself
    return String(value);
  }
}
