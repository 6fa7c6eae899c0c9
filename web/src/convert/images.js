// Images in an SVG (SVG 2, 12.3): embedded drawings and pictures are drawn; nothing is fetched.
import { MOST_PICTURE_PIXELS, PIXELATED } from '../../generated/svg-reader.js';
import { VextureError } from '../errors.js';
import { IDENTITY, inverse, multiply, translate } from './affine.js';
import { loopOf, rectangle } from './contours.js';
import { NO_IMAGE, decodePicture, pictureSize } from './decode-picture.js';
import { lengthOf } from './lengths.js';
import { OvertimeError } from './pace.js';
import { paintOfPicture, rowsOf } from './paints.js';
import { shortenText } from './report.js';
import { isFlat, within } from './space.js';
import { THINNEST, ownSize } from './viewport.js';

/** @template Result @typedef {import('./pace.js').Steps<Result>} Steps */
/** @typedef {import('./space.js').Place} Place */
/** @typedef {import('./scene.js').Scene} Scene */
/** @typedef {import('./decode-picture.js').Pixels} Pixels */

/** Longest file name in a note. */
const SHOWN = 40;

/** Deepest nesting of drawings in images. */
const DEEPEST = 4;

/** Most different images of a drawing. */
const MOST_IMAGES = 256;

/**
 * Paint an image at a place with its own style, or note why not.
 *
 * @param {Scene} scene
 * @param {any} element
 * @param {Place} place
 * @param {import('./painter.js').Painter} painter
 */
export function* paintImage(scene, element, place, painter) {
  const link = (scene.engine.link(element) ?? '').trim();
  if (!link || place.style.get('visibility') !== 'visible' || isFlat(place.space)) return;
  const found = yield* embeddedImage(scene, link);
  if (typeof found === 'string') return scene.report.leftOut(found);
  const [width, height] = 'rgba' in found ? [found.columns, found.rows] : ownSize((name) => found.engine.attribute(found.root, name));
  const sides = imageSides(place, [width, height]);
  if (Math.min(sides[2], sides[3], width, height) < THINNEST) return;
  const fit = scene.fit(element, [0, 0, width, height], sides[2], sides[3]);
  const content = multiply(translate(IDENTITY, sides[0], sides[1]), fit);
  const isOpen = !('rgba' in found) && ['visible', 'auto'].includes(place.style.get('overflow'));
  const visible = isOpen ? null : sides; // a picture is cut at its sides whatever `overflow` says, as in browsers
  const inner = within({ visible, content, size: [width, height] }, place);
  yield* 'rgba' in found ? paintPixels(found, inner, painter) : paintEmbedded(scene, found, inner, painter);
}

/** @param {Pixels} pixels @param {Place} place in units of pixels @param {import('./painter.js').Painter} painter */
function* paintPixels(pixels, place, painter) {
  const isSquares = PIXELATED.includes(place.style.get('image-rendering').toLowerCase());
  const toPixels = rowsOf(inverse(place.space.whole));
  const paint = paintOfPicture({ toPixels, pixels, sampling: isSquares ? 0 : 1, opacity: 1 });
  yield* painter.add([loopOf(rectangle(0, 0, pixels.columns, pixels.rows))], place, 0, paint, place.name);
}

/**
 * Position and size of an image; missing sides follow from the size of its content.
 *
 * @param {Place} place
 * @param {readonly [number, number]} size
 * @returns {import('./contours.js').Rectangle}
 */
export function imageSides({ style, view }, size) {
  const [x, y, own, tall] = ['x', 'y', 'width', 'height'].map((name, k) => {
    return lengthOf(view, style.get(name), k % 2 ? view.height : view.width, style.fontSize);
  });
  const ratio = Math.min(...size) >= THINNEST ? size[0] / size[1] : 1;
  const width = own ?? (tall === null ? size[0] : tall * ratio);
  return [x ?? 0, y ?? 0, width, tall ?? width / ratio];
}

/** @param {Scene} scene @param {string} link @returns {Steps<Scene | Pixels | string>} a drawing, a picture, or the text of a note */
function* embeddedImage(scene, link) {
  let found = scene.images.get(link);
  if (found === undefined) scene.images.set(link, (found = yield* openImage(scene, link)));
  return found;
}

/** @param {Scene} scene @param {string} link @returns {Steps<Scene | Pixels | string>} */
function* openImage(scene, link) {
  if (link.slice(0, 5).toLowerCase() !== 'data:') return `image '${nameOf(link)}' (nothing is fetched from an address)`;
  if (scene.images.size >= MOST_IMAGES) return `an embedded image (the drawing has more than ${MOST_IMAGES} images)`;
  let label = 'an embedded image';
  try {
    const bytes = decodeData(link);
    const size = pictureSize(bytes);
    if (!size) return yield* openDrawing(scene, new TextDecoder().decode(bytes));
    label = `an embedded ${size.format} of ${size.columns} x ${size.rows}`;
    scene.pictures.pixels += size.columns * size.rows;
    if (scene.pictures.pixels > MOST_PICTURE_PIXELS) {
      throw new VextureError(`the pictures of the drawing have more than ${MOST_PICTURE_PIXELS.toLocaleString('en-US')} pixels`, 'href');
    }
    return yield* decoded(bytes, label);
  } catch (error) {
    if (error instanceof VextureError && !(error instanceof OvertimeError)) return `${label} (${error.message})`;
    throw error;
  }
}

/** @param {Scene} scene @param {string} text @returns {Steps<Scene>} */
function* openDrawing(scene, text) {
  if (!text.trimStart().startsWith('<')) throw new VextureError(text.trim() ? NO_IMAGE : 'it is empty', 'href');
  if (scene.depth >= DEEPEST) throw new VextureError(`drawings in it are nested more than ${DEEPEST} deep`, 'href');
  return scene.inside(yield* scene.engine.open(text, scene.pace));
}

/** @param {Uint8Array} bytes @param {string} label @returns {Steps<Pixels>} */
function* decoded(bytes, label) {
  /** @type {Pixels | null} */
  let pixels = null;
  /** @type {unknown} */
  let fault = null;
  yield decodePicture(bytes, label).then((found) => void (pixels = found), (error) => void (fault = error));
  if (fault) throw fault;
  return /** @type {Pixels} */ (/** @type {unknown} */ (pixels));
}

/** @param {string} link a data: URL @returns {Uint8Array} */
function decodeData(link) {
  const [, head, body] = /^([^,]*),([^#]*)/s.exec(link) ?? [];
  if (body === undefined) throw new VextureError('its data: URL has no data', 'href');
  const latin = body.replace(/%([\da-f]{2})/gi, (_, code) => String.fromCharCode(parseInt(code, 16)));
  try {
    const bytes = /; *base64 *$/i.test(head) ? atob(latin.replace(/\s/g, '')) : unescapedBytes(latin);
    return Uint8Array.from(bytes, (letter) => letter.charCodeAt(0));
  } catch {
    throw new VextureError('its data is no base64', 'href');
  }
}

/** @param {string} text @returns {string} one letter for each byte, those of other letters as UTF-8 */
function unescapedBytes(text) {
  return text.replace(/[^\0-\xff]/gu, (letter) => String.fromCharCode(...new TextEncoder().encode(letter)));
}

/**
 * Paint another document at a place inside its viewport; nothing of this document applies to it.
 *
 * @param {Scene} scene
 * @param {Scene} inner
 * @param {Place} around
 * @param {import('./painter.js').Painter} painter
 */
function* paintEmbedded(scene, inner, around, painter) {
  const { width, height } = around.view;
  const box = inner.view(inner.root);
  if (box && Math.min(box[2], box[3]) < THINNEST) return;
  const content = box ? inner.fit(inner.root, box, width, height) : IDENTITY;
  /** @type {[number, number]} */
  const outermost = [width, height];
  const [across, down] = box ? [box[2], box[3]] : outermost;
  const view = { width: across, height: down, rem: inner.style.fontSize, outermost };
  const place = {
    ...around, view, style: inner.style, element: inner.root, outer: around, depth: around.depth + 1,
    isInstance: true, context: null,
  };
  const own = painter.forScene(inner);
  inner.used = scene.used;
  inner.size = scene.size;
  yield* inner.walk(yield* inner.insideRoot(place, own, content, [0, 0, width, height]), own);
  [painter.segments, scene.used] = [own.segments, inner.used];
}

/** @param {string} link @returns {string} the name of its file */
function nameOf(link) {
  const path = link.split(/[?#]/, 1)[0];
  let name = path.replace(/[/\\]+$/, '').split(/[/\\:]/).pop() || path;
  try {
    name = decodeURIComponent(name);
  } catch { // a name with a bare percent sign
  }
  return shortenText(name, SHOWN);
}
