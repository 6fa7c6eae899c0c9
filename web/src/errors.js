/**
 * An error that the user can act on: a damaged file, a missing shape, a refused request.
 *
 * The message is one line: what is wrong, what is allowed, and how to fix it.
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
   * Prefix the error's message with the name of the file or address.
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
 * Prepare a text for a one-line message: collapse white space and control characters, and cut it to 60 characters.
 *
 * @param {string} text
 */
export function shortened(text) {
  const words = text.replace(/[\s\p{Cc}]+/gu, ' ').trim();
  return words.length > LONGEST ? `${words.slice(0, LONGEST)}...` : words;
}

/**
 * Format an untrusted value for a one-line message: an error's own message, or anything else as JSON if possible.
 *
 * @param {unknown} value
 * @returns {string}
 */
export function line(value) {
  return shortened(value instanceof Error ? value.message : typeof value === 'number' ? String(value) : json(value));
}

/**
 * Make the error for a value of a wrong kind, such as undefined in place of a texture.
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
 * Return options, or an empty object for null and undefined.
 *
 * @template {object} T
 * @param {T | null | undefined} options
 * @param {string} [name]
 * @returns {T}
 * @throws {VextureError} if they are not an object
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
  } catch { // a bigint, a circular object, or lists in one another by the thousand
    return shallow(value);
  }
}

/** @param {unknown} value */
function shallow(value) {
  try {
    return String(value);
  } catch {
    return 'a value nested too deeply';
  }
}
