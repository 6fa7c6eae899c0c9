// Shapes of a texture by their names.
import { VextureError, line } from './errors.js';

const MOST_NEAR = 5;

/**
 * Letters to change, add or leave out between two words (Levenshtein distance).
 *
 * @param {string} one
 * @param {string} other
 */
function distance(one, other) {
  let row = Array.from({ length: other.length + 1 }, (_, place) => place);
  for (let i = 1; i <= one.length; i++) {
    const next = [i];
    for (let j = 1; j <= other.length; j++) {
      next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (one[i - 1] === other[j - 1] ? 0 : 1)));
    }
    row = next;
  }
  return row[other.length];
}

/**
 * Place of a root by its name or place.
 *
 * @param {import('./data.js').Root[]} roots
 * @param {string | number} which
 * @param {string} texture its name, for messages
 * @returns {number}
 * @throws {VextureError} if there is none; it says which names are near
 */
export function indexOf(roots, which, texture) {
  if (typeof which === 'number') {
    if (Number.isInteger(which) && which >= 0 && which < roots.length) return which;
    throw new VextureError(`${texture}: no root ${which}; they are numbered 0 to ${roots.length - 1}`, 'root');
  }
  const place = roots.findIndex((root) => root.name === which);
  if (place >= 0) return place;
  const far = new Map(roots.map(({ name }) => [name, distance(which.slice(0, 99), name.slice(0, 99))]));
  const near = [...far].sort((a, b) => a[1] - b[1]).slice(0, MOST_NEAR);
  const listed = near.map(([name]) => line(name)).join(', ');
  throw new VextureError(
    `${texture}: no root ${line(which)}; near names are ${listed}; there are ${roots.length}`,
    'root',
  );
}
