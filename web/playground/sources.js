// What the playground shows: texts that were dropped, pasted or opened, words in a font, and examples.
import { parse } from 'opentype.js';

/** @import { Drawing } from '../src/convert/index.js' */

/** @typedef {{ name: string, text: string }} Given Text of an SVG, GeoJSON or TopoJSON, and its name without suffix. */

const FONT = /\.(ttf|otf|woff)$/i;

/** Side of an em in the SVG of a word. */
const EM = 200;

/** Room around a word, in ems. */
const MARGIN = 0.15;

/** A word's font: the last one that was dropped, or that of the page. */
export class Words {
  /** @type {import('opentype.js').Font} */
  #font;

  /** @param {ArrayBuffer} content of the first font */
  constructor(content) {
    this.#font = parse(content);
  }

  /** @param {File} file */
  static isFont({ name }) {
    return FONT.test(name);
  }

  /** @param {File} file */
  async use(file) {
    try {
      this.#font = parse(await file.arrayBuffer());
    } catch (error) {
      throw new Error(`${file.name}: it cannot be read as a font (${/** @type {Error} */ (error).message}); give TrueType, OpenType or WOFF`);
    }
  }

  /**
   * A word as an SVG.
   *
   * @param {string} word
   * @returns {Given}
   */
  svgOf(word) {
    const font = this.#font;
    const path = font.getPath(word, 0, 0, EM);
    if (!path.commands.length) throw new Error(`the font has no outlines for "${word}"; type other letters, or drop another font`);
    const { x1, y1, x2, y2 } = path.getBoundingBox();
    const room = MARGIN * EM;
    const box = [x1 - room, y1 - room, x2 - x1 + 2 * room, y2 - y1 + 2 * room];
    return { name: word, text: `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${box.join(' ')}"><path d="${path.commands.map(dataOfCommand).join('')}"/></svg>` };
  }
}

/** @param {any} command of opentype.js @returns {string} */
function dataOfCommand({ type, x1, y1, x2, y2, x, y }) {
  const points = { M: [x, y], L: [x, y], Q: [x1, y1, x, y], C: [x1, y1, x2, y2, x, y], Z: [] }[/** @type {'M'} */ (type)];
  return `${type}${points.join(' ')}`;
}

/**
 * A drawing as an SVG, for the PNG of a map.
 *
 * @param {Drawing} drawing
 */
export function svgOf({ paths }) {
  const shapes = paths.map(({ contours, fillRule, paint: { color, opacity } }) => {
    const fill = `rgb(${color.map((part) => Math.round(255 * part))})`;
    return `<path d="${contours.map(dataOf).join('')}" fill="${fill}" fill-opacity="${opacity}" fill-rule="${fillRule ? 'evenodd' : 'nonzero'}"/>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1">${shapes.join('')}</svg>`;
}

/** @param {Float64Array} contour cubics, y up */
function dataOf(contour) {
  let data = `M${contour[0]} ${1 - contour[1]}`;
  for (let k = 0; k < contour.length; k += 8) {
    const [, , x1, y1, x2, y2, x3, y3] = contour.subarray(k, k + 8);
    data += `C${x1} ${1 - y1} ${x2} ${1 - y2} ${x3} ${1 - y3}`;
  }
  return `${data}Z`;
}

/**
 * The SVG or GeoJSON of a file.
 *
 * @param {File} file
 * @returns {Promise<Given>}
 */
export async function givenOf(file) {
  const zipped = new Uint8Array(await file.slice(0, 2).arrayBuffer());
  const isZipped = zipped[0] === 0x1f && zipped[1] === 0x8b;
  const text = isZipped ? await new Response(file.stream().pipeThrough(new DecompressionStream('gzip'))).text() : await file.text();
  return { name: file.name.replace(/(\.\w+){1,2}$/, '') || 'drawing', text };
}
