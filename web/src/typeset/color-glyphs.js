// Glyphs in colours (COLR 0 and 1) as drawings.
import * as hb from 'harfbuzzjs';
import { MAP_HEAD } from '../../generated/layout.js';
import { IDENTITY, determinant, inverse, multiply } from '../convert/affine.js';
import { mapPoints } from '../convert/contours.js';
import { fadePaint, moveGradient, paintOfGradient, rowsOf } from '../convert/paints.js';
import { mapOf } from '../convert/planar-map.js';
import { MASK, Veil, dropEmptyGroups, groupPaths } from '../convert/veils.js';
import { headOf } from '../planar-map.js';
import { contoursOf, controlBox } from './outlines.js';

/** @import { Affine } from '../convert/affine.js' */
/** @import { Bounds } from '../convert/conversion.js' */
/** @import { Kernels } from '../convert/kernels.js' */
/** @import { Path } from '../convert/painter.js' */
/** @import { Color, Gradient, Paint, Stop } from '../convert/paints.js' */
/** @import { Instance } from './font.js' */

/**
 * @typedef {{ contours: Float64Array[], paint: Paint }} Fill
 * @typedef {{ toRamp: Affine, focus: [number, number] | null, isReversed?: boolean }} Ramp
 * @typedef {object} Layer Nodes that are composited together.
 * @property {Node[]} nodes
 * @property {number} blend
 * @property {{ nodes: Node[], isInverse: boolean } | null} mask what shows of it, or hides it
 * @typedef {Fill | Layer} Node
 */

const { PaintCompositeMode: MODE } = hb;

/** Blend modes of drawings by those of COLR. @type {Record<number, number>} */
const BLENDS = {
  [MODE.PLUS]: 16, [MODE.SCREEN]: 2, [MODE.OVERLAY]: 3, [MODE.DARKEN]: 4, [MODE.LIGHTEN]: 5, [MODE.COLOR_DODGE]: 6, [MODE.COLOR_BURN]: 7,
  [MODE.HARD_LIGHT]: 8, [MODE.SOFT_LIGHT]: 9, [MODE.DIFFERENCE]: 10, [MODE.EXCLUSION]: 11, [MODE.MULTIPLY]: 1, [MODE.HSL_HUE]: 12,
  [MODE.HSL_SATURATION]: 13, [MODE.HSL_COLOR]: 14, [MODE.HSL_LUMINOSITY]: 15,
};

/** Spreads of gradients by those of COLR: pad, repeat, reflect. */
const SPREADS = [0, 2, 1];

/** Least area of a unit of a transform, and least length of a gradient, in units of the font. */
const FLAT = 1e-9;

/** Limit of the texels of a glyph. */
const MOST_TEXELS = 1 << 17;

/** Notes. */
const SWEEP = 'sweep gradients of glyphs are shown in their mean colours';
const FOREGROUND = "parts in the text's colour, of glyphs that have others, are black here";
const FLATTENED = 'gradients of glyphs are shown in their mean colours, where too many are on one another';

/** @type {Paint} */
const BLACK = { color: [0, 0, 0], opacity: 1, gradient: null };
/** @type {Paint} */
const WHITE = { color: [1, 1, 1], opacity: 1, gradient: null };

/** Receives the paints of a glyph from HarfBuzz. */
class GlyphPainter {
  /** @type {Affine[]} */
  #matrices = [IDENTITY];
  /** @type {{ contours: Float64Array[], isBox: boolean }[]} */
  #clips = [];
  /** @type {Node[][]} */
  #open = [[]];
  /** @type {Set<string>} */
  notes = new Set();
  /** Whether all of it has the text's colour, and whether a part has. */
  isPlain = true;
  hasInk = false;

  /** @param {Instance} instance @param {string} ink colour of the text as six hexadecimal digits; '' if it has none yet */
  constructor(instance, ink) {
    this.instance = instance;
    this.ink = ink ? Number.parseInt(ink, 16) : null;
  }

  /** A colour of the font, or that of the text. @param {hb.Color} color @param {boolean} isForeground */
  #colorOf({ red, green, blue, alpha }, isForeground) {
    /** @type {Color} */
    let color = [red / 255, green / 255, blue / 255];
    if (isForeground) {
      this.hasInk = true;
      if (this.ink === null) this.notes.add(FOREGROUND);
      else color = [(this.ink >> 16) / 255, ((this.ink >> 8) & 255) / 255, (this.ink & 255) / 255];
    }
    return { color, opacity: alpha / 255 };
  }

  get nodes() {
    return this.#open[0];
  }

  get #matrix() {
    return this.#matrices[this.#matrices.length - 1];
  }

  /** @param {Affine} matrix */
  pushTransform(matrix) {
    this.#matrices.push(multiply(this.#matrix, matrix));
  }

  popTransform() {
    this.#matrices.pop();
  }

  /** @param {number} glyph */
  pushGlyph(glyph) {
    this.#clips.push({ contours: contoursOf(this.instance.font, glyph).map((one) => mapPoints(one, this.#matrix)), isBox: false });
  }

  /** @param {number} left @param {number} bottom @param {number} right @param {number} top */
  pushBox(left, bottom, right, top) {
    this.#clips.push({ contours: [mapPoints(rectangle([left, bottom, right, top]), this.#matrix)], isBox: true });
  }

  popClip() {
    this.#clips.pop();
  }

  pushGroup() {
    this.#open.push([]);
  }

  /** @param {number} mode */
  popGroup(mode) {
    const source = /** @type {Node[]} */ (this.#open.pop()), last = this.#open.length - 1;
    this.#open[last] = composite(mode, this.#open[last], source);
  }

  /** Fill what the clips leave: boxes around the glyph are left out. @param {Paint} paint */
  fill(paint) {
    const glyphs = this.#clips.filter(({ isBox }) => !isBox), shape = glyphs.pop() ?? this.#clips[this.#clips.length - 1];
    if (!shape?.contours.length || glyphs.some(({ contours }) => !contours.length)) return;
    /** @type {Node} */
    let node = { contours: shape.contours, paint };
    for (const { contours } of glyphs) node = { nodes: [node], blend: 0, mask: { nodes: [{ contours, paint: BLACK }], isInverse: false } };
    this.#open[this.#open.length - 1].push(node);
  }

  /** @param {boolean} isForeground @param {hb.Color} color */
  fillFlat(isForeground, color) {
    if (!isForeground || color.alpha < 255 || this.#open.length > 1) this.isPlain = false;
    this.fill({ ...this.#colorOf(color, isForeground), gradient: null });
  }

  /** @param {hb.ColorLine} line @param {(low: number, high: number) => Ramp | null} ramp from the offsets at its ends */
  fillGradient({ extend, colorStops }, ramp) {
    const stops = colorStops.map(({ offset, color, isForeground }) => ({ offset, ...this.#colorOf(color, isForeground) }));
    stops.sort((one, other) => one.offset - other.offset);
    this.isPlain = false;
    if (!stops.length) return;
    let low = stops[0].offset, high = stops[stops.length - 1].offset;
    if (high - low < FLAT) [low, high] = [low, low + 1]; // a step
    const found = ramp(low, high);
    if (!found || Math.abs(determinant(this.#matrix)) < FLAT) return;
    /** @type {Stop[]} */
    let placed = stops.map((stop) => ({ ...stop, offset: (stop.offset - low) / (high - low) }));
    if (found.isReversed) placed = placed.reverse().map((stop) => ({ ...stop, offset: 1 - stop.offset }));
    /** @type {Gradient} */
    const gradient = { toRamp: rowsOf(found.toRamp), stops: placed, spread: SPREADS[extend] ?? 0, focus: found.focus };
    this.fill(paintOfGradient(moveGradient(gradient, rowsOf(inverse(this.#matrix)))));
  }

  /** @param {hb.ColorLine} line */
  fillSweep({ colorStops }) {
    this.notes.add(SWEEP);
    this.isPlain = false;
    const stops = colorStops.map(({ offset, color, isForeground }) => ({ offset, ...this.#colorOf(color, isForeground) }));
    if (stops.length) this.fill({ ...paintOfGradient({ toRamp: rowsOf(IDENTITY), stops, spread: 0, focus: null }), gradient: null });
  }
}

const funcs = new hb.PaintFuncs();
const painterOf = (/** @type {unknown} */ data) => /** @type {GlyphPainter} */ (data);
funcs.setPushTransformFunc((xx, yx, xy, yy, dx, dy, data) => painterOf(data).pushTransform([xx, yx, xy, yy, dx, dy]));
funcs.setPopTransformFunc((data) => painterOf(data).popTransform());
funcs.setPushClipGlyphFunc((glyph, _, data) => painterOf(data).pushGlyph(glyph));
funcs.setPushClipRectangleFunc((left, bottom, right, top, data) => painterOf(data).pushBox(left, bottom, right, top));
funcs.setPopClipFunc((data) => painterOf(data).popClip());
funcs.setColorFunc((isForeground, color, data) => painterOf(data).fillFlat(isForeground, color));
funcs.setLinearGradientFunc((line, x0, y0, x1, y1, x2, y2, data) => {
  painterOf(data).fillGradient(line, (low, high) => linearRamp([x0, y0, x1, y1, x2, y2], low, high));
});
funcs.setRadialGradientFunc((line, x0, y0, r0, x1, y1, r1, data) => {
  painterOf(data).fillGradient(line, (low, high) => radialRamp([x0, y0, r0], [x1, y1, r1], low, high));
});
funcs.setSweepGradientFunc((line, _x, _y, _start, _end, data) => painterOf(data).fillSweep(line));
funcs.setPushGroupFunc((data) => painterOf(data).pushGroup());
funcs.setPopGroupFunc((mode, data) => painterOf(data).popGroup(mode));

/**
 * A glyph as paths in its own square.
 *
 * @param {Instance} instance
 * @param {number} glyph
 * @param {boolean} isTurned by a quarter, clockwise
 * @param {string} ink colour of the text as six hexadecimal digits; '' if it has none yet
 */
export function paintGlyph(instance, glyph, isTurned, ink) {
  const painter = new GlyphPainter(instance, ink);
  if (isTurned) painter.pushTransform([0, -1, 1, 0, 0, 0]);
  instance.font.paintGlyph(glyph, funcs, painter);
  const box = controlBox(contoursIn(painter.nodes));
  if (!(box[2] > box[0]) || !(box[3] > box[1])) return null;
  /** @type {Path[]} */
  const paths = [];
  /** @type {(Veil | null)[]} */
  const veils = [];
  const emit = (/** @type {Node[]} */ nodes, /** @type {Veil | null} */ veil) => {
    for (const node of nodes) {
      if ('contours' in node) {
        paths.push({ contours: node.contours, fillRule: 0, paint: node.paint, group: -1, element: '' });
        veils.push(veil);
        veil?.add(controlBox(node.contours));
        continue;
      }
      const inner = new Veil(veil, 1, node.blend);
      if (node.mask) {
        const mask = new Veil(inner, 1, 0, node.mask.isInverse ? MASK.luminance : MASK.opacity);
        inner.masks.push(mask);
        emit(node.mask.isInverse ? [{ contours: [rectangle(box)], paint: WHITE }, ...blackened(node.mask.nodes)] : node.mask.nodes, mask);
      }
      emit(node.nodes, inner);
    }
  };
  emit(painter.nodes, null);
  const grouped = groupPaths(paths, veils, fadePaint);
  const { notes, hasInk } = painter, isPlain = painter.isPlain && !grouped.groups.length;
  return { ...dropEmptyGroups(grouped.paths, grouped.groups), box, notes, isPlain, hasInk };
}

/**
 * The texels of a painted glyph; null if there are too many.
 *
 * @param {Kernels} kernels
 * @param {NonNullable<ReturnType<typeof paintGlyph>>} painted
 * @param {string} name
 * @param {Bounds} bounds
 * @param {number} first index of its first texel
 */
export function mapTexels(kernels, { paths, groups, box: [left, bottom, right, top], notes }, name, bounds, first) {
  const side = Math.max(right - left, top - bottom);
  const rows = rowsOf([side, 0, 0, side, left, bottom]);
  const normal = paths.map((path) => ({
    ...path,
    contours: path.contours.map((one) => one.map((value, k) => (value - (k % 2 ? bottom : left)) / side)),
    paint: path.paint.gradient ? { ...path.paint, gradient: moveGradient(path.paint.gradient, rows) } : path.paint,
  }));
  /** @type {import('../convert/drawing.js').Drawing} */
  const drawing = { name, paths: normal, groups, toSource: [side, 0, 0, side, left, bottom], sides: [1, 1], notes: [] };
  const sheet = mapOf(kernels, drawing, bounds, { restyle: false, first, mostTexels: MOST_TEXELS });
  if (!sheet) return null;
  if (sheet.flattened) notes.add(FLATTENED);
  return { texels: sheet.texels, quad: first + MAP_HEAD, hasGradients: headOf(sheet.texels, MAP_HEAD).operations > 0 };
}

/** @param {readonly number[]} box */
function rectangle([left, bottom, right, top]) {
  const corners = [left, bottom, right, bottom, right, top, left, top];
  return Float64Array.from({ length: 32 }, (_, k) => {
    const side = k >> 3, axis = k & 1, from = corners[2 * side + axis], to = corners[(2 * side + 2 + axis) % 8], step = (k >> 1) & 3;
    return step === 0 ? from : step === 3 ? to : from + ((to - from) * step) / 3;
  });
}

/** All contours that show. @param {Node[]} nodes @returns {Float64Array[]} */
function contoursIn(nodes) {
  return nodes.flatMap((node) => ('contours' in node ? node.contours : contoursIn([...node.nodes, ...(node.mask?.nodes ?? [])])));
}

/** What hides by its opacity, in black. @param {Node[]} nodes @returns {Node[]} */
const blackened = (nodes) =>
  nodes.map((node) => {
    if (!('contours' in node)) return { ...node, nodes: blackened(node.nodes) };
    const { gradient, opacity } = node.paint, stops = gradient?.stops.map((stop) => ({ ...stop, color: BLACK.color }));
    return { ...node, paint: { color: BLACK.color, opacity, gradient: gradient && stops ? { ...gradient, stops } : null } };
  });

/**
 * Composite a group (COLR, "CompositeMode"; Porter and Duff).
 *
 * @param {number} mode
 * @param {Node[]} below
 * @param {Node[]} source
 * @returns {Node[]}
 */
function composite(mode, below, source) {
  const masked = (/** @type {Node[]} */ nodes, /** @type {Node[]} */ by, isInverse = false) =>
    nodes.length && (by.length || isInverse) ? [{ nodes, blend: 0, mask: { nodes: by, isInverse } }] : [];
  const blend = BLENDS[mode];
  if (blend !== undefined) return source.length ? [...below, { nodes: source, blend, mask: null }] : below;
  switch (mode) {
    case MODE.CLEAR: return [];
    case MODE.SRC: return source;
    case MODE.DEST: return below;
    case MODE.DEST_OVER: return [...source, ...below];
    case MODE.SRC_IN: return masked(source, below);
    case MODE.DEST_IN: return masked(below, source);
    case MODE.SRC_OUT: return masked(source, below, true);
    case MODE.DEST_OUT: return masked(below, source, true);
    case MODE.SRC_ATOP: return [...below, ...masked(source, below)];
    case MODE.DEST_ATOP: return [...source, ...masked(below, source)];
    case MODE.XOR: return [...masked(source, below, true), ...masked(below, source, true)];
    default: {
      const isIsolated = source.some((node) => 'blend' in node && node.blend);
      return [...below, ...(isIsolated ? [{ nodes: source, blend: 0, mask: null }] : source)];
    }
  }
}

/**
 * The ramp of a linear gradient: the third point gives the direction in which colours do not change.
 *
 * @param {readonly number[]} points
 * @param {number} low offset that becomes 0
 * @param {number} high offset that becomes 1
 */
function linearRamp([x0, y0, x1, y1, x2, y2], low, high) {
  const across = [x2 - x0, y2 - y0], whole = across[0] ** 2 + across[1] ** 2;
  if (whole < FLAT) return null;
  const share = ((x1 - x0) * across[0] + (y1 - y0) * across[1]) / whole;
  const dx = x1 - x0 - share * across[0], dy = y1 - y0 - share * across[1], x = dx * (high - low), y = dy * (high - low), square = x * x + y * y;
  if (square < FLAT) return null;
  return { toRamp: multiply([x / square, -y / square, y / square, x / square, 0, 0], [1, 0, 0, 1, -x0 - dx * low, -y0 - dy * low]), focus: null };
}

/**
 * The ramp of a radial gradient, whose larger circle becomes the unit circle.
 *
 * @param {readonly number[]} start centre and radius at offset 0
 * @param {readonly number[]} end those at offset 1
 * @param {number} low
 * @param {number} high
 * @returns {{ toRamp: Affine, focus: [number, number], isReversed: boolean } | null}
 */
function radialRamp(start, end, low, high) {
  const at = (/** @type {number} */ share) => start.map((value, k) => value + (end[k] - value) * share);
  let first = at(low), last = at(high);
  const isReversed = last[2] < first[2];
  if (isReversed) [first, last] = [last, first];
  const [cx, cy, r] = last;
  if (r < FLAT) return null;
  const x = (first[0] - cx) / r, y = (first[1] - cy) / r, away = Math.sqrt(x * x + y * y), focal = Math.max(first[2] / r, 0);
  if (away < FLAT && focal === 1) return null;
  const [cos, sin] = away > 0 ? [x / away, y / away] : [1, 0];
  return { toRamp: multiply([cos / r, -sin / r, sin / r, cos / r, 0, 0], [1, 0, 0, 1, -cx, -cy]), focus: [away, focal], isReversed };
}
