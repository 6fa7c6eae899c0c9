// Paragraphs as lines: runs are shaped once, and again where a line breaks within what belongs together.
import * as hb from 'harfbuzzjs';
import { NEWLINE, breaksOf, graphemeEnds } from './breaks.js';
import { lineBreaker } from './libraries.js';
import { isCursive, levelsOf, primaryFont, runsOf } from './runs.js';
import { shapeRun } from './shaper.js';

/** @import { Loadable } from './libraries.js' */
/** @import { Run } from './runs.js' */
/** @import { Shaped } from './shaper.js' */
/** @import { Style } from './style.js' */

/**
 * @typedef {object} Piece Glyphs of a line that follow one another.
 * @property {Shaped} shaped
 * @property {number} from first glyph
 * @property {number} to glyph after the last
 * @property {number} start UTF-16 index in the text
 * @property {number} end
 * @property {number} level of embedding
 * @property {number} scale units of the text in one of the font
 * @property {number} spacing after each cluster, in units of the text
 *
 * @typedef {object} Line
 * @property {number} first UTF-16 index in the text
 * @property {number} end index after its last character
 * @property {number} next index of the line after it
 * @property {Piece[]} pieces from left to right, or from top to bottom
 * @property {number} width without spaces at its end
 * @property {number} trail width of those
 * @property {number} indent
 * @property {number} level of its paragraph
 * @property {boolean} isSoft whether the paragraph goes on
 */

/** Spaces that hang at the end of a line. */
const SPACE = /[ \t\u1680\u2000-\u2006\u2008-\u200a\u205f\u3000]/;

const SOFT_HYPHEN = '\u00ad', HYPHEN = 0x2010, HYPHEN_MINUS = 0x2d;

/** Most UTF-16 units of a run that are shaped at once. */
const LONGEST_RUN = 4096;

/** UTF-16 units of a user-perceived character that is not divided. */
const LONGEST_GRAPHEME = 64;

const TAB = '\t';

/** Part of the width of a space that a tab has at least (CSS Text 3, 4.2). */
const LEAST_TAB = 0.5;

/** Widths of a line that are more by mere rounding, relatively. */
const SAME = 1e-9;

const CONTROL = /[\p{Cc}]/u;

/** A paragraph whose runs are shaped. */
class Paragraph {
  /** @type {Shaped[]} of each run */
  #shaped;

  /**
   * @param {string} text of all paragraphs
   * @param {number} start
   * @param {number} end
   * @param {Run[]} runs their indices are those of the whole text
   * @param {Style} style
   * @param {number} level
   */
  constructor(text, start, end, runs, style, level) {
    this.text = text;
    this.start = start;
    this.end = end;
    this.runs = runs;
    this.style = style;
    this.level = level;
    this.#shaped = runs.map((run) => this.#shape(run, run.start, run.end));
    /** Places of its tabs. */
    this.tabs = runs.filter((run) => text[run.start] === TAB).map((run) => run.start);
    const space = this.tabs.length ? spaceOf(style) : 0;
    this.least = LEAST_TAB * space;
    /** Distance of places to which tabs lead. */
    this.stop = space > 0 ? style.tabSize * (space + style.letterSpacing) : 0;
    /** Where `widthOf` has come to: most callers lengthen a part. */
    this.seen = { from: -1, to: 0, next: 0, tabs: 0 };
  }

  /** Width of a tab that begins at a place of its line. @param {number} at */
  tabWidth(at) {
    const { stop, least } = this;
    if (!(stop > 0)) return 0;
    const left = (Math.floor(at / stop + SAME) + 1) * stop - at;
    return left < least ? left + stop : left;
  }

  /**
   * Width of a part as a line.
   *
   * @param {Float64Array} sums of widths, without tabs
   * @param {number} from
   * @param {number} to
   */
  widthOf(sums, from, to) {
    const { start, tabs } = this, before = sums[from - start];
    if (!tabs.length) return sums[to - start] - before;
    if (this.seen.from !== from || this.seen.to > to) this.seen = { from, to, next: firstOf(tabs.length, (k) => tabs[k] >= from), tabs: 0 };
    const { seen } = this, indent = from === start ? this.style.textIndent : 0;
    for (; tabs[seen.next] < to; seen.next++) seen.tabs += this.tabWidth(indent + sums[tabs[seen.next] - start] - before + seen.tabs);
    seen.to = to;
    return sums[to - start] - before + seen.tabs;
  }

  /** @param {Run} run @param {number} start @param {number} end */
  #shape(run, start, end) {
    const { style, text } = this;
    const direction = run.isUpright ? hb.Direction.TTB : run.level & 1 ? hb.Direction.RTL : hb.Direction.LTR;
    const shaped = shapeRun(style.instance(run.font), text, start, end, direction, style);
    if (CONTROL.test(start === 0 && end === text.length ? text : text.slice(start, end))) blankControls(shaped, text);
    return shaped;
  }

  /** Sums of the widths before each character; those of tabs, which depend on their lines, are 0. */
  sums() {
    const { start, end, runs, style } = this, sums = new Float64Array(end - start + 1);
    runs.forEach((run, k) => {
      if (this.text[run.start] === TAB) return;
      const { clusters, advances, count, instance } = this.#shaped[k], scale = style.fontSize / instance.em, spacing = spacingOf(run, style);
      for (let n = 0; n < count; n++) {
        sums[clusters[n] - start + 1] += advances[n] * scale + (n === 0 || clusters[n] !== clusters[n - 1] ? spacing : 0);
      }
    });
    for (let k = 1; k < sums.length; k++) sums[k] += sums[k - 1];
    return sums;
  }

  /**
   * The line of a part.
   *
   * @param {number} first
   * @param {number} end
   * @param {number} next
   * @returns {Line}
   */
  line(first, end, next) {
    const { text, style, runs } = this;
    let trimmed = end;
    while (trimmed > first && SPACE.test(text[trimmed - 1])) trimmed--;
    /** @type {Piece[]} */
    const pieces = [];
    const indent = first === this.start ? style.textIndent : 0;
    let width = 0, trail = 0;
    for (let k = firstOf(runs.length, (n) => runs[n].end > first); k < runs.length && runs[k].start < end; k++) {
      const run = runs[k];
      const low = Math.max(run.start, first), high = Math.min(run.end, end);
      const piece = this.#piece(run, this.#shaped[k], low, high);
      if (text[low] === TAB) widen(piece, this.tabWidth(indent + width + trail));
      const isCut = trimmed > low && trimmed < high;
      const parts = isCut ? [this.#piece(run, piece.shaped, low, trimmed), this.#piece(run, piece.shaped, trimmed, high)] : [piece];
      for (const part of parts) {
        if (part.start >= trimmed) {
          part.level = this.level; // UAX 9, rule L1
          trail += widthOf(part);
        } else {
          width += widthOf(part);
        }
        pieces.push(part);
      }
    }
    const isSoft = end < this.end;
    if (isSoft && text[end - 1] === SOFT_HYPHEN && pieces.length) {
      const hyphen = this.#hyphen(pieces[pieces.length - 1], end);
      width += widthOf(hyphen);
      pieces.push(hyphen);
    }
    return { first, end, next, pieces: inVisualOrder(pieces), width, trail, indent, level: this.level, isSoft };
  }

  /** The hyphen that a soft hyphen becomes at the end of a line. @param {Piece} last @param {number} end @returns {Piece} */
  #hyphen(last, end) {
    const { instance, isReversed } = last.shaped, hyphen = instance.owner.has(HYPHEN) ? HYPHEN : HYPHEN_MINUS;
    const direction = isReversed ? hb.Direction.RTL : hb.Direction.LTR;
    const shaped = shapeRun(instance, String.fromCodePoint(hyphen), 0, 1, direction, this.style);
    shaped.clusters.fill(end - 1);
    return { ...last, shaped, from: 0, to: shaped.count, start: end - 1, end };
  }

  /** @param {Run} run @param {Shaped} whole @param {number} low @param {number} high @returns {Piece} */
  #piece(run, whole, low, high) {
    const { style } = this;
    const [start, end] = low === run.start && high === run.end ? [0, whole.count] : rangeOf(whole, low, high);
    const isSafe = start >= 0 && (low === run.start || canCut(whole, low)) && (high === run.end || canCut(whole, high));
    const shaped = isSafe ? whole : this.#shape(run, low, high);
    const [from, to] = isSafe ? [start, end] : [0, shaped.count];
    return { shaped, from, to, start: low, end: high, level: run.level, scale: style.fontSize / shaped.instance.em, spacing: spacingOf(run, style) };
  }
}

/**
 * The lines of a text.
 *
 * @param {string} text
 * @param {Style} style
 * @param {Set<Loadable>} needed what must be loaded first is added; then there are no lines
 * @param {Set<number>} missing characters that no font has are added
 * @returns {Line[]}
 */
export function linesOf(text, style, needed, missing) {
  const paragraphs = [];
  let start = 0;
  for (const { end, next } of partsOf(text)) {
    const part = start === 0 && end === text.length ? text : text.slice(start, end);
    const { levels, level } = levelsOf(part, style.direction, needed);
    const runs = runsOf(part, { fonts: style.fonts, levels, isVertical: style.isVertical, needed, missing });
    paragraphs.push({ start, end, next, runs: start || part.length > LONGEST_RUN ? movedRuns(runs, start, text) : runs, level });
    start = next;
  }
  if (style.wraps && !lineBreaker.isLoaded) needed.add(lineBreaker);
  if (needed.size) return [];
  return paragraphs.flatMap(({ start, end, next, runs, level }) => {
    const paragraph = new Paragraph(text, start, end, runs, style, level);
    const isWrapped = style.wraps && end > start;
    return isWrapped ? wrap(paragraph, next) : [paragraph.line(start, end, next)];
  });
}

/** Ends of paragraphs, and starts of those after them. @param {string} text */
function partsOf(text) {
  const parts = Array.from(text.matchAll(NEWLINE), (match) => ({ end: match.index, next: match.index + match[0].length }));
  parts.push({ end: text.length, next: text.length });
  return parts;
}

/** Runs with the indices of the whole text; long ones are divided. @param {Run[]} runs @param {number} start @param {string} text */
function movedRuns(runs, start, text) {
  /** @type {Run[]} */
  const moved = [];
  for (const run of runs) {
    let at = run.start + start;
    const last = run.end + start;
    while (last - at > LONGEST_RUN) {
      const space = text.lastIndexOf(' ', at + LONGEST_RUN);
      const end = space > at ? space : at + (graphemeEnds(text.slice(at, at + LONGEST_RUN)).at(-2) ?? LONGEST_RUN);
      moved.push({ ...run, start: at, end });
      at = end;
    }
    moved.push({ ...run, start: at, end: last });
  }
  return moved;
}

/** @param {Run} run @param {Style} style */
const spacingOf = (run, style) => (style.letterSpacing && !isCursive(run.script) ? style.letterSpacing : 0);

/**
 * Break a paragraph into lines that are no wider than allowed, if its words are not.
 *
 * @param {Paragraph} paragraph
 * @param {number} next start of the paragraph after it
 * @returns {Line[]}
 */
function wrap(paragraph, next) {
  const { text, start, end, style } = paragraph, { maxWidth } = style;
  const sums = paragraph.sums(), limit = maxWidth * (1 + SAME);
  if (paragraph.widthOf(sums, start, end) + style.textIndent <= limit) return [paragraph.line(start, end, next)];
  const places = breaksOf(text.slice(start, end)).map((place) => place + start);
  const trimmed = (/** @type {number} */ from, /** @type {number} */ to) => {
    while (to > from && SPACE.test(text[to - 1])) to--;
    return paragraph.widthOf(sums, from, to);
  };
  /** @type {Line[]} */
  const lines = [];
  let from = start, at = 0;
  while (from < end) {
    const room = limit - (from === start ? style.textIndent : 0);
    let last = at; // of the places, the last up to which the line fits
    while (last < places.length && trimmed(from, places[last]) <= room) last++;
    const goesOn = (/** @type {number} */ to) => (to === end ? next : to);
    let line = null;
    for (last--; last >= at && !line; last--) {
      const tried = paragraph.line(from, places[last], goesOn(places[last]));
      if (tried.width <= room) line = tried;
    }
    line ??= style.breaksWords ? brokenWord(paragraph, sums, from, places[at], room, goesOn) : paragraph.line(from, places[at], goesOn(places[at]));
    lines.push(line);
    from = line.end;
    while (at < places.length && places[at] <= from) at++;
  }
  return lines;
}

/**
 * The line of a word that is too wide: as many user-perceived characters as fit, one at least.
 *
 * @param {Paragraph} paragraph
 * @param {Float64Array} sums of widths
 * @param {number} from
 * @param {number} to
 * @param {number} room
 * @param {(to: number) => number} goesOn
 */
function brokenWord(paragraph, sums, from, to, room, goesOn) {
  const { start, text } = paragraph;
  let near = from; // where the line is too long, if shaping the parts of the word does not change much
  while (near < to && sums[near + 1 - start] - sums[from - start] <= room) near++;
  const ends = graphemeEnds(text.slice(from, Math.min(near + LONGEST_GRAPHEME, to)));
  let last = ends.findLastIndex((end) => from + end <= near);
  for (; last > 0; last--) {
    const line = paragraph.line(from, from + ends[last], goesOn(from + ends[last]));
    if (line.width <= room) return line;
  }
  return paragraph.line(from, from + ends[0], goesOn(from + ends[0]));
}

/** Width of a space of a text. @param {Style} style */
function spaceOf(style) {
  const { font, em } = style.instance(primaryFont(style.fonts)), space = font.nominalGlyph(0x20);
  return ((space === undefined ? em / 4 : font.glyphHAdvance(space)) * style.fontSize) / em;
}

/** Give a tab a width. @param {Piece} piece @param {number} width */
function widen(piece, width) {
  piece.shaped = { ...piece.shaped, advances: piece.shaped.advances.map(() => (piece.scale > 0 ? width / piece.scale : 0)) };
  piece.spacing = 0;
}

/** Make control characters blank. @param {Shaped} shaped @param {string} text */
function blankControls(shaped, text) {
  for (let k = 0; k < shaped.count; k++) {
    const code = text.charCodeAt(shaped.clusters[k]);
    if (code >= 0x20 && (code < 0x7f || code > 0x9f)) continue;
    shaped.glyphs[k] = -1;
    shaped.advances[k] = 0;
  }
}

/** The glyphs of a part of a run; -1 if none begins there. @param {Shaped} shaped @param {number} low @param {number} high */
function rangeOf({ clusters, count, isReversed }, low, high) {
  const from = isReversed ? firstOf(count, (k) => clusters[k] < high) : firstOf(count, (k) => clusters[k] >= low);
  const to = isReversed ? firstOf(count, (k) => clusters[k] < low) : firstOf(count, (k) => clusters[k] >= high);
  return [from < to ? from : -1, to];
}

/** The first index from which on a test is true, by bisection. @param {number} count @param {(k: number) => boolean} test */
function firstOf(count, test) {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (test(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}

/** Whether a run may be cut before a character. @param {Shaped} shaped @param {number} place */
function canCut({ clusters, unsafe, count, isReversed }, place) {
  if (unsafe?.has(place)) return false;
  return clusters[firstOf(count, isReversed ? (k) => clusters[k] <= place : (k) => clusters[k] >= place)] === place;
}

/** @param {Piece} piece */
function widthOf({ shaped: { advances, clusters }, from, to, scale, spacing }) {
  let width = 0, count = 0;
  for (let k = from; k < to; k++) {
    width += advances[k];
    if (k === from || clusters[k] !== clusters[k - 1]) count++;
  }
  return width * scale + count * spacing;
}

/** Pieces in the order in which they are shown (UAX 9, rule L2). @param {Piece[]} pieces */
function inVisualOrder(pieces) {
  const highest = pieces.reduce((most, { level }) => Math.max(most, level), 0);
  for (let level = highest; level > 0; level--) {
    for (let from = 0; from < pieces.length; from++) {
      let end = from;
      while (end < pieces.length && pieces[end].level >= level) end++;
      if (end - from > 1) pieces.splice(from, end - from, ...pieces.slice(from, end).reverse());
      from = Math.max(from, end);
    }
  }
  return pieces;
}
