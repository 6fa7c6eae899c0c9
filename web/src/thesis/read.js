// Reads a thesis texture from its pair of files (FORMAT.md, part A) and validates all that a shader relies on.
import { TEXT_ENCODING, TEXT_VERSION } from '../../generated/layout.js';
import {
  CONSTANT_ROWS,
  CURVE_WIDTH,
  ENCODING_THESIS,
  FORMAT_VERSION,
  QUAD_WIDTH,
  TEXT_CRS,
  TEXT_TRANSFORM,
} from '../../generated/thesis-layout.js';
import { REMEDY, VextureError, line } from '../errors.js';
import { checkContents } from '../mistaken.js';
import { readPng } from './png.js';
import { thesisCell } from './walk.js';

const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;

/**
 * @typedef {object} ThesisData FORMAT.md, part A.
 * @property {'thesis'} encoding which encoding it is
 * @property {string} name of the texture
 * @property {8 | 16} bits of each channel
 * @property {number} quadCount rows of the list of quads
 * @property {number} curveCount rows of the list of curves
 * @property {Uint8Array | Uint16Array} quads RGB, four pixels to a row
 * @property {Uint8Array | Uint16Array} curves RGB, two pixels to a row
 * @property {number} levels levels of quads, the largest number of steps of a descent
 * @property {import('../data.js').Root[]} roots one
 */

/**
 * Read and validate a pair of files.
 *
 * @param {ArrayBuffer | Uint8Array} quadsPng contents of `NAME.quads.png`
 * @param {ArrayBuffer | Uint8Array} curvesPng contents of `NAME.curves.png`
 * @param {string} [name]
 * @returns {Promise<ThesisData>}
 * @throws {VextureError} if a file is damaged, or the two do not belong together
 */
export async function readThesis(quadsPng, curvesPng, name = 'texture') {
  try {
    const [quads, curves] = await Promise.all([
      readList(quadsPng, QUAD_WIDTH, 'quads'),
      readList(curvesPng, CURVE_WIDTH, 'curves'),
    ]);
    for (const key of [TEXT_VERSION, TEXT_ENCODING, TEXT_TRANSFORM, TEXT_CRS]) {
      if (quads.texts.get(key) !== curves.texts.get(key)) {
        throw new VextureError(`${key} differs between the quads and the curves; ${REMEDY}`, key);
      }
    }
    if (quads.bits !== curves.bits) {
      throw new VextureError(
        `quads of ${quads.bits} bits with curves of ${curves.bits}; a pair has one depth; ${REMEDY}`,
        'bit depth',
      );
    }
    if (curves.height < CONSTANT_ROWS) {
      throw new VextureError(`${curves.height} rows of curves; there are at least ${CONSTANT_ROWS}; ${REMEDY}`, 'height');
    }
    const transform = readTransform(quads.texts);
    const crs = quads.texts.get(TEXT_CRS) ?? null;
    /** @type {ThesisData} */
    const data = {
      encoding: 'thesis',
      name,
      bits: quads.bits,
      quadCount: quads.height,
      curveCount: curves.height,
      quads: quads.pixels,
      curves: curves.pixels,
      levels: 0,
      roots: [{ name, quad: 0, transform, tolerance: 0, crs, paint: null, isMap: false, hasGradients: false, hasPictures: false, style: null }],
    };
    data.levels = checkTree(data);
    checkPixels(data);
    return data;
  } catch (error) {
    throw error instanceof VextureError ? error.in(name) : error;
  }
}

/**
 * @param {ArrayBuffer | Uint8Array} file
 * @param {number} width
 * @param {string} what
 */
async function readList(file, width, what) {
  try {
    checkContents(file);
    return await readPng(file instanceof Uint8Array ? file : new Uint8Array(file), width);
  } catch (error) {
    throw error instanceof VextureError ? error.in(what) : error;
  }
}

/**
 * @param {Map<string, string>} texts
 * @returns {number[]}
 */
function readTransform(texts) {
  for (const [key, known] of [
    [TEXT_ENCODING, ENCODING_THESIS],
    [TEXT_VERSION, FORMAT_VERSION],
  ]) {
    if (texts.get(key) !== known) {
      throw new VextureError(
        `${key} is ${line(texts.get(key))}; this package reads "${known}"; update it or ${REMEDY}`,
        key,
      );
    }
  }
  const words = (texts.get(TEXT_TRANSFORM) ?? '').trim().split(/\s+/);
  const transform = words.map((word) => (NUMBER.test(word) ? Number(word) : NaN));
  if (transform.length !== 6 || !transform.every(Number.isFinite)) {
    throw new VextureError(
      `${TEXT_TRANSFORM} is ${line(texts.get(TEXT_TRANSFORM))}; it must be six finite numbers; ${REMEDY}`,
      TEXT_TRANSFORM,
    );
  }
  return transform;
}

/**
 * Check that the rows form a tree: each is referred to once, in order, by an earlier row.
 *
 * @param {ThesisData} data
 * @returns {number} its levels
 */
function checkTree(data) {
  const level = new Uint32Array(data.quadCount).fill(1);
  const next = { quad: 1, curve: CONSTANT_ROWS };
  for (let quad = 0; quad < data.quadCount; quad++) {
    for (let k = 0; k < 4; k++) {
      const { isQuad, isCorner, row } = thesisCell(data, quad, k);
      const here = `quad ${quad}, cell ${k}`;
      if (!isQuad && row < CONSTANT_ROWS) {
        if (isCorner) throw new VextureError(`${here} calls a constant a corner (row ${row}); ${REMEDY}`, `quad ${quad}`);
        continue;
      }
      const what = isQuad ? 'quad' : 'curve';
      if (row !== next[what]) {
        throw new VextureError(
          `${here} refers to ${what} row ${row}; in order it must be ${next[what]}; ${REMEDY}`,
          `quad ${quad}`,
        );
      }
      next[what]++;
      if (!isQuad) continue;
      if (row <= quad) throw new VextureError(`${here} refers to itself or backwards (row ${row}); ${REMEDY}`, `quad ${quad}`);
      level[row] = level[quad] + 1;
    }
  }
  for (const [what, rows] of /** @type {const} */ ([['quad', data.quadCount], ['curve', data.curveCount]])) {
    if (next[what] !== rows) {
      throw new VextureError(`no cell refers to ${what} row ${next[what]} of ${rows}; ${REMEDY}`, `${what} ${next[what]}`);
    }
  }
  return level.reduce((most, one) => Math.max(most, one), 0);
}

/**
 * Check the coverages of quads and the ends of curves, which `checkTree` does not look at.
 *
 * @param {ThesisData} data
 */
function checkPixels(data) {
  for (let quad = 0; quad < data.quadCount; quad++) {
    const coverages = [0, 1, 2, 3].map((pixel) => data.quads[3 * (QUAD_WIDTH * quad + pixel) + 2]);
    if (coverages.some((one) => one !== coverages[0])) {
      throw new VextureError(
        `quad ${quad} has coverages ${coverages.join(', ')}; all must be equal; ${REMEDY}`,
        `quad ${quad}`,
      );
    }
  }
  const most = 2 ** data.bits - 1;
  for (let row = CONSTANT_ROWS; row < data.curveCount; row++) {
    const [start, end] = [0, 1].map((pixel) => data.curves[3 * (CURVE_WIDTH * row + pixel)] % most);
    if (start === end) {
      throw new VextureError(`curve row ${row}: P0 and P3 are both at edge step ${start}; ${REMEDY}`, `curve ${row}`);
    }
  }
}
