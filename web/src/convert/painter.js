// Painting of one shape: its fill and stroke become paths in the drawing's coordinates.
import { MOST_DASHES, MOST_SEGMENTS, ROUND } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { IDENTITY, inverse, stretch } from './affine.js';
import { boundsOf, countOf, loopOf, mapPoints } from './contours.js';
import { BLACK } from './paints.js';
import { firstTileContent } from './patterns.js';
import { isTiling } from './servers.js';
import { shapeOutlines } from './shapes.js';
import { isFlat, toDrawing } from './space.js';
import { dashCount, strokeOf } from './strokes.js';
import { PatternTiles, controlBox, copyVeils, firstTileOf, isWindow, visiblePart } from './tiles.js';
import { Veil } from './veils.js';

/** @typedef {import('./space.js').Place} Place */
/** @typedef {import('./space.js').Placed} Placed */
/** @typedef {import('./contours.js').Outline} Outline */
/** @typedef {import('./paints.js').Paint} Paint */
/** @typedef {import('./patterns.js').Tiling} Tiling */
/** @typedef {import('./shapes.js').Shape} Shape */
/** @template Result @typedef {import('./pace.js').Steps<Result>} Steps */

/**
 * @typedef {{ contours: Float64Array[], fillRule: number, paint: Paint, group: number, element: string }} Path as
 *   Python's `Path`
 */

const PARTS = ['fill', 'stroke', 'markers'];

/** Suffix of the name of an element's stroke. */
const STROKE = '/stroke';

/** Collects the painted paths in order, with the innermost veil of each. */
export class Painter {
  /**
   * @param {import('./scene.js').Scene} scene
   * @param {import('./tiles.js').Canvas} canvas
   */
  constructor(scene, canvas) {
    this.scene = scene;
    this.canvas = canvas;
    /** @type {Path[]} */
    this.paths = [];
    /** @type {(Veil | null)[]} */
    this.veils = [];
    this.segments = 0;
  }

  /**
   * Paint a shape and its markers.
   *
   * @param {any} element
   * @param {Place} place
   * @param {(() => Steps<Placed[][]>) | null} [markers]
   * @returns {Steps<void>}
   */
  *paint(element, place, markers = null) {
    const { style } = place;
    if (style.get('visibility') !== 'visible' || isFlat(place.space)) return;
    if (!place.isClip && !markers && style.get('fill') === 'none' && style.get('stroke') === 'none') return;
    const size = this.canvas.size / stretch(place.space.whole);
    const shape = { element, style, view: place.view, tolerance: ROUND * size, report: this.scene.report };
    const outlines = shapeOutlines(shape);
    if (!outlines.length) return;
    const rule = Number(style.get(place.isClip ? 'clip-rule' : 'fill-rule') === 'evenodd');
    const fill = place.isClip ? BLACK : this.scene.servers.paint('fill', place, outlines);
    const line = place.isClip ? null : this.scene.servers.paint('stroke', place, outlines);
    for (const part of new Set([...style.get('paint-order').split(/\s+/), ...PARTS])) {
      if (part === 'fill' && fill) yield* this.add(outlines.map(loopOf), place, rule, fill, place.name);
      else if (part === 'stroke' && line) yield* this.stroke(shape, outlines, place, line, size);
      else if (part === 'markers' && markers) for (const marker of yield* markers()) yield* this.scene.walk(marker, this);
    }
  }

  /** @param {import('./scene.js').Scene} scene @returns {Painter} that of another document onto the same drawing */
  forScene(scene) {
    return Object.assign(new Painter(scene, this.canvas), { paths: this.paths, veils: this.veils, segments: this.segments });
  }

  /**
   * Paint along the outlines.
   *
   * @param {Shape} shape
   * @param {Outline[]} outlines
   * @param {Place} place
   * @param {Paint | Tiling} paint
   * @param {number} size of the drawing, in the shape's user units
   * @returns {Steps<void>}
   */
  *stroke(shape, outlines, place, paint, size) {
    const stroke = strokeOf(shape, outlines);
    if (!stroke) return;
    const { strokeOutline, report } = this.scene;
    if (!strokeOutline) return report.leftOut('stroke');
    const effect = shape.style.get('vector-effect');
    const isFixed = effect === 'non-scaling-stroke';
    if (!isFixed && effect !== 'none') report.leftOut(`vector-effect '${effect.slice(0, 40)}'`);
    const screen = isFixed ? place.space.whole : IDENTITY;
    const onScreen = isFixed ? outlines.map((one) => ({ ...one, cubics: mapPoints(one.cubics, screen) })) : outlines;
    const count = dashCount(onScreen, stroke);
    const isSolid = count > MOST_DASHES;
    if (isSolid) {
      const [has, most] = [count, MOST_DASHES].map((value) => value.toLocaleString('en-US'));
      const text = `${has} dashes; the limit is ${most}; lengthen stroke-dasharray`;
      report.simplified(`stroke of ${report.describe(shape.element)} read as solid: ${text}`);
    }
    const dashes = isSolid ? [] : stroke.dashes;
    const style = { ...stroke, dashes, tolerance: ROUND * size * stretch(screen) };
    const back = inverse(screen);
    const contours = onScreen.flatMap(({ cubics, closed }) => strokeOutline(cubics, closed, style));
    const placed = contours.map((contour) => mapPoints(contour, back));
    yield* this.add(placed, place, 0, paint, place.name && place.name + STROKE);
  }

  /**
   * Add contours, in the units of a place, to the paths.
   *
   * @param {Float64Array[]} contours
   * @param {Place} place
   * @param {number} rule
   * @param {Paint | Tiling} paint
   * @param {string} element
   * @returns {Steps<void>}
   */
  *add(contours, place, rule, paint, element) {
    this.segments += countOf(contours);
    if (this.segments > MOST_SEGMENTS) {
      const most = MOST_SEGMENTS.toLocaleString('en-US');
      throw new VextureError(`here the drawing exceeds the limit of ${most} segments; simplify it`, 'segments');
    }
    const clipped = contours.map((contour) => toDrawing(place.space, contour)).filter((contour) => contour.length);
    if (!clipped.length) return;
    if (isTiling(paint) && (yield* this.tile(clipped, place, rule, paint, element))) return;
    const flat = isTiling(paint) ? paint.solid : paint;
    this.push({ contours: clipped, fillRule: rule, paint: flat, group: -1, element }, place.veil);
    place.veil?.add(boxOf(clipped));
  }

  /** @param {Path} path @param {Veil | null} veil */
  push(path, veil) {
    this.paths.push(path);
    this.veils.push(veil);
  }

  /**
   * Paint the tiles of a pattern over a shape; return false if there are too many, or the frame is unknown.
   *
   * @param {Float64Array[]} contours
   * @param {Place} place
   * @param {number} rule
   * @param {Tiling} tiling
   * @param {string} element
   * @returns {Steps<boolean>}
   */
  *tile(contours, place, rule, tiling, element) {
    if (!this.canvas.frame) return false;
    const { shape, window } = visiblePart(contours, this.canvas.frame);
    if (!shape.length) return true;
    const first = yield* this.firstTile(place, tiling);
    if (!first) return false;
    const tiles = new PatternTiles(first.canvas, shape, window, this.canvas);
    const costs = first.painted.map(({ path }) => tiles.cost(path));
    const [segments, gradients] = [0, 1].map((k) => costs.reduce((sum, cost) => sum + cost[k], 0));
    if (!this.scene.servers.affords(tiling.pattern.element, { segments, gradients })) return false;
    first.veil.enter(place.veil, window);
    if (isWindow(shape, window)) first.veil.opacity = tiling.opacity;
    else if (first.painted.length) {
      const paint = { color: tiling.solid.color, opacity: 1, gradient: null };
      this.push({ contours: shape, fillRule: rule, paint, group: -1, element: '' }, first.veil.maskPattern(tiling.opacity));
    }
    for (const { path, veil } of first.painted) {
      if (this.scene.pace.isDue()) yield;
      for (const copy of tiles.repeat(path)) this.push({ ...copy, element }, veil);
    }
    return true;
  }

  /**
   * The first tile, painted once for all shapes in one coordinate system; null if it is too complex.
   *
   * @param {Place} place
   * @param {Tiling} tiling
   * @returns {Steps<import('./tiles.js').FirstTile | null>}
   */
  *firstTile(place, tiling) {
    const { servers, engine } = this.scene;
    const { pattern, tile, whole, content, view } = tiling;
    const key = JSON.stringify([servers.numberOf(pattern), tile, whole, content, view.width, view.height]);
    let first = servers.tiles.get(key);
    if (!first) {
      if (!servers.affords(pattern.element, { elements: engine.count(pattern.holder) })) return null;
      const canvas = { frame: tile, size: this.canvas.size, whole };
      const [painter, veil] = [new Painter(this.scene, canvas), new Veil(null, 1)];
      yield* this.scene.walk(firstTileContent(tiling, place, veil, engine), painter);
      first = firstTileOf(canvas, veil, painter.paths.map((path, k) => ({ path, veil: painter.veils[k] })));
      servers.tiles.set(key, first);
    }
    return copyVeils(first);
  }
}

/** @param {Float64Array[]} contours @returns {import('./contours.js').Bounds} box of all points */
function boxOf(contours) {
  return contours.map(controlBox).reduce((a, b) => {
    return [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
  });
}

/** Collects the outlines of shapes, and of strokes if requested, to measure them; paints do not matter. */
export class Ruler extends Painter {
  /** @param {import('./scene.js').Scene} scene @param {boolean} isStroked */
  constructor(scene, isStroked) {
    super(scene, { frame: null, size: Infinity, whole: IDENTITY });
    this.isStroked = isStroked;
    /** @type {Float64Array[]} */
    this.corners = [];
  }

  /**
   * Add the outlines of a shape, in the units of the outermost place.
   *
   * @param {any} element
   * @param {Place} place
   * @returns {Steps<void>}
   */
  *paint(element, place) {
    const shape = { element, style: place.style, view: place.view, tolerance: Infinity, report: this.scene.report };
    const outlines = shapeOutlines(shape);
    for (const { cubics } of outlines) this.measure(cubics, place);
    const { strokeOutline } = this.scene;
    const stroke = this.isStroked && place.style.get('stroke') !== 'none' ? strokeOf(shape, outlines) : null;
    if (!stroke || !outlines.length || !strokeOutline) return;
    const [left, top, right, bottom] = boundsOf(outlines.map(({ cubics }) => cubics));
    const style = { ...stroke, dashes: [], tolerance: ROUND * Math.max(stroke.width, right - left, bottom - top) };
    for (const { cubics, closed } of outlines) for (const one of strokeOutline(cubics, closed, style)) this.measure(one, place);
  }

  /** @param {Float64Array} cubics @param {Place} place */
  measure(cubics, place) {
    this.corners.push(mapPoints(cubics, place.space.whole));
  }
}
