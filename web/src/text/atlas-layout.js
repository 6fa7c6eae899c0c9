// Lines of a font whose characters are baked: from left to right, one character after the other.

/** @import { AtlasGlyph, AtlasMetrics } from './atlas-font.js' */
/** @import { Request, TextLayout, TextLine } from './layout.js' */

/** @typedef {{ index: number, length: number, glyph: AtlasGlyph, advance: number, isBlank: boolean, isTab: boolean }} Letter */

/** @typedef {{ letters: Letter[], width: number, indent: number, first: number, end: number }} Row in ems */

/** Width of a space of a font without one, in ems. */
const DEFAULT_SPACE = 0.25;

/**
 * Set a text.
 *
 * @param {AtlasMetrics} metrics
 * @param {Omit<Request, 'fonts'>} wanted
 * @returns {TextLayout}
 */
export function setLines(metrics, wanted) {
  const { text, fontSize, textAlign } = wanted;
  const request = fontSize > 0 ? wanted : { ...wanted, letterSpacing: 0, textIndent: 0, maxWidth: Infinity, fontSize: 1 }; // shows nothing
  const { lines } = metrics;
  /** @type {Set<number>} */
  const missing = new Set();
  const rows = rowsOf(lettersOf(metrics, request, missing), request, metrics.glyphs[' ']?.advance ?? DEFAULT_SPACE);
  const normal = lines.ascender - lines.descender + lines.line_gap;
  const leading = request.lineHeight === 'normal' ? normal : request.lineHeight;
  const widest = rows.reduce((most, { width, indent }) => Math.max(most, width + indent), 0);
  const height = rows.length * leading;
  const first = (leading - (lines.ascender - lines.descender)) / 2 + lines.ascender; // half of the leading is above
  const marks = { first, last: first + (rows.length - 1) * leading, height, ...lines };
  const x0 = -anchorAcross(request.anchorX, widest, fontSize), y0 = anchorDown(request.anchorY, marks, fontSize);
  const shift = { center: 0.5, right: 1, end: 1 }[/** @type {'center'} */ (textAlign)] ?? 0;
  /** @type {number[]} */
  const shapes = [];
  /** @type {number[]} */
  const places = [];
  /** @type {number[]} */
  const clusters = [];
  const carets = new Float32Array(4 * (text.length + 1));
  const ink = [Infinity, Infinity, -Infinity, -Infinity];
  /** @type {TextLine[]} */
  const set = rows.map(({ letters, width, indent, first: start, end }, row) => {
    const baseline = y0 - (first + row * leading) * fontSize, left = x0 + (indent + shift * (widest - width - indent)) * fontSize;
    let x = left;
    for (const { index, length, glyph, advance } of letters) {
      const after = x + advance * fontSize;
      for (let k = 0; k < length; k++) {
        carets.set([k ? after : x, after, baseline + lines.descender * fontSize, baseline + lines.ascender * fontSize], 4 * (index + k));
      }
      if (glyph.shape !== null && glyph.square && glyph.box && fontSize > 0) {
        shapes.push(glyph.shape);
        clusters.push(index);
        const [dx, dy, side] = glyph.square;
        places.push(x + dx * fontSize, baseline + dy * fontSize, side * fontSize);
        const [a, b, c, d] = glyph.box;
        widen(ink, x + a * fontSize, baseline + b * fontSize, x + c * fontSize, baseline + d * fontSize);
      }
      x = after;
    }
    carets.set([x, x, baseline + lines.descender * fontSize, baseline + lines.ascender * fontSize], 4 * end); // of a newline, or the end
    return { first: start, end, baseline, left, right: left + width * fontSize };
  });
  return {
    shapes: Uint32Array.from(shapes), places: Float32Array.from(places), clusters: Uint32Array.from(clusters), carets, lines: set,
    blockBounds: [x0, y0 - height * fontSize, x0 + widest * fontSize, y0],
    visibleBounds: shapes.length ? /** @type {[number, number, number, number]} */ (ink) : [0, 0, 0, 0],
    ascender: lines.ascender * fontSize, descender: lines.descender * fontSize, capHeight: lines.cap_height * fontSize,
    xHeight: lines.x_height * fontSize, lineHeight: leading * fontSize, missing: [...missing], notes: [],
  };
}

/** @param {number[]} box @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 */
function widen(box, x0, y0, x1, y1) {
  box[0] = Math.min(box[0], x0);
  box[1] = Math.min(box[1], y0);
  box[2] = Math.max(box[2], x1);
  box[3] = Math.max(box[3], y1);
}

/**
 * The characters of each paragraph, and their advances in ems.
 *
 * @param {AtlasMetrics} metrics
 * @param {Omit<Request, 'fonts'>} request
 * @param {Set<number>} missing code points that the font lacks
 * @returns {Letter[][]}
 */
function lettersOf({ glyphs, kerning, notdef }, { text, letterSpacing, fontSize }, missing) {
  let index = 0;
  return text.split('\n').map((paragraph) => {
    const characters = [...paragraph];
    const letters = characters.map((character, k) => {
      const isBlank = /^\s$/u.test(character), glyph = glyphs[character] ?? (isBlank ? glyphs[' '] : undefined);
      if (!glyph) missing.add(/** @type {number} */ (character.codePointAt(0)));
      const { advance } = glyph ?? notdef;
      const added = (kerning[character]?.[characters[k + 1]] ?? 0) + letterSpacing / fontSize;
      const letter = { index, length: character.length, glyph: glyph ?? notdef, advance: advance + added, isBlank, isTab: character === '\t' };
      index += character.length;
      return letter;
    });
    index++; // the newline
    return letters;
  });
}

/**
 * Break paragraphs into lines at blanks, and within words that are too long if wanted.
 *
 * @param {Letter[][]} paragraphs
 * @param {Omit<Request, 'fonts'>} request
 * @param {number} space width of one
 * @returns {Row[]}
 */
function rowsOf(paragraphs, { maxWidth, whiteSpace, overflowWrap, fontSize, textIndent, tabSize, letterSpacing }, space) {
  const most = whiteSpace === 'nowrap' ? Infinity : maxWidth / fontSize;
  const stop = tabSize * (space + letterSpacing / fontSize);
  const widen = (/** @type {number} */ width, /** @type {Letter} */ letter) => {
    if (letter.isTab) letter.advance = stop > 0 ? (Math.floor(width / stop + 0.5 / tabSize) + 1) * stop - width : 0;
    return width + letter.advance;
  };
  let start = 0;
  return paragraphs.flatMap((letters) => {
    /** @type {Row[]} */
    const rows = [];
    let from = 0, indent = textIndent / fontSize, width = indent, opportunity = -1;
    const close = (/** @type {number} */ end) => {
      const own = letters.slice(from, end);
      let inked = own.length;
      while (inked > 1 && own[inked - 1].isBlank) inked--; // blanks hang at the end of a line
      const last = letters[end - 1];
      const after = last ? last.index + last.length : start;
      rows.push({ letters: own, width: own.slice(0, inked).reduce((sum, { advance }) => sum + advance, 0), indent, first: letters[from]?.index ?? start, end: after });
      from = end;
      indent = 0;
      opportunity = -1;
    };
    for (let k = 0; k < letters.length; k++) {
      width = widen(width, letters[k]);
      if (letters[k].isBlank) opportunity = k + 1;
      else if (width > most && (opportunity > from || (overflowWrap === 'break-word' && k > from))) {
        close(opportunity > from ? opportunity : k);
        width = letters.slice(from, k + 1).reduce(widen, 0);
      }
    }
    close(letters.length);
    start = rows.at(-1)?.end ?? start;
    start++;
    return rows;
  });
}

/** @param {number | string} anchor @param {number} width in ems @param {number} fontSize @returns {number} */
function anchorAcross(anchor, width, fontSize) {
  if (typeof anchor === 'number') return anchor;
  const part = { left: 0, center: 0.5, right: 1 }[/** @type {'left'} */ (anchor)] ?? Number.parseFloat(anchor) / 100;
  return part * width * fontSize;
}

/**
 * @param {number | string} anchor
 * @param {Record<string, number>} marks in ems
 * @param {number} fontSize
 * @returns {number} of the top of the block
 */
function anchorDown(anchor, { first, last, height, cap_height: cap, x_height: ex }, fontSize) {
  if (typeof anchor === 'number') return anchor;
  const down = {
    top: 0, 'top-baseline': first, 'top-cap': first - cap, 'top-ex': first - ex, middle: height / 2, 'bottom-baseline': last, bottom: height,
  }[anchor];
  return (down ?? (Number.parseFloat(anchor) / 100) * height) * fontSize;
}
