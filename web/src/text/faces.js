// The fonts of a text: what a caller gives as faces, and the choice among those of a family.
import { VextureError, line } from '../errors.js';

/**
 * @typedef {string | URL | ArrayBuffer | Uint8Array} FontFile address or content of a font: TTF, OTF, WOFF or WOFF2
 *
 * @typedef {object} FontFace One face of a family.
 * @property {FontFile} src its address or content
 * @property {string} [family] faces of one family stand for each other by weight and style; others are its fallbacks
 * @property {number | 'normal' | 'bold' | readonly [number, number]} [weight] 1..1000, or the range of a variable font; 400 by default
 * @property {'normal' | 'italic'} [style] `normal` by default
 * @property {string} [unicodeRange] the characters that it is used for, as in CSS: `U+0-FF, U+131`; it is fetched when a text
 *   has one of them. All by default
 *
 * @typedef {FontFile | FontFace | readonly (FontFile | FontFace)[]} FontSource fonts in order of preference: of each character
 *   the first that has it
 *
 * @typedef {object} Face A face as the worker takes it.
 * @property {string | ArrayBuffer} source absolute address, or content
 * @property {readonly [number, number]} weight
 * @property {'normal' | 'italic'} style
 * @property {string | undefined} unicodeRange
 * @property {string | null} group faces of which one is chosen; null: it is always used
 */

const NORMAL = 400,
  BOLD = 700;

/** Distances beyond any of weights: that of a weight on the side that CSS looks at last, and that of another style. */
const OTHER_SIDE = 1000,
  OTHER_STYLE = 4000;

/** The file of the package; bundlers recognise this form. */
const bundled = () => new URL('../../fonts/noto-sans.woff', import.meta.url);

/**
 * Noto Sans in its regular face, with Latin, Greek and Cyrillic letters, which the package brings along: for lists of fonts
 * that end with it, such as `[address, NOTO_SANS]`.
 *
 * @type {Readonly<FontFace>}
 */
export const NOTO_SANS = Object.freeze({
  get src() {
    return bundled(); // when it is wanted: a bundle that is no module has no address
  },
  family: 'Noto Sans of vexture',
});

/** Font of texts to which none is given; null: that of the package. @type {FontSource | null} */
let usual = null;

/**
 * Set the font of all texts to which none is given.
 *
 * @param {FontSource | null} font null: `NOTO_SANS`
 */
export function setDefaultFont(font) {
  usual = font;
}

/**
 * @param {FontSource | null} font
 * @returns {Face[]}
 * @throws {VextureError} if it is none
 */
export function facesOf(font) {
  const given = font ?? usual ?? NOTO_SANS;
  const faces = (Array.isArray(given) ? given : [given]).map(faceOf);
  if (!faces.length) throw new VextureError('the list of fonts is empty; give the address or the content of one', 'font');
  return faces;
}

/** @param {any} given @returns {Face} */
function faceOf(given) {
  const isFace = given !== null && typeof given === 'object' && 'src' in given;
  const { src, family = '', weight = NORMAL, style = 'normal', unicodeRange } = isFace ? given : { src: given };
  if (style !== 'normal' && style !== 'italic') {
    throw new VextureError(`the style of a font is ${line(style)}; it must be normal or italic`, 'style');
  }
  const [least, most] = Array.isArray(weight) ? weight : [weightOf(weight), weightOf(weight)];
  const group = isFace ? `${family} ${unicodeRange ?? ''}` : null;
  return { source: sourceOf(src), weight: [weightOf(least), weightOf(most)], style, unicodeRange, group };
}

/**
 * @param {unknown} weight
 * @returns {number}
 * @throws {VextureError} if it is none
 */
export function weightOf(weight) {
  if (weight === 'normal' || weight === 'bold') return weight === 'bold' ? BOLD : NORMAL;
  const value = typeof weight === 'string' && weight.trim() ? Number(weight) : weight;
  if (typeof value === 'number' && value >= 1 && value <= 1000) return value;
  throw new VextureError(`the weight of a font is ${line(weight)}; it must be 1 to 1000, normal or bold`, 'weight');
}

/** @param {unknown} src @returns {string | ArrayBuffer} */
function sourceOf(src) {
  if (src instanceof ArrayBuffer) return src;
  if (src instanceof Uint8Array) return sharedBuffer(src);
  if (typeof src === 'string' || src instanceof URL) {
    try {
      return new URL(src, globalThis.document?.baseURI).href;
    } catch {
      // refused below
    }
  }
  throw new VextureError(`a font is ${line(src)}; give the address or the content of a TTF, OTF, WOFF or WOFF2`, 'font');
}

/** @type {WeakMap<Uint8Array, ArrayBuffer>} */
const BUFFERS = new WeakMap();

/** One buffer for each array, by which the font is known again. @param {Uint8Array} bytes @returns {ArrayBuffer} */
function sharedBuffer(bytes) {
  let buffer = BUFFERS.get(bytes);
  if (!buffer) {
    buffer = /** @type {ArrayBuffer} */ (bytes.slice().buffer);
    BUFFERS.set(bytes, buffer);
  }
  return buffer;
}

/**
 * Choose the face nearest to a weight and a style, as CSS does, of each family and range of characters. Faces keep their
 * order.
 *
 * @param {Face[]} faces
 * @param {number} weight
 * @param {boolean} isItalic
 * @returns {Face[]}
 */
export function chooseFaces(faces, weight, isItalic) {
  const style = isItalic ? 'italic' : 'normal';
  const farness = (/** @type {Face} */ face) => distanceOf(face.weight, weight) + (face.style === style ? 0 : OTHER_STYLE);
  return faces.filter((face) => {
    if (face.group === null) return true;
    const rivals = faces.filter(({ group }) => group === face.group);
    return rivals.every((rival) => farness(face) <= farness(rival)) && rivals.find((rival) => farness(rival) === farness(face)) === face;
  });
}

/**
 * How far a face is from a weight; CSS prefers lighter faces for light weights, and heavier ones for heavy weights.
 *
 * @param {readonly [number, number]} range
 * @param {number} weight
 */
function distanceOf([least, most], weight) {
  if (weight >= least && weight <= most) return 0;
  const isHeavier = least > weight;
  const prefersHeavier = weight > 500;
  return (isHeavier ? least - weight : weight - most) + (isHeavier === prefersHeavier ? 0 : OTHER_SIDE);
}
