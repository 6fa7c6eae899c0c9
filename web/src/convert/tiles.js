// Repetition of the first tile of a pattern; neighbours share their border bit for bit, so that there is no seam.
import { ROUND } from '../../generated/svg-reader.js';
import { IDENTITY, inverse, isIdentity, multiply, stretch } from './affine.js';
import { writeLine } from './arcs.js';
import { clipContour } from './clip.js';
import { boundsOf, countOf, isStraight, mapPoints, withoutPoints } from './contours.js';
import { isVaried, movePaint } from './paints.js';
import { Veil } from './veils.js';

/** @typedef {import('./contours.js').Bounds} Bounds */
/** @typedef {import('./painter.js').Path} Path */

/** Share of a tile; tiles that a shape reaches less far into are left out. */
const TOUCHED = 1e-6;

/** Share of a tile; points closer to its border than this, and than a reader's accuracy, are moved onto it. */
const LOOSE = 1e-3;

/**
 * @typedef {object} Canvas the drawing, or a pattern's first tile in the pattern's space
 * @property {import('./contours.js').Rectangle | null} frame the visible part; null while unknown
 * @property {number} size larger side of the drawing
 * @property {import('./affine.js').Affine} whole map to the drawing
 *
 * @typedef {{ path: Path, veil: Veil | null }} Painted
 *
 * @typedef {{ canvas: Canvas, veil: Veil, painted: Painted[] }} FirstTile
 */

/** @param {Canvas} canvas @returns {{ low: number[], high: number[], sides: number[], near: number }} */
function borders({ frame, size, whole }) {
  const [x, y, width, height] = frame ?? [0, 0, 0, 0];
  const near = Math.min((ROUND * size) / stretch(whole), LOOSE * Math.min(width, height));
  return { low: [x, y], high: [x + width, y + height], sides: [width, height], near };
}

/**
 * @param {Canvas} canvas
 * @param {Veil} veil
 * @param {Painted[]} painted
 * @returns {FirstTile} with all paths fitted into the tile
 */
export function firstTileOf(canvas, veil, painted) {
  const fitted = painted.map(({ path, veil: innermost }) => {
    const contours = path.contours.map((contour) => fitContour(canvas, contour)).filter((contour) => contour.length);
    return { path: { ...path, contours }, veil: innermost };
  });
  return { canvas, veil, painted: fitted.filter(({ path }) => path.contours.length) };
}

/**
 * @param {Canvas} canvas
 * @param {Float64Array} contour
 * @returns {Float64Array} with points near the border moved onto it
 */
function fitContour(canvas, contour) {
  const { low, high, near } = borders(canvas);
  const fitted = contour.slice();
  const lines = [];
  for (let k = 0; k < contour.length; k += 8) lines.push(isStraight(contour, k));
  for (let k = 0; k < fitted.length; k++) {
    for (const border of [low[k % 2], high[k % 2]]) if (Math.abs(fitted[k] - border) <= near) fitted[k] = border;
  }
  lines.forEach((line, k) => {
    if (line) writeLine(fitted, 8 * k, fitted[8 * k], fitted[8 * k + 1], fitted[8 * k + 6], fitted[8 * k + 7]);
  });
  const kept = withoutPoints(fitted);
  const box = controlBox(kept);
  return box[0] < box[2] && box[1] < box[3] ? kept : kept.slice(0, 0);
}

/** @param {Float64Array} cubics @returns {Bounds} box of all points */
export function controlBox(cubics) {
  /** @type {Bounds} */
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < cubics.length; k++) {
    box[k % 2] = Math.min(box[k % 2], cubics[k]);
    box[2 + (k % 2)] = Math.max(box[2 + (k % 2)], cubics[k]);
  }
  return box;
}

/**
 * @param {Canvas} canvas
 * @param {Float64Array} contour
 * @returns {boolean[]} whether a rectangle spans the tile across, and down
 */
function spans(canvas, contour) {
  const { low, high, near } = borders(canvas);
  if (contour.length !== 32) return [false, false];
  for (let k = 0; k < 32; k += 8) {
    const isUpright = Math.abs(contour[k + 6] - contour[k]) <= near || Math.abs(contour[k + 7] - contour[k + 1]) <= near;
    if (!isUpright || !isStraight(contour, k)) return [false, false];
  }
  return [0, 1].map((axis) => {
    const ends = [0, 8, 16, 24].map((k) => contour[k + axis]);
    return ends.every((end) => end === low[axis] || end === high[axis]) && ends.includes(low[axis]) && ends.includes(high[axis]);
  });
}

/** @param {FirstTile} first @returns {FirstTile} a copy with veils of its own */
export function copyVeils({ canvas, veil, painted }) {
  /** @type {Map<Veil, Veil>} */
  const copies = new Map();
  const copy = (/** @type {Veil | null} */ one) => {
    if (!one) return null;
    const known = copies.get(one);
    if (known) return known;
    const own = Object.assign(new Veil(null, 1), one, { boxes: [...one.boxes] });
    copies.set(one, own);
    own.outer = copy(one.outer);
    own.masks = one.masks.map((mask) => /** @type {Veil} */ (copy(mask)));
    return own;
  };
  const outermost = /** @type {Veil} */ (copy(veil));
  return { canvas, veil: outermost, painted: painted.map(({ path, veil: one }) => ({ path, veil: copy(one) })) };
}

/** The tiles over a part of the drawing. */
export class PatternTiles {
  /** @param {Canvas} tile @param {Float64Array[]} shape @param {Bounds} window @param {Canvas} canvas */
  constructor(tile, shape, window, canvas) {
    const { low, sides } = borders(tile);
    this.tile = tile;
    this.window = window;
    /** From the pattern's space to the canvas. */
    this.matrix = isIdentity(canvas.whole) ? tile.whole : multiply(inverse(canvas.whole), tile.whole);
    const back = inverse(this.matrix);
    const box = boundsOf(shape.map((contour) => mapPoints(contour, back)));
    /** Column and row of the first tile. */
    this.first = [0, 1].map((axis) => Math.floor((box[axis] - low[axis]) / sides[axis] + TOUCHED));
    /** Column and row after the last one. */
    this.last = [0, 1].map((axis) => {
      return Math.max(Math.ceil((box[axis + 2] - low[axis]) / sides[axis] - TOUCHED), this.first[axis] + 1);
    });
  }

  /** @param {Path} path @returns {[number, number]} numbers of cubics and of gradients that `repeat` makes of it */
  cost(path) {
    const [columns, rows] = [this.last[0] - this.first[0], this.last[1] - this.first[1]];
    if (isVaried(path.paint)) return [columns * rows * countOf(path.contours), columns * rows];
    const counts = path.contours.map((contour) => {
      const [across, down] = spans(this.tile, contour);
      return (contour.length / 8) * (across ? 1 : columns) * (down ? 1 : rows);
    });
    return [counts.reduce((sum, count) => sum + count, 0), 0];
  }

  /** @param {Path} path of the first tile @returns {Path[]} it in all tiles */
  repeat(path) {
    if (isVaried(path.paint)) return [...this.places(false, false)].flatMap((at) => this.gradientTile(path, at));
    const contours = path.contours.flatMap((contour) => {
      const [across, down] = spans(this.tile, contour);
      return [...this.places(across, down)].flatMap(([x, y]) => {
        return this.moved(contour, [x, y], [across ? this.last[0] : x + 1, down ? this.last[1] : y + 1]);
      });
    });
    return contours.length ? [{ ...path, contours }] : [];
  }

  /** @param {boolean} across @param {boolean} down @returns {Generator<[number, number]>} columns and rows of tiles */
  *places(across, down) {
    for (let y = this.first[1]; y < (down ? this.first[1] + 1 : this.last[1]); y++) {
      for (let x = this.first[0]; x < (across ? this.first[0] + 1 : this.last[0]); x++) yield [x, y];
    }
  }

  /** @param {Path} path @param {[number, number]} at @returns {Path[]} */
  gradientTile(path, at) {
    const contours = path.contours.flatMap((contour) => this.moved(contour, at, [at[0] + 1, at[1] + 1]));
    const [a, b, c, d] = this.tile.whole;
    const [x, y] = at.map((place, axis) => place * borders(this.tile).sides[axis]);
    const paint = movePaint(path.paint, [[1, 0, -a * x - c * y], [0, 1, -b * x - d * y]]);
    return contours.length ? [{ ...path, contours, paint }] : [];
  }

  /**
   * Copy a contour of the first tile into another one, clipped to the window; points on the greater borders move to `end`.
   *
   * @param {Float64Array} contour
   * @param {number[]} start column and row
   * @param {number[]} end
   * @returns {Float64Array[]}
   */
  moved(contour, start, end) {
    const { low, high, sides } = borders(this.tile);
    const points = contour.map((value, k) => {
      const axis = k % 2;
      return value === high[axis] ? low[axis] + end[axis] * sides[axis] : value + start[axis] * sides[axis];
    });
    if (end[0] - start[0] > 1 || end[1] - start[1] > 1) {
      for (let k = 0, n = points.length; k < n; k += 8) {
        writeLine(points, k, points[k], points[k + 1], points[(k + 8) % n], points[((k + 8) % n) + 1]);
      }
    }
    const placed = mapPoints(points, this.matrix);
    const [left, top, right, bottom] = this.window;
    const box = controlBox(placed);
    if (!(box[0] < right && box[1] < bottom && box[2] > left && box[3] > top)) return [];
    const isInside = box[0] >= left && box[1] >= top && box[2] <= right && box[3] <= bottom;
    const part = isInside ? placed : clipContour(placed, [left, top], [right, bottom]);
    return part.length ? [part] : [];
  }
}

/**
 * @param {Float64Array[]} shape
 * @param {import('./contours.js').Rectangle} frame
 * @returns {{ shape: Float64Array[], window: Bounds }}
 */
export function visiblePart(shape, [x, y, width, height]) {
  const inside = shape.map((contour) => clipContour(contour, [x, y], [x + width, y + height])).filter((one) => one.length);
  return { shape: inside, window: inside.length ? boundsOf(inside) : [x, y, x, y] };
}

/**
 * @param {Float64Array[]} shape
 * @param {Bounds} window
 * @returns {boolean} whether a shape is an upright rectangle, bit for bit
 */
export function isWindow(shape, [left, top, right, bottom]) {
  if (shape.length !== 1 || shape[0].length !== 32) return false;
  const [cubics] = shape;
  const corners = new Set();
  for (let k = 0; k < 32; k += 8) {
    const box = controlBox(cubics.subarray(k, k + 8));
    if (box[0] !== box[2] && box[1] !== box[3]) return false;
    const [x, y] = [cubics[k], cubics[k + 1]];
    if ((x !== left && x !== right) || (y !== top && y !== bottom)) return false;
    corners.add(`${x === left} ${y === top}`);
  }
  return corners.size === 4;
}

/** @param {import('./contours.js').Rectangle | null} frame @param {number} size @returns {Canvas} the drawing */
export const drawingCanvas = (frame, size) => ({ frame, size, whole: IDENTITY });
