// What a text is set by, and what has been set: carets, selections and bounds.

/**
 * @typedef {object} Request A text to set; the names and meanings are those of a `Text`.
 * @property {string} text
 * @property {number[]} fonts ids
 * @property {number} fontSize
 * @property {number} weight
 * @property {boolean} italic
 * @property {Record<string, number>} variations
 * @property {string} features
 * @property {string} language
 * @property {number} letterSpacing
 * @property {number} tabSize
 * @property {number | 'normal'} lineHeight distance of baselines
 * @property {number} maxWidth
 * @property {number} textIndent
 * @property {'left' | 'right' | 'center' | 'justify' | 'start' | 'end'} textAlign
 * @property {'normal' | 'nowrap'} whiteSpace
 * @property {'normal' | 'break-word'} overflowWrap
 * @property {'auto' | 'ltr' | 'rtl'} direction
 * @property {'horizontal-tb' | 'vertical-rl'} writingMode
 * @property {number | string} anchorX
 * @property {number | string} anchorY
 * @property {number} outlineWidth
 * @property {number} strokeWidth
 * @property {[number, string][]} [inks] colours as six hexadecimal digits, each from an index of the text on
 *
 * @typedef {object} PlacedShapes Shapes and where they are.
 * @property {Uint32Array} shapes indices of shapes
 * @property {Float32Array} places left, bottom and side of the unit square of each
 *
 * @typedef {object} TextLine A line of a text.
 * @property {number} first index of its first character, in UTF-16 units
 * @property {number} end index after its last
 * @property {number} baseline y of its baseline
 * @property {number} left x of its start
 * @property {number} right x of its end
 *
 * @typedef {[number, number, number, number]} Rectangle left, bottom, right and top
 *
 * @typedef {object} TextMeasures Measures of a text that has been set, in its own units, y up.
 * @property {Uint32Array} clusters of each glyph the index of its first character
 * @property {Float32Array} carets of each character the x of its start and its end, bottom and top
 * @property {TextLine[]} lines from the first to the last
 * @property {Rectangle} blockBounds of the lines
 * @property {Rectangle} visibleBounds of the ink
 * @property {number} ascender height of the font above the baseline
 * @property {number} descender below 0: its depth below the baseline
 * @property {number} capHeight height of capital letters
 * @property {number} xHeight height of small letters
 * @property {number} lineHeight distance of baselines
 * @property {number[]} missing code points that no font has
 * @property {string[]} notes what is drawn otherwise than the fonts say
 * @property {boolean} [hasInk] whether the text's colours are in shapes, of emoji with parts in them
 *
 * @typedef {PlacedShapes & TextMeasures & { outlines?: PlacedShapes, strokes?: PlacedShapes }} TextLayout places of glyphs and
 *   measures of a text that is shown
 *
 * @typedef {TextLayout | { error: string, field: string }} Outcome
 */

/** Numbers of a caret. */
const CARET = 4;

/**
 * Find the caret nearest to a point: between which characters a click puts it.
 *
 * @param {TextMeasures} layout a text's `layout`
 * @param {number} x
 * @param {number} y
 * @returns {{ x: number, y: number, height: number, charIndex: number } | null} bottom end and height of the caret; null
 *   without characters
 */
export function getCaretAtPoint({ carets }, x, y) {
  let nearest = null,
    least = [Infinity, Infinity];
  for (let index = 0; index < carets.length / CARET; index++) {
    const [start, end, bottom, top] = carets.subarray(CARET * index, CARET * index + CARET);
    const off = Math.max(bottom - y, y - top, 0);
    for (const [place, charIndex] of [[start, index], [end, index + 1]]) {
      const aside = Math.abs(place - x);
      if (off > least[0] || (off === least[0] && aside >= least[1])) continue;
      least = [off, aside];
      nearest = { x: place, y: bottom, height: top - bottom, charIndex };
    }
  }
  return nearest;
}

/**
 * Find the rectangles behind a range of characters, one for each run in one direction.
 *
 * @param {TextMeasures} layout a text's `layout`
 * @param {number} start index of the first character, in UTF-16 units
 * @param {number} end index after the last
 * @returns {{ left: number, right: number, bottom: number, top: number }[]}
 */
export function getSelectionRects({ carets }, start, end) {
  const [first, last] = [Math.max(Math.min(start, end), 0), Math.min(Math.max(start, end), carets.length / CARET)];
  /** @type {{ left: number, right: number, bottom: number, top: number }[]} */
  const found = [];
  for (let index = first; index < last; index++) {
    const [from, to, bottom, top] = carets.subarray(CARET * index, CARET * index + CARET);
    const [left, right] = [Math.min(from, to), Math.max(from, to)];
    const near = found.at(-1);
    const isBeside = near && near.bottom === bottom && near.top === top && left <= near.right + 1e-6 && right >= near.left - 1e-6;
    if (isBeside) Object.assign(near, { left: Math.min(near.left, left), right: Math.max(near.right, right) });
    else found.push({ left, right, bottom, top });
  }
  return found.filter(({ left, right }) => right > left);
}

/**
 * Some of the glyphs.
 *
 * @param {PlacedShapes & { clusters: Uint32Array }} layout
 * @param {(shape: number) => boolean} isChosen
 */
export function chosen({ shapes, places, clusters }, isChosen) {
  const kept = [...shapes.keys()].filter((k) => isChosen(shapes[k]));
  return {
    shapes: Uint32Array.from(kept, (k) => shapes[k]),
    places: Float32Array.from(kept.flatMap((k) => [...places.subarray(3 * k, 3 * k + 3)])),
    clusters: Uint32Array.from(kept, (k) => clusters[k]),
  };
}

/**
 * Find the glyph at a point.
 *
 * @param {PlacedShapes} layout
 * @param {readonly [number, number][]} boxes
 * @param {number} x
 * @param {number} y
 * @returns {number} glyph whose box has the point; -1: none
 */
export function glyphAt({ shapes, places }, boxes, x, y) {
  return shapes.findIndex((shape, k) => {
    const [left, bottom, side] = places.subarray(3 * k, 3 * k + 3), [width, height] = boxes[shape];
    return x >= left && x <= left + width * side && y >= bottom && y <= bottom + height * side;
  });
}

/**
 * The part of a rectangle that is shown.
 *
 * @param {Rectangle} bounds
 * @param {Rectangle | null} clip
 * @returns {Rectangle}
 */
export function shownPart([left, bottom, right, top], clip) {
  if (!clip) return [left, bottom, right, top];
  return [Math.max(left, clip[0]), Math.max(bottom, clip[1]), Math.min(right, clip[2]), Math.min(top, clip[3])];
}

/** What an empty text shows. */
export const NOTHING = Object.freeze({ shapes: new Uint32Array(0), places: new Float32Array(0), clusters: new Uint32Array(0), outlines: undefined, strokes: undefined });
