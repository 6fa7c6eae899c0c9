// Where lines may break (UAX 14), and user-perceived characters (UAX 29).
// @ts-expect-error: the package has no types
import LineBreaker from 'linebreak';

/** Characters of a line's end, each pair of CR and LF as one. */
export const NEWLINE = /\r\n|[\n\r\v\f\u0085\u2028\u2029]/g;

/** Texts of which each UTF-16 unit is a user-perceived character. */
const SIMPLE = /^[^\r\u00ad\u0300-\uffff]*$/;

const segmenter = 'Segmenter' in Intl ? new Intl.Segmenter(undefined, { granularity: 'grapheme' }) : null;

/** User-perceived characters of browsers without `Intl.Segmenter`. */
const ROUGH = /\p{RI}{2}|(?:\P{M}(?:[\p{M}\p{EMod}\u{e0020}-\u{e007f}]*\u200d\p{ExtPict})*[\p{M}\p{EMod}\u200d\u{e0020}-\u{e007f}]*)|[^]/gu;

/**
 * The ends of the user-perceived characters of a text.
 *
 * @param {string} text
 * @returns {number[]}
 */
export function graphemeEnds(text) {
  if (SIMPLE.test(text)) return Array.from(text, (_, place) => place + 1);
  if (segmenter) return Array.from(segmenter.segment(text), ({ index, segment }) => index + segment.length);
  return Array.from(text.matchAll(ROUGH), (match) => match.index + match[0].length);
}

/**
 * Places in a paragraph before which a line may break; the last is its end.
 *
 * @param {string} text of one paragraph
 * @returns {number[]}
 */
export function breaksOf(text) {
  const breaker = new LineBreaker(text), places = [];
  for (let next = breaker.nextBreak(); next; next = breaker.nextBreak()) places.push(next.position);
  if (places.at(-1) !== text.length) places.push(text.length);
  return places;
}
