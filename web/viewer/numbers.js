/** Numbers as people read them. */

/** What stands for a number that is not known. */
export const UNKNOWN = 'not known';

/** @param {number | null | undefined} value */
export const countText = (value) => (value === null || value === undefined ? UNKNOWN : value.toLocaleString('en'));

/** @param {number | null | undefined} value */
export function bytesText(value) {
  if (value === null || value === undefined) return UNKNOWN;
  return value < 1e4 ? `${countText(value)}\u00a0B` : value < 1e7 ? `${countText(Math.round(value / 100) / 10)}\u00a0kB`
    : `${countText(Math.round(value / 1e5) / 10)}\u00a0MB`;
}
