// Calculations of CSS in values that a browser leaves as they are, because they contain percentages.

const TOKEN = /\s*(?:([+-]?(?:\d*\.\d+|\d+)(?:e[+-]?\d+)?)([a-z%]*)|(calc|min|max|clamp|)(\()|([-+*/,)]))/iy;

/** @typedef {{ value: number, isLength: boolean }} Quantity */

/**
 * The value of `calc()`, `min()`, `max()` or `clamp()`.
 *
 * @param {string} text
 * @param {(unit: string) => number | null} factor user units of a unit; null if it is unknown
 * @returns {number | null} null if it is not valid
 */
export function calculate(text, factor) {
  const tokens = tokensOf(text);
  if (!tokens) return null;
  let at = 0;

  /** @returns {Quantity} */
  const atom = () => {
    const token = tokens[at++];
    if (token?.[4]) {
      const parts = [sum()];
      while (tokens[at]?.[5] === ',') {
        at++;
        parts.push(sum());
      }
      if (tokens[at++]?.[5] !== ')') throw new SyntaxError();
      return called((token[3] ?? '').toLowerCase(), parts);
    }
    const size = token?.[1] === undefined ? null : token[2] ? factor(token[2].toLowerCase()) : 1;
    if (size === null) throw new SyntaxError();
    return { value: Number(token[1]) * size, isLength: Boolean(token[2]) };
  };

  const product = () => {
    let left = atom();
    for (let sign = tokens[at]?.[5]; sign === '*' || sign === '/'; sign = tokens[at]?.[5]) {
      at++;
      const right = atom();
      if (right.isLength && (left.isLength || sign === '/')) throw new SyntaxError();
      const value = sign === '*' ? left.value * right.value : left.value / right.value;
      left = { value, isLength: left.isLength || right.isLength };
    }
    return left;
  };

  /** @returns {Quantity} */
  const sum = () => {
    let left = product();
    for (let sign = tokens[at]?.[5]; sign === '+' || sign === '-'; sign = tokens[at]?.[5]) {
      at++;
      const right = product();
      left = { value: left.value + (sign === '+' ? right.value : -right.value), isLength: left.isLength };
    }
    return left;
  };

  try {
    const { value } = sum();
    return at === tokens.length ? value : null;
  } catch {
    return null;
  }
}

/** @param {string} name @param {Quantity[]} parts @returns {Quantity} */
function called(name, parts) {
  const values = parts.map((part) => part.value);
  const { isLength } = parts[0];
  if (name === 'min') return { value: Math.min(...values), isLength };
  if (name === 'max') return { value: Math.max(...values), isLength };
  if (name === 'clamp' && values.length === 3) return { value: Math.max(values[0], Math.min(values[1], values[2])), isLength };
  if (name === 'clamp' || parts.length > 1) throw new SyntaxError();
  return parts[0];
}

/** @param {string} text @returns {RegExpExecArray[] | null} */
function tokensOf(text) {
  const tokens = [];
  const trimmed = text.trim();
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < trimmed.length) {
    const match = TOKEN.exec(trimmed);
    if (!match) return null;
    tokens.push(match);
  }
  return tokens;
}
