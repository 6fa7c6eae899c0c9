// Walk through an SVG document in painting order, with a stack of its own; `use` is expanded within limits.
import { CONTAINERS, DEEPEST, MOST_USED, UNPAINTED } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { IDENTITY, aboutOrigin, isIdentity, multiply, translate } from './affine.js';
import { ClipShape } from './clip-shapes.js';
import { DRAWN, applies, noteParts, switchChildren } from './conditions.js';
import { boundsOf, loopOf, rectangle, rectangleOf } from './contours.js';
import { elementTransform, ownTransform } from './element-transform.js';
import { HIDING, filterLabel } from './filters.js';
import { imageSides, paintImage } from './images.js';
import { TooLargeError, along, lengthOf } from './lengths.js';
import { hasMarkers, markersOf } from './markers.js';
import { MASKING, addMasks } from './masks.js';
import { OvertimeError, atOnce } from './pace.js';
import { BLACK } from './paints.js';
import { Painter, Ruler } from './painter.js';
import { Report } from './report.js';
import { PaintServers } from './servers.js';
import { SHAPES } from './shapes.js';
import { SPACE, isInside, positionOf, windowIn, within, withTransform } from './space.js';
import { drawingCanvas } from './tiles.js';
import { Veil, groupPaths, veilOf } from './veils.js';
import { CENTRED, THINNEST, parseFit, viewBox, viewTransform } from './viewport.js';

/** @typedef {import('./space.js').Place} Place */
/** @typedef {import('./space.js').Placed} Placed */
/** @typedef {import('./contours.js').Rectangle} Rectangle */
/** @typedef {import('./page-engine.js').Style} Style */
/** @typedef {import('./affine.js').Affine} Affine */
/** @typedef {import('./veils.js').Group} Group */
/** @template Result @typedef {import('./pace.js').Steps<Result>} Steps */

/** An error that names an element. */
class LocatedError extends VextureError {}

/** A document to paint. */
export class Scene {
  /**
   * @param {import('./page-engine.js').Engine} engine
   * @param {import('./strokes.js').StrokeOutline | undefined} strokeOutline
   * @param {import('./pace.js').Pace} pace
   */
  constructor(engine, strokeOutline, pace) {
    this.engine = engine;
    this.pace = pace;
    this.root = engine.root;
    this.strokeOutline = strokeOutline;
    this.report = new Report(engine);
    this.servers = new PaintServers(engine, this.report);
    this.style = engine.style(engine.root);
    this.used = 0;
    /** @type {Map<any, number>} */
    this.shown = new Map();
    /** Larger side of the drawing. */
    this.size = 1;
    /** Scenes and pixels of its images, or the texts of notes, by link. @type {Map<string, Scene | import('./decode-picture.js').Pixels | string>} */
    this.images = new Map();
    this.pictures = { pixels: 0 }; // of all its pictures, and of those in its images
    this.depth = 0; // number of drawings in whose images it is
  }

  /** @param {import('./page-engine.js').Engine} engine of a drawing in an image @returns {Scene} with the same notes */
  inside(engine) {
    const scene = new Scene(engine, this.strokeOutline, this.pace);
    scene.report.counts = this.report.counts;
    scene.depth = this.depth + 1;
    scene.pictures = this.pictures;
    return scene;
  }

  /**
   * Paint everything, and determine the groups.
   *
   * @param {import('./lengths.js').Viewport} view
   * @param {Affine} content from user units to pixels
   * @param {[number, number]} size in pixels
   * @param {(paint: import('./paints.js').Paint, opacity: number) => import('./paints.js').Paint} fade
   */
  *paint(view, content, size, fade) {
    /** @type {Rectangle} */
    const frame = [0, 0, ...size];
    this.size = Math.max(...size);
    const painter = new Painter(this, drawingCanvas(frame, this.size));
    /** @type {Place} */
    const place = {
      view, space: SPACE, style: this.style, element: this.root, outer: null, depth: 0, used: false, use: null, veil: null,
      isClip: false, masks: 0, name: this.engine.attribute(this.root, 'id') ?? '', isInstance: false, context: null,
    };
    yield* this.walk(yield* this.insideRoot(place, painter, content, frame), painter);
    return groupPaths(painter.paths, painter.veils, fade);
  }

  /**
   * @param {Place} around
   * @param {Painter} painter
   * @param {Affine} content
   * @param {Rectangle} frame
   * @returns {Steps<Placed[]>}
   */
  *insideRoot(around, painter, content, frame) {
    noteParts(this.engine, this.report, this.style);
    const opacity = this.style.opacity('opacity');
    if (this.style.get('display') === 'none' || opacity === 0 || !this.noteEffects(this.root, this.style)) return [];
    let place = { ...around, space: this.spaceInside(around.space, content, frame) };
    const isMasked = Object.keys(MASKING).some((name) => this.style.get(name) !== 'none');
    if (opacity < 1 || around.outer || isMasked) place.veil = new Veil(around.veil, opacity); // there is nothing to blend with
    const inner = yield* addMasks(this, this.root, place);
    place = inner.place;
    const color = this.engine.color(this.style.get('background-color'));
    if (color && color[3] > 0) {
      const paint = { ...BLACK, color: /** @type {[number, number, number]} */ (color.slice(0, 3)), opacity: color[3] };
      yield* painter.add([loopOf(rectangle(...frame))], { ...place, space: around.space }, 0, paint, place.name);
    }
    const children = this.engine.children(this.root).reverse().map((child) => /** @type {Placed} */ ([child, place]));
    return [...inner.shown, ...children];
  }

  /** @param {import('./space.js').Space} around @param {Affine} content @param {Rectangle} frame */
  spaceInside(around, content, frame) {
    const length = along({ width: frame[2], height: frame[3], rem: this.style.fontSize, outermost: null }, this.style.fontSize);
    try {
      const move = ownTransform(this, this.root, this.style, length);
      if (isIdentity(move)) return withTransform(around, content);
      const origin = this.style.get('transform-origin') || 'center';
      return windowIn(withTransform(around, aboutOrigin(move, origin, length)), frame, content);
    } catch (error) {
      if (!(error instanceof TooLargeError)) throw error;
      this.report.leftOut(`transform of the outermost <svg>: ${error.message}`);
      return withTransform(around, content);
    }
  }

  /**
   * Paint all elements of a stack, the last first, with their content.
   *
   * @param {Placed[]} first
   * @param {Painter} painter
   * @returns {Steps<void>}
   */
  *walk(first, painter) {
    const stack = [...first];
    for (let placed = stack.pop(); placed; placed = stack.pop()) {
      const [element, place] = placed;
      if (this.pace.isDue()) yield;
      const count = place.masks || Number(place.used);
      this.checkUsed(count, place.masks);
      this.used += count;
      try {
        for (const one of (yield* this.visit(element, place, painter)).reverse()) stack.push(one); // a call has few arguments
      } catch (error) {
        if (error instanceof LocatedError || error instanceof OvertimeError || !(error instanceof VextureError)) throw error;
        const text = `${this.report.describe(element)}: ${error.message}`;
        if (!(error instanceof TooLargeError)) throw new LocatedError(text, error.field, { cause: error });
        this.report.leftOut(text);
      }
    }
  }

  /** @param {number} more @param {number} masks @throws {VextureError} if `more` further elements are too many */
  checkUsed(more, masks) {
    if (this.used + more <= MOST_USED) return;
    const subject = masks ? '<use>, clips, markers, masks and patterns show' : '<use> shows';
    const most = MOST_USED.toLocaleString('en-US');
    throw new VextureError(`${subject} more than ${most} elements (a use bomb?); draw fewer copies`, 'use');
  }

  /**
   * Paint an element, or return the elements that it shows.
   *
   * @param {any} element
   * @param {Place} place
   * @param {Painter} painter
   * @returns {Steps<Placed[]>}
   */
  *visit(element, place, painter) {
    if (element instanceof ClipShape) {
      yield* painter.add(element.contours, place, element.rule, BLACK, place.name);
      return [];
    }
    const { engine } = this;
    const name = engine.name(element);
    if (name === null && (DRAWN.includes(engine.tag(element)) || engine.isHtml(element))) {
      this.report.leftOut(`${this.report.describe(element)}, of another namespace`);
    }
    if (name === null || UNPAINTED.includes(name) || (name === 'symbol' && !place.use) || !applies(engine, element)) return [];
    const style = engine.style(element);
    const isMeasured = painter instanceof Ruler;
    const isSeen = place.isClip || isMeasured || style.opacity('opacity') > 0;
    const isHidden = style.get('display') === 'none' && !(name === 'symbol' && place.use);
    if (isHidden || !isSeen || (place.isClip && CONTAINERS.includes(name))) return [];
    if (style.get('display') === 'contents') return this.contentsOf(element, name, style, place);
    if (!DRAWN.includes(name) || name === 'text') {
      if (!isMeasured) this.report.leftOut(`<${name.slice(0, 40)}>`);
      return [];
    }
    if (!place.isClip && !isMeasured && !this.noteEffects(element, style)) return [];
    const matrix = elementTransform(this, element, style, place);
    if (place.depth >= DEEPEST) {
      throw new VextureError(
        `it stands inside ${DEEPEST.toLocaleString('en-US')} others; flatten the groups or the uses`,
        'depth',
      );
    }
    const inner = this.placeInside(element, name, style, place, matrix);
    if (!inner) return [];
    if (isMeasured) return yield* this.content(element, name, inner, painter);
    const masked = yield* addMasks(this, element, inner, inner.isClip ? ['clip-path'] : undefined);
    return [...masked.shown, ...(yield* this.content(element, name, masked.place, painter))];
  }

  /**
   * The content of an element that has no box, and so no effects (CSS Display 3, B).
   *
   * @param {any} element
   * @param {string} name
   * @param {Style} style
   * @param {Place} place
   * @returns {Placed[]}
   */
  contentsOf(element, name, style, place) {
    const inner = { ...place, style, element, outer: place, depth: place.depth + 1, use: null };
    if (name === 'use') return this.useTarget(element, inner);
    return name === 'g' || name === 'svg' ? this.engine.children(element).map((child) => [child, inner]) : [];
  }

  /**
   * The place inside an element; null if it shows nothing.
   *
   * @param {any} element
   * @param {string} name
   * @param {Style} style
   * @param {Place} place
   * @param {Affine} matrix
   * @returns {Place | null}
   */
  placeInside(element, name, style, place, matrix) {
    const space = withTransform(place.space, matrix);
    const own = this.engine.attribute(element, 'id');
    const isKept = place.isInstance || !own;
    /** @type {Place} */
    const inner = {
      ...place, space, style, element, outer: place, depth: place.depth + 1, use: null,
      veil: veilOf(style, place.veil, place.isClip),
      name: isKept ? place.name : own, isInstance: isKept ? place.isInstance : name === 'use',
    };
    if (name === 'use') return { ...inner, space: withTransform(space, translate(IDENTITY, ...positionOf(inner))) };
    if (name !== 'svg' && name !== 'symbol') return inner;
    const window = this.window(element, style, this.sides(inner, place.use));
    return window && within(window, inner);
  }

  /**
   * Paint a shape, or return the elements that another element shows.
   *
   * @param {any} element
   * @param {string} name
   * @param {Place} inner
   * @param {Painter} painter
   * @returns {Steps<Placed[]>}
   */
  *content(element, name, inner, painter) {
    if (name in SHAPES) {
      const isMarked = !inner.isClip && !(painter instanceof Ruler) && hasMarkers(name, inner.style);
      yield* painter.paint(element, inner, isMarked ? () => markersOf(this, element, inner) : null);
      return [];
    }
    if (name === 'image') {
      if (painter instanceof Ruler) painter.measure(rectangle(...imageSides(inner, [0, 0])).cubics, inner);
      else if (!inner.isClip) yield* paintImage(this, element, inner, painter);
      return [];
    }
    if (name === 'use') return this.useTarget(element, inner);
    const children = name === 'switch' ? switchChildren(this.engine, element) : this.engine.children(element);
    return children.map((child) => [child, inner]);
  }

  /** @param {any} element @param {Place} place @returns {Steps<Rectangle | null>} the box without strokes; null without area */
  *extent(element, place) {
    const box = yield* this.around(element, place, false);
    return box && Math.min(box[2], box[3]) > 0 ? box : null;
  }

  /**
   * @param {any} element
   * @param {Place} place
   * @param {boolean} isStroked
   * @returns {Steps<Rectangle | null>} the box of its content in the units of the place
   */
  *around(element, place, isStroked) {
    const silent = Object.assign(Object.create(Scene.prototype), this, { report: new Report(this.engine) });
    const ruler = new Ruler(silent, isStroked);
    const name = this.engine.name(element) ?? '';
    yield* silent.walk(yield* silent.content(element, name, { ...place, space: SPACE }, ruler), ruler);
    this.used = silent.used;
    return ruler.corners.length ? rectangleOf(boundsOf(ruler.corners)) : null;
  }

  /** @param {any} element @param {Place} place @returns {Placed[]} the element that a `use` shows */
  useTarget(element, place) {
    const link = this.engine.link(element) ?? '';
    const target = this.engine.target(link);
    if (!target) {
      this.report.leftOut(`<use> of '${link.slice(0, 40)}', which is not in the drawing`);
      return [];
    }
    if (isInside(place, target, this.engine.original)) {
      this.report.leftOut(`${this.report.describe(element)} that shows itself`);
      return [];
    }
    this.checkUsed(this.shownBy(target), place.masks);
    const context = { place, outlines: () => [this.boxOutline(place)] };
    return [[this.engine.instance(element, target), { ...place, used: true, use: place.style, context }]];
  }

  /**
   * @param {any} element
   * @returns {number} number of elements that a `use` of it shows, with those of uses inside; memorized
   */
  shownBy(element) {
    const original = this.engine.original(element);
    const known = this.shown.get(original);
    if (known !== undefined) return known;
    this.shown.set(original, 0); // a use of itself shows nothing
    let count = 1;
    for (const child of this.engine.children(original)) count += this.shownBy(child);
    const target = this.engine.name(original) === 'use' ? this.engine.target(this.engine.link(original) ?? '') : null;
    if (target) count += this.shownBy(target);
    this.shown.set(original, count);
    return count;
  }

  /** @param {Place} place @returns {import('./contours.js').Outline} the bounding box of the element at a place */
  boxOutline(place) {
    return rectangle(...(atOnce(this.extent(place.element, place)) ?? /** @type {Rectangle} */ ([0, 0, 0, 0])));
  }

  /**
   * @param {Place} place
   * @param {Style | null} use
   * @returns {Rectangle} the viewport of a nested `<svg>` or a `<symbol>`
   */
  sides(place, use) {
    const [width, height] = /** @type {const} */ (['width', 'height']).map((name) => {
      const own = use ? use.get(name) : 'auto';
      const text = (own && own !== 'auto' ? own : place.style.get(name)) || 'auto';
      const whole = place.view[name];
      return text === 'auto' ? whole : lengthOf(place.view, text, whole, place.style.fontSize) ?? 0;
    });
    return [...positionOf(place), width, height];
  }

  /**
   * @param {any} element
   * @param {Style} style
   * @param {Rectangle} sides
   * @returns {import('./space.js').ContentWindow | null}
   */
  window(element, style, sides) {
    const [x, y, width, height] = sides;
    if (!(width > 0 && height > 0)) return null;
    const box = this.view(element) ?? /** @type {Rectangle} */ ([0, 0, width, height]);
    if (Math.min(box[2], box[3]) < THINNEST) return null;
    const content = multiply([1, 0, 0, 1, x, y], this.fit(element, box, width, height));
    const isOpen = ['visible', 'auto'].includes(style.get('overflow'));
    return { visible: isOpen ? null : sides, content, size: [box[2], box[3]] };
  }

  /** @param {any} element @returns {Rectangle | null} its `viewBox`; null without a valid one */
  view(element) {
    const text = this.engine.attribute(element, 'viewBox');
    const box = text === null ? null : viewBox(text);
    if (text !== null && !box) this.report.invalid('viewBox', text, element);
    return box;
  }

  /** @param {any} element @param {Rectangle} box @param {number} width @param {number} height @returns {Affine} */
  fit(element, box, width, height) {
    const text = this.engine.attribute(element, 'preserveAspectRatio');
    const fit = text === null ? CENTRED : parseFit(text);
    if (!fit) this.report.invalid('preserveAspectRatio', text ?? '', element);
    return viewTransform(box, fit ?? CENTRED, width, height);
  }

  /**
   * Note an unsupported filter or motion.
   *
   * @param {any} element
   * @param {Style} style
   * @returns {boolean} whether anything is visible with the filter
   */
  noteEffects(element, style) {
    if (!['', 'none'].includes(style.get('offset-path'))) this.report.leftOut('offset-path');
    const value = style.get('filter');
    if (value === 'none') return true;
    const label = filterLabel(value, this.engine);
    if (label === null) this.report.invalid('filter', value.replaceAll('"', ''), element);
    else if (label !== HIDING) this.report.leftOut(label);
    return label !== HIDING;
  }
}
