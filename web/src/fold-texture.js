// Texture folding: the positions at which a shape is looked up move with time (FORMAT.md, part C).
import {
  ENCODING_FOLD,
  FOLD_FILE_LIMIT,
  FOLD_KIND_SHIFT,
  FOLD_MOST_DISPLACEMENT,
  FOLD_MOST_SECONDS,
  FOLD_MOST_SIDE,
  FOLD_PERIODIC,
  FOLD_SMOOTH_BOTH,
  FOLD_SMOOTH_END,
  FOLD_SMOOTH_START,
  FOLD_TICKS,
  FOLD_VERSION,
  TEXT_FOLD,
} from '../generated/fold-layout.js';
import { fold as glsl } from '../generated/fold-shader.js';
import { ROW_BITS, TEXT_ENCODING, TEXT_VERSION } from '../generated/layout.js';
import { VextureError, line } from './errors.js';
import { readKtx2 } from './ktx2.js';
import { checkContents } from './mistaken.js';
import { wordTexture } from './upload.js';

const REMEDY = 'make the fold again';

/** @type {import('./mistaken.js').Expected} */
const FOLD = { what: 'fold', form: 'a fold is a KTX 2.0 file', make: 'make one of it: vexture fold FILE', remedy: REMEDY };

/** The largest time, in ticks. */
const MOST_TICKS = FOLD_MOST_SECONDS * FOLD_TICKS;

/** Bits of a texel's third word that hold its start. */
const BEGIN_MASK = 2 ** FOLD_KIND_SHIFT - 1;

/**
 * @typedef {object} FoldFacts The parameters in a fold's file.
 * @property {number} columns
 * @property {number} rows
 * @property {number} cycle seconds; 0: once
 */

/**
 * Moves the positions at which a mask looks up its shape; the option `fold` of `applyVectorMask`. The mask holds the
 * time, so several masks can share a fold. Made by `FoldTexture.parse`.
 */
export class FoldTexture {
  #facts;
  #words;
  #displacements;
  #texture;

  /**
   * @internal
   * @param {FoldFacts} facts
   * @param {Uint32Array} words four to a texel, validated
   */
  constructor(facts, words) {
    this.#facts = facts;
    this.#words = words;
    this.#displacements = new Float32Array(words.buffer, words.byteOffset, words.length);
    this.#texture = wordTexture(words, facts.columns, facts.rows);
  }

  /**
   * Read and validate a fold's file.
   *
   * @param {ArrayBuffer | Uint8Array} buffer
   * @param {string} [name] names it in messages
   * @returns {Promise<FoldTexture>}
   * @throws {VextureError} if the file is damaged or breaks the format
   */
  static async parse(buffer, name = 'fold') {
    try {
      checkContents(buffer);
      if (buffer.byteLength > FOLD_FILE_LIMIT) {
        throw new VextureError(`longer than ${FOLD_FILE_LIMIT} bytes, so not a fold; ${REMEDY}`, 'byteLength');
      }
      const { texels, texts } = await readKtx2(buffer, FOLD);
      for (const [key, known] of [
        [TEXT_ENCODING, ENCODING_FOLD],
        [TEXT_VERSION, FOLD_VERSION],
      ]) {
        if (texts.get(key) !== known) {
          throw new VextureError(`${key} is ${line(texts.get(key))}; a fold has "${known}"; ${REMEDY}`, key);
        }
      }
      const facts = readFacts(texts.get(TEXT_FOLD) ?? '');
      checkTexels(texels, facts);
      return new FoldTexture(facts, texels.slice(0, 4 * facts.columns * facts.rows));
    } catch (error) {
      throw error instanceof VextureError ? error.in(name) : error;
    }
  }

  /** Always true: identifies a fold. */
  get isFoldTexture() {
    return true;
  }

  /** Value of the uniform `vextureFolding`. @returns {import('three').DataTexture} */
  get texture() {
    return this.#texture;
  }

  /** Columns and rows. */
  get size() {
    return { columns: this.#facts.columns, rows: this.#facts.rows };
  }

  /** Period in seconds; 0: not periodic. Value of the uniform `vextureCycle`. */
  get cycle() {
    return this.#facts.cycle;
  }

  /** GLSL of the function `vextureFold`. */
  get glsl() {
    return glsl;
  }

  /**
   * Value of the uniform `vextureTime`: modulo the period, since a shader's float has 24 bits.
   *
   * @param {number} seconds
   */
  clock(seconds) {
    const { cycle } = this.#facts;
    return cycle > 0 ? seconds - cycle * Math.floor(seconds / cycle) : seconds;
  }

  /**
   * Position at which the texture is looked up at a point and a time, as computed by the shader's function.
   *
   * @param {number} u
   * @param {number} v
   * @param {number} seconds
   * @param {'none' | 'clamp' | 'repeat'} [wrap] `repeat`: the fold repeats with the shape
   */
  at(u, v, seconds, wrap = 'none') {
    const time = this.clock(seconds);
    const { columns, rows } = this.#facts;
    const x = spline(u, columns, wrap === 'repeat');
    const y = spline(v, rows, wrap === 'repeat');
    const moved = { u, v };
    for (let k = 0; k < 9; k++) {
      const at = 4 * ((rows - 1 - y.places[Math.floor(k / 3)]) * columns + x.places[k % 3]);
      const weight = x.weights[k % 3] * y.weights[Math.floor(k / 3)] * this.#progress(at, time);
      moved.u += weight * this.#displacements[at];
      moved.v += weight * this.#displacements[at + 1];
    }
    return moved;
  }

  /**
   * @param {number} at offset of a texel's words
   * @param {number} time
   */
  #progress(at, time) {
    const { cycle } = this.#facts;
    let since = time - (this.#words[at + 2] & BEGIN_MASK) / FOLD_TICKS;
    if (cycle > 0) since -= cycle * Math.floor(since / cycle);
    const part = Math.max((since * FOLD_TICKS) / this.#words[at + 3], 0);
    const x = Math.min(part, 1);
    switch (this.#words[at + 2] >>> FOLD_KIND_SHIFT) {
      case FOLD_PERIODIC:
        return Math.sin(2 * Math.PI * (part - Math.floor(part)));
      case FOLD_SMOOTH_BOTH:
        return x * x * (3 - 2 * x);
      case FOLD_SMOOTH_START:
        return x * x;
      case FOLD_SMOOTH_END:
        return 1 - (1 - x) ** 2;
      default:
        return x;
    }
  }

  /** Free the GPU memory. */
  dispose() {
    this.#texture.dispose();
  }
}

/**
 * Find the three texels of a row or a column that affect a position, and their weights.
 *
 * @param {number} place
 * @param {number} count
 * @param {boolean} repeats
 */
function spline(place, count, repeats) {
  const scaled = (repeats ? place - Math.floor(place) : Math.min(Math.max(place, -2), 2)) * count;
  const middle = Math.floor(scaled);
  const t = scaled - middle - 0.5;
  const places = [middle - 1, middle, middle + 1].map((at) =>
    repeats ? (at + count) % count : Math.min(Math.max(at, 0), count - 1),
  );
  return { places, weights: [0.5 * (0.5 - t) ** 2, 0.75 - t * t, 0.5 * (0.5 + t) ** 2] };
}

/**
 * @param {string} text
 * @returns {FoldFacts}
 */
function readFacts(text) {
  let facts;
  try {
    facts = JSON.parse(text);
  } catch (error) {
    throw new VextureError(`${TEXT_FOLD} is not JSON (${line(error)}); ${REMEDY}`, TEXT_FOLD, { cause: error });
  }
  if (typeof facts !== 'object' || facts === null || Array.isArray(facts)) {
    throw new VextureError(`${TEXT_FOLD} is ${line(text)}; it must be an object; ${REMEDY}`, TEXT_FOLD);
  }
  const { columns, rows, cycle } = facts;
  for (const [name, value] of Object.entries({ columns, rows })) {
    if (!Number.isInteger(value) || value < 1 || value > FOLD_MOST_SIDE) {
      throw new VextureError(
        `${name} is ${line(value)}; it must be 1 to ${FOLD_MOST_SIDE}; ${REMEDY}`,
        `${TEXT_FOLD}.${name}`,
      );
    }
  }
  if (typeof cycle !== 'number' || !(cycle >= 0 && cycle <= FOLD_MOST_SECONDS)) {
    throw new VextureError(
      `cycle is ${line(cycle)}; it must be 0 to ${FOLD_MOST_SECONDS} seconds; ${REMEDY}`,
      `${TEXT_FOLD}.cycle`,
    );
  }
  return { columns, rows, cycle: Math.round(cycle * FOLD_TICKS) / FOLD_TICKS };
}

/**
 * Check that texels follow the format.
 *
 * @param {Uint32Array} texels
 * @param {FoldFacts} facts
 */
function checkTexels(texels, { columns, rows, cycle }) {
  const count = columns * rows;
  const width = Math.min(2 ** Math.ceil(Math.log2(count)), 1 << ROW_BITS);
  if (texels.length !== 4 * width * Math.ceil(count / width)) {
    throw new VextureError(`${texels.length / 4} texels for ${columns} x ${rows} of a fold; ${REMEDY}`, 'texels');
  }
  const numbers = new Float32Array(texels.buffer, texels.byteOffset, texels.length);
  for (let texel = 0; texel < texels.length / 4; texel++) {
    const at = 4 * texel;
    const [begin, duration] = [texels[at + 2] & BEGIN_MASK, texels[at + 3]];
    const kind = texels[at + 2] >>> FOLD_KIND_SHIFT;
    const most = Math.max(Math.abs(numbers[at]), Math.abs(numbers[at + 1]));
    let fault = '';
    if (texel >= count) {
      if (texels[at] | texels[at + 1] | texels[at + 2] | texels[at + 3]) fault = 'is beyond the fold and not 0';
    } else if (!(most <= FOLD_MOST_DISPLACEMENT)) {
      fault = `is displaced by ${most}; the limit is ${FOLD_MOST_DISPLACEMENT}`;
    } else if (kind > FOLD_PERIODIC) {
      fault = `has the kind ${kind}; there are 0 to ${FOLD_PERIODIC}`;
    } else if (duration < 1 || duration > MOST_TICKS || begin > MOST_TICKS) {
      fault = `begins at ${begin} and lasts ${duration}; the limits are ${MOST_TICKS}, and 1 for what lasts`;
    } else if (cycle > 0 && (begin >= cycle * FOLD_TICKS || duration > cycle * FOLD_TICKS)) {
      fault = `begins at ${begin} and lasts ${duration}, but the cycle is ${cycle * FOLD_TICKS}`;
    }
    if (fault) throw new VextureError(`texel ${texel} ${fault}; ${REMEDY}`, `texel ${texel}`);
  }
}
