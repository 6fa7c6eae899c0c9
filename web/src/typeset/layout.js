// Lines as places of glyphs: alignment, anchors, carets and bounds; y up.
import * as hb from 'harfbuzzjs';
import { graphemeEnds } from './breaks.js';
import { primaryFont } from './runs.js';
import { kindOf } from './shapes.js';

/** @import { Line, Piece } from './lines.js' */
/** @import { Kind, Shape, Shapes } from './shapes.js' */
/** @import { Style } from './style.js' */

/** @typedef {[number, number, number, number]} Box least x and y, largest x and y */

/**
 * @typedef {object} Result
 * @property {Uint32Array} shapes index of each visible glyph's shape
 * @property {Float32Array} places of each: left, bottom and side of its unit square
 * @property {Uint32Array} clusters UTF-16 index where the glyph's cluster begins
 * @property {Float32Array} carets of each index, and of the end: x at its start and end edge, bottom and top of its line
 * @property {{ first: number, end: number, baseline: number, left: number, right: number }[]} lines
 * @property {Box} blockBounds
 * @property {Box} visibleBounds all 0 if nothing is visible
 * @property {number} ascender
 * @property {number} descender
 * @property {number} capHeight
 * @property {number} xHeight
 * @property {number} lineHeight
 * @property {number[]} missing
 * @property {string[]} notes
 * @property {boolean} hasInk whether its colours are in some of its shapes
 * @property {{ shapes: Uint32Array, places: Float32Array }} [outlines] the same glyphs, wider by `outlineWidth`
 * @property {{ shapes: Uint32Array, places: Float32Array }} [strokes] lines of `strokeWidth` along their edges
 */

/** Characters between which a justified line without spaces is stretched. */
const IDEOGRAPH = /[\p{scx=Han}\p{scx=Hiragana}\p{scx=Katakana}\p{scx=Hangul}\p{scx=Bopomofo}]/u;

/** Heights of a line above and below its baseline. @typedef {{ over: number, under: number, ascender: number, descender: number }} Heights */

/** Further shapes of the same glyphs. */
class Drawn {
  /** @type {number[]} */
  shapes = [];
  /** @type {number[]} */
  places = [];

  /** @param {Kind[]} kinds upright and turned */
  constructor(kinds) {
    this.kinds = kinds;
  }

  /** @param {Shape} shape @param {number} x @param {number} y @param {number} scale */
  add(shape, x, y, scale) {
    this.shapes.push(shape.place);
    this.places.push(x + shape.x * scale, y + shape.y * scale, shape.side * scale);
  }

  /** @param {number} dx @param {number} dy */
  moved(dx, dy) {
    return { shapes: Uint32Array.from(this.shapes), places: shifted(this.places, dx, dy) };
  }
}

/** Places of glyphs, moved. @param {number[]} places @param {number} dx @param {number} dy */
function shifted(places, dx, dy) {
  const floats = new Float32Array(places.length);
  for (let k = 0; k < places.length; k += 3) {
    floats[k] = places[k] + dx;
    floats[k + 1] = places[k + 1] + dy;
    floats[k + 2] = places[k + 2];
  }
  return floats;
}

/** A layout that is being made. */
class Layout {
  /** @type {number[]} */
  shapes = [];
  /** @type {number[]} */
  places = [];
  /** @type {number[]} */
  clusters = [];
  hasInk = false;

  /**
   * @param {string} text
   * @param {Style} style
   * @param {Shapes} all
   */
  constructor(text, style, all) {
    this.text = text;
    this.style = style;
    this.all = all;
    const { outlineWidth, strokeWidth, fontSize } = style;
    const both = (/** @type {Kind['part']} */ part, /** @type {number} */ width) =>
      [false, true].map((isTurned) => kindOf(part, width / fontSize, isTurned));
    this.kinds = both('', 0);
    this.outlines = outlineWidth > 0 && fontSize > 0 ? new Drawn(both('o', outlineWidth)) : null;
    this.strokes = strokeWidth > 0 && fontSize > 0 ? new Drawn(both('s', strokeWidth)) : null;
    this.carets = new Float64Array(4 * (text.length + 1));
    /** @type {Box} */
    this.ink = [Infinity, Infinity, -Infinity, -Infinity];
  }

  /**
   * Place the glyphs of a line.
   *
   * @param {Line} line
   * @param {number} start of the line, along it
   * @param {number} base across it: the baseline, or the middle of a vertical line
   * @param {Heights} heights
   * @param {{ space: number, letter: number }} stretch for a justified line
   */
  place(line, start, base, heights, stretch) {
    let at = start;
    const isStretched = stretch.space || stretch.letter;
    const end = line.pieces.reduce((last, piece) => (piece.start < line.end - trailOf(this.text, line) ? Math.max(last, piece.end) : last), 0);
    for (const piece of line.pieces) {
      const extra = (/** @type {number} */ from, /** @type {number} */ to) => stretchOf(this.text, from, to, end, stretch);
      at = this.#placePiece(piece, at, base, heights, isStretched && piece.start < end ? extra : null);
    }
    return at;
  }

  /**
   * @param {Piece} piece
   * @param {number} at
   * @param {number} base
   * @param {Heights} heights
   * @param {((from: number, to: number) => number) | null} extra
   */
  #placePiece(piece, at, base, heights, extra) {
    const { shaped, from, to, scale, spacing } = piece, { clusters, isReversed } = shaped;
    for (let k = from; k < to; ) {
      const cluster = clusters[k];
      let next = k + 1;
      while (next < to && clusters[next] === cluster) next++;
      const after = isReversed ? (k > from ? clusters[k - 1] : piece.end) : next < to ? clusters[next] : piece.end;
      const room = spacing + (extra ? extra(cluster, after) : 0), begin = at;
      if (isReversed) at += room;
      for (let n = k; n < next; n++) {
        if (shaped.glyphs[n] >= 0 && scale > 0) this.#placeGlyph(piece, n, at, base);
        at += shaped.advances[n] * scale;
      }
      if (!isReversed) at += room;
      this.#setCarets(piece, k, next, begin, at, after, base, heights);
      k = next;
    }
    return at;
  }

  /** @param {Piece} piece @param {number} k @param {number} at @param {number} base */
  #placeGlyph({ shaped, scale }, k, at, base) {
    const { isVertical } = this.style, { instance } = shaped, isTurned = isVertical && !shaped.isUpright;
    const glyph = shaped.glyphs[k], shape = this.all.of(instance, glyph, this.#kindOf(instance, glyph, isTurned, shaped.clusters[k]));
    if (!shape) return;
    const dx = shaped.dx[k] * scale, dy = shaped.dy[k] * scale;
    let x = at + dx, y = base + dy;
    if (isTurned) [x, y] = [base + dy - ((instance.ascender + instance.descender) / 2) * scale, -at - dx];
    else if (isVertical) [x, y] = [base + dx, dy - at];
    const left = x + shape.x * scale, bottom = y + shape.y * scale, { ink } = this;
    this.shapes.push(shape.place);
    this.places.push(left, bottom, shape.side * scale);
    this.clusters.push(shaped.clusters[k]);
    for (const drawn of [this.outlines, this.strokes]) {
      const more = drawn && this.all.of(instance, glyph, drawn.kinds[Number(isTurned)]);
      if (more) drawn.add(more, x, y, scale);
    }
    if (left < ink[0]) ink[0] = left;
    if (bottom < ink[1]) ink[1] = bottom;
    if (left + shape.width * scale > ink[2]) ink[2] = left + shape.width * scale;
    if (bottom + shape.height * scale > ink[3]) ink[3] = bottom + shape.height * scale;
  }

  /** @param {import('./font.js').Instance} instance @param {number} glyph @param {boolean} isTurned @param {number} cluster */
  #kindOf(instance, glyph, isTurned, cluster) {
    if (!instance.owner.hasColor || !this.all.hasInk(instance, glyph)) return this.kinds[Number(isTurned)];
    this.hasInk = true;
    const ink = this.style.inks.findLast(([start]) => start <= cluster)?.[1] ?? '';
    return kindOf('', 0, isTurned, ink);
  }

  /**
   * @param {Piece} piece
   * @param {number} k first glyph of the cluster
   * @param {number} next
   * @param {number} begin of the cluster, along the line
   * @param {number} end
   * @param {number} after index of the text after the cluster
   * @param {number} base
   * @param {Heights} heights
   */
  #setCarets({ shaped, scale }, k, next, begin, end, after, base, { ascender, descender }) {
    const { clusters, isReversed, instance } = shaped, start = clusters[k], count = after - start;
    const ends = count === 1 ? [1] : graphemeEnds(this.text.slice(start, after));
    const inner = ends.length > 1 && next === k + 1 ? instance.caretsOf(shaped.glyphs[k], isReversed ? hb.Direction.RTL : hb.Direction.LTR) : null;
    const edge = (/** @type {number} */ n) => {
      const isInner = n > 0 && n < ends.length && inner?.length === ends.length - 1;
      if (isInner) return begin + inner[isReversed ? ends.length - 1 - n : n - 1] * scale;
      const share = n / ends.length;
      return isReversed ? end + (begin - end) * share : begin + (end - begin) * share;
    };
    let at = 0;
    for (let n = 0; n < ends.length; n++) {
      for (; at < ends[n]; at++) this.setCaret(start + at, edge(n), edge(n + 1), base + descender, base + ascender);
    }
  }

  /** @param {number} index @param {number} start @param {number} end @param {number} low @param {number} high */
  setCaret(index, start, end, low, high) {
    const sign = this.style.isVertical ? -1 : 1, at = 4 * index;
    this.carets[at] = sign * start;
    this.carets[at + 1] = sign * end;
    this.carets[at + 2] = low;
    this.carets[at + 3] = high;
  }
}

/**
 * Lay out lines.
 *
 * @param {string} text
 * @param {Line[]} lines
 * @param {Style} style
 * @param {Shapes} shapes
 * @returns {Omit<Result, 'missing' | 'notes'>}
 */
export function layOut(text, lines, style, shapes) {
  const layout = new Layout(text, style, shapes), { isVertical, fontSize } = style;
  const primary = style.instance(primaryFont(style.fonts)), unit = fontSize / primary.em;
  const usual = heightsOf(primary, unit, style), heights = lines.map((line) => lineHeights(line, usual, style));
  const length = lines.reduce((most, { width, indent }) => Math.max(most, width + indent), 0);
  const isFilled = style.textAlign === 'justify' && style.maxWidth < Infinity && lines.some(({ isSoft }) => isSoft);
  const block = isFilled ? Math.max(length, style.maxWidth) : length;
  const thickness = heights.reduce((sum, { over, under }) => sum + over + under, 0);
  const [dx, dy] = shiftOf(style, block, thickness, heights, primary, unit);
  /** @type {Result['lines']} */
  const shown = [];
  let across = isVertical ? thickness : 0; // top of the next line, or its right side
  lines.forEach((line, k) => {
    const { over, under } = heights[k], base = isVertical ? across - (over + under) / 2 : across - over;
    across -= over + under;
    const spare = block - line.width - line.indent, { start, stretch } = alignmentOf(text, line, spare, style);
    const isLeftToRight = !(line.level & 1);
    const own = isVertical ? { ...heights[k], ascender: (over + under) / 2, descender: -(over + under) / 2 } : heights[k];
    const trail = isLeftToRight ? 0 : line.trail; // hangs to the left
    const end = layout.place(line, start - trail, base, own, stretch);
    const right = isLeftToRight ? end - line.trail : end;
    for (let index = line.end; index < line.next || index === text.length; index++) { // line ends, and the end of the text
      const at = isLeftToRight ? end : start - trail;
      layout.setCaret(index, at, at, base + own.descender, base + own.ascender);
    }
    const edges = isVertical
      ? { baseline: base + dx, left: dy - start, right: dy - right }
      : { baseline: base + dy, left: start + dx, right: right + dx };
    shown.push({ first: line.first, end: line.end, ...edges });
  });
  const [width, height] = isVertical ? [thickness, block] : [block, thickness];
  return {
    ...moved(layout, dx, dy), lines: shown, blockBounds: [dx, dy - height, dx + width, dy],
    ascender: primary.ascender * unit, descender: primary.descender * unit, capHeight: primary.capHeight * unit, xHeight: primary.xHeight * unit,
    lineHeight: usual.over + usual.under,
  };
}

/** The arrays of a layout, shifted. @param {Layout} layout @param {number} dx @param {number} dy */
function moved({ shapes, places, clusters, carets, ink, style, outlines, strokes, hasInk }, dx, dy) {
  const edges = new Float32Array(carets.length);
  const [along, over] = style.isVertical ? [dy, dx] : [dx, dy];
  for (let k = 0; k < carets.length; k++) edges[k] = carets[k] + (k & 2 ? over : along);
  const visibleBounds = /** @type {Box} */ (shapes.length ? [ink[0] + dx, ink[1] + dy, ink[2] + dx, ink[3] + dy] : [0, 0, 0, 0]);
  return {
    shapes: Uint32Array.from(shapes), places: shifted(places, dx, dy), clusters: Uint32Array.from(clusters), carets: edges, visibleBounds, hasInk,
    ...(outlines && { outlines: outlines.moved(dx, dy) }), ...(strokes && { strokes: strokes.moved(dx, dy) }),
  };
}

/**
 * Heights of a line of one font.
 *
 * @param {import('./font.js').Instance} instance
 * @param {number} scale
 * @param {Style} style
 * @returns {Heights}
 */
function heightsOf(instance, scale, { lineHeight, fontSize }) {
  const ascender = instance.ascender * scale, descender = instance.descender * scale;
  const spare = lineHeight === null ? instance.lineGap * scale : lineHeight * fontSize - (ascender - descender);
  return { over: ascender + spare / 2, under: spare / 2 - descender, ascender, descender };
}

/**
 * Heights of a line: those of its fonts if they are normal, or else those of the first font.
 *
 * @param {Line} line
 * @param {Heights} usual
 * @param {Style} style
 * @returns {Heights}
 */
function lineHeights(line, usual, style) {
  if (style.lineHeight !== null) return usual;
  let { over, under, ascender, descender } = usual;
  for (const { shaped, scale } of line.pieces) {
    const own = heightsOf(shaped.instance, scale, style);
    over = Math.max(over, own.over);
    under = Math.max(under, own.under);
    ascender = Math.max(ascender, own.ascender);
    descender = Math.min(descender, own.descender);
  }
  return { over, under, ascender, descender };
}

/**
 * Shift of a block whose left upper corner is the origin.
 *
 * @param {Style} style
 * @param {number} block length of the longest line
 * @param {number} thickness of all lines
 * @param {Heights[]} heights
 * @param {import('./font.js').Instance} primary
 * @param {number} unit
 * @returns {[number, number]}
 */
function shiftOf({ anchorX, anchorY, isVertical }, block, thickness, heights, primary, unit) {
  const [width, height] = isVertical ? [thickness, block] : [block, thickness];
  const x = typeof anchorX === 'number' ? anchorX : /** @type {{ share: number }} */ (anchorX).share * width;
  if (typeof anchorY === 'number') return [0 - x, 0 - anchorY];
  if (typeof anchorY === 'object') return [0 - x, anchorY.share * height];
  const first = isVertical ? 0 : heights[0].over, last = isVertical ? height : height - heights[heights.length - 1].under;
  const down = { // from the top of the block
    top: 0, 'top-baseline': first, 'top-cap': first - primary.capHeight * unit, 'top-ex': first - primary.xHeight * unit,
    middle: height / 2, 'bottom-baseline': last, bottom: height,
  }[anchorY];
  return [0 - x, /** @type {number} */ (down)];
}

/**
 * Where a line starts, and how much it is stretched.
 *
 * @param {string} text
 * @param {Line} line
 * @param {number} spare length of the block that the line leaves
 * @param {Style} style
 */
function alignmentOf(text, line, spare, { textAlign }) {
  const isReversed = Boolean(line.level & 1), none = { space: 0, letter: 0 };
  const stretch = textAlign === 'justify' && line.isSoft && spare > 0 ? stretches(text, line, spare) : null;
  const side = { left: 0, right: 1, center: 0.5, justify: isReversed ? 1 : 0, start: isReversed ? 1 : 0, end: isReversed ? 0 : 1 }[textAlign] ?? 0;
  const indent = isReversed ? 0 : line.indent; // that of a line from right to left is at its right end
  return stretch ? { start: indent, stretch } : { start: indent + side * spare, stretch: none };
}

/** @param {string} text @param {Line} line */
function trailOf(text, { first, end }) {
  let at = end;
  while (at > first && /\s/.test(text[at - 1])) at--;
  return end - at;
}

/** @param {string} text @param {Line} line @param {number} spare */
function stretches(text, line, spare) {
  const end = line.end - trailOf(text, line);
  let spaces = 0, letters = 0;
  for (let at = line.first; at < end; at++) {
    if (text[at] === ' ' || text[at] === '\u00a0') spaces++;
    else if (at + 1 < end && IDEOGRAPH.test(text[at])) letters++;
  }
  if (spaces) return { space: spare / spaces, letter: 0 };
  return letters ? { space: 0, letter: spare / letters } : null;
}

/**
 * What a cluster of a justified line has more.
 *
 * @param {string} text
 * @param {number} from
 * @param {number} to
 * @param {number} end of the line, without the spaces there
 * @param {{ space: number, letter: number }} stretch
 */
function stretchOf(text, from, to, end, { space, letter }) {
  let sum = 0;
  for (let at = from; at < Math.min(to, end); at++) {
    if (text[at] === ' ' || text[at] === '\u00a0') sum += space;
    else if (letter && at + 1 < end && IDEOGRAPH.test(text[at])) sum += letter;
  }
  return sum;
}
