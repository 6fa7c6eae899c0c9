// Read an SVG as a drawing, the same value as Python's `vexture.drawing.drawing.Drawing`.
import { IDENTITY } from './affine.js';
import { isRelative, lengthOf } from './lengths.js';
import { Pace } from './pace.js';
import { fadePaint } from './paints.js';
import { fitPictures } from './picture-budget.js';
import { Scene } from './scene.js';
import { inUnitSquare, toUserUnits } from './unit-square.js';
import { dropEmptyGroups } from './veils.js';
import { ANONYMOUS, THINNEST } from './viewport.js';

/** @typedef {import('./drawing.js').Drawing} Drawing */

const UNPAINTED = 'nothing in it is painted';

/**
 * @typedef {object} SvgOptions
 * @property {string} [name] of the drawing
 * @property {import('./strokes.js').StrokeOutline} [strokeOutline] without it, strokes are left out, with a note
 * @property {Pace} [pace] limits of time
 */

/**
 * @typedef {{ size: [number, number], view: import('./lengths.js').Viewport, content: import('./affine.js').Affine }}
 *   Frame
 */

/**
 * Read the document that an engine holds.
 *
 * @param {import('./page-engine.js').Engine} engine
 * @param {SvgOptions} [options]
 * @returns {import('./pace.js').Steps<Drawing>}
 * @throws {VextureError} if a limit is exceeded
 */
export function* readSvg(engine, { name = 'drawing', strokeOutline, pace = new Pace() } = {}) {
  const scene = new Scene(engine, strokeOutline, pace);
  const frame = frameOf(scene);
  if (!frame) scene.report.remark(UNPAINTED);
  if (!frame) return { name, paths: [], groups: [], toSource: IDENTITY, sides: [1, 1], notes: scene.report.inOrder };
  const painted = yield* scene.paint(frame.view, frame.content, frame.size, fadePaint);
  const normal = yield* inUnitSquare(painted.paths, frame.size, pace);
  const { paths, groups } = dropEmptyGroups(fitPictures(normal.paths, scene.report), painted.groups);
  if (!paths.length) scene.report.remark(UNPAINTED);
  const toSource = toUserUnits(normal.toSource, frame.content);
  return { name, paths, groups, toSource, sides: normal.sides, notes: scene.report.inOrder };
}

/**
 * @param {Scene} scene
 * @returns {Frame | null} the frame that the outermost element sets; null, with a note, if a side is zero
 */
function frameOf(scene) {
  const { root, style, report } = scene;
  const box = scene.view(root);
  const rem = style.fontSize;
  const [width, height] = ['width', 'height'].map((name) => {
    const text = style.get(name) || 'auto';
    return text === 'auto' || isRelative(text) ? null : lengthOf({ width: 0, height: 0, rem, outermost: null }, text, 0, rem);
  });
  const thin = [width, height, ...(box ? [box[2], box[3]] : [])].some((side) => side !== null && side < THINNEST);
  if (thin) {
    report.remark('its width or height is zero, at which nothing is shown');
    return null;
  }
  if (box) {
    const ratio = box[2] / box[3];
    const [w, h] = width === null && height === null ? [box[2], box[3]] : [width, height];
    /** @type {[number, number]} */
    const size = [w || (h ?? 0) * ratio, h || (w ?? 0) / ratio];
    return { size, view: { width: box[2], height: box[3], rem, outermost: size }, content: scene.fit(root, box, ...size) };
  }
  /** @type {[number, number]} */
  const size = [width || ANONYMOUS[0], height || ANONYMOUS[1]];
  if (width === null || height === null) {
    const lacking = width !== null ? 'height' : height !== null ? 'width' : 'size';
    report.remark(`it has no viewBox and no ${lacking}, and is ${size[0]} x ${size[1]}, as in browsers`);
  }
  return { size, view: { width: size[0], height: size[1], rem, outermost: null }, content: IDENTITY };
}
