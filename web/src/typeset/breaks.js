// Where lines may break (UAX 14), and user-perceived characters (UAX 29).
import { lineBreaker } from './libraries.js';

/** Characters of a line's end, each pair of CR and LF as one. */
export const NEWLINE = /\r\n|[\n\r\v\f\u0085\u2028\u2029]/g;

/** Texts of which each UTF-16 unit is a user-perceived character. */
const SIMPLE = /^[^\r\u00ad\u0300-\uffff]*$/;

const segmenter = 'Segmenter' in Intl ? new Intl.Segmenter(undefined, { granularity: 'grapheme' }) : null;

/** UTF-16 units that are divided at once: the time of Chromium's segmenter grows with the square of their number. */
const CHUNK = 256;

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
  /** @type {number[]} */
  const ends = [];
  let length = CHUNK;
  for (let at = 0; at < text.length; ) {
    const part = text.slice(at, at + length), own = endsIn(part), isLast = at + length >= text.length;
    if (!isLast) own.pop(); // what follows may belong to it
    for (const end of own) ends.push(at + end);
    if (own.length) [at, length] = [at + own[own.length - 1], CHUNK];
    else length *= 2;
  }
  return ends;
}

/** @param {string} text */
function endsIn(text) {
  if (segmenter) return Array.from(segmenter.segment(text), ({ index, segment }) => index + segment.length);
  return Array.from(text.matchAll(ROUGH), (match) => match.index + match[0].length);
}

/**
 * Places in a paragraph before which a line may break; the last is its end. The library `lineBreaker` must be loaded.
 *
 * @param {string} text of one paragraph
 * @returns {number[]}
 */
export function breaksOf(text) {
  const breaker = new lineBreaker.content(text), places = [];
  for (let next = breaker.nextBreak(); next; next = breaker.nextBreak()) places.push(next.position);
  if (places.at(-1) !== text.length) places.push(text.length);
  return UNSPACED.test(text) && dictionary ? withWords(text, places, dictionary) : places;
}

/** Scripts without spaces between words, of which UAX 14 leaves the breaks to dictionaries. */
const UNSPACED = /[\p{Script=Thai}\p{Script=Lao}\p{Script=Khmer}\p{Script=Myanmar}]/u;
const UNSPACED_RUN = /[\p{Script=Thai}\p{Script=Lao}\p{Script=Khmer}\p{Script=Myanmar}]{1,1000}/gu;

const dictionary = 'Segmenter' in Intl ? new Intl.Segmenter(undefined, { granularity: 'word' }) : null;

/** Places with those between words of such scripts. @param {string} text @param {number[]} places @param {Intl.Segmenter} words */
function withWords(text, places, words) {
  const all = new Set(places);
  for (const { index, 0: run } of text.matchAll(UNSPACED_RUN)) {
    for (const word of words.segment(run)) if (word.index) all.add(index + word.index);
  }
  return [...all].sort((one, other) => one - other);
}
