// Validates texels (FORMAT.md, B.2 to B.4): they form disjoint trees of limited depth, and all others are zero.
import {
  CELL_BITS,
  COORDINATE_BITS,
  COUNT_SHIFT,
  LATTICE,
  MOST_CURVES,
  MOST_DEPTH,
  QUAD_FLAG,
} from '../generated/layout.js';
import { REMEDY, VextureError } from './errors.js';

const CELL_MASK = (1 << CELL_BITS) - 1;
const WINDING_MASK = (1 << COUNT_SHIFT) - 1;
const COORDINATE_MASK = (1 << COORDINATE_BITS) - 1;

/** Kinds of texels already visited. */
const QUAD = 1;
const CURVE = 2;

/**
 * Check that texels follow the format, in linear time.
 *
 * Untrusted input is validated: the walk stays within the texels, visits each once and therefore ends.
 *
 * @param {Uint32Array} texels
 * @param {number[]} roots index of each root's quad
 */
export function checkForest(texels, roots) {
  const count = texels.length / 4;
  const met = new Uint8Array(count);
  let level = new Set(roots);
  for (const quad of level) {
    if (quad >= count) {
      throw new VextureError(`a root is quad ${quad} of ${count} texels; ${REMEDY}`, `quad ${quad}`);
    }
    met[quad] = QUAD;
  }
  /** @type {Iterable<number>} */
  let quads = level;
  for (let depth = 0; ; depth++) {
    const below = checkLevel(texels, met, quads, depth);
    if (!below.length) break;
    quads = below;
  }
  checkRest(texels, met);
}

/**
 * Check the quads of one depth, and return those of the next.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 * @param {Iterable<number>} quads
 * @param {number} depth
 */
function checkLevel(texels, met, quads, depth) {
  /** @type {number[]} */
  const below = [];
  for (const quad of quads) {
    if (depth === MOST_DEPTH) {
      throw new VextureError(
        `quad ${quad} lies at depth ${depth}; the limit is ${MOST_DEPTH - 1}; ${REMEDY}`,
        `quad ${quad}`,
      );
    }
    const cells = texels[4 * quad + 2];
    let quadCount = 0;
    let curveCount = 0;
    for (let k = 0; k < 4; k++) {
      const cell = (cells >>> (CELL_BITS * k)) & CELL_MASK;
      const curves = cell >> COUNT_SHIFT;
      if (cell === QUAD_FLAG) quadCount++;
      else if (cell > QUAD_FLAG || curves > MOST_CURVES || curves > 0 !== (cell & WINDING_MASK) > 0) {
        throw new VextureError(
          `quad ${quad}, cell ${k} is ${cell}, which is no valid cell; update this package or ${REMEDY}`,
          `quad ${quad}`,
        );
      } else curveCount += curves;
    }
    const first = texels[4 * quad];
    meet(met, quad, first, quadCount, QUAD);
    meet(met, quad, texels[4 * quad + 1], curveCount, CURVE);
    for (let i = 0; i < quadCount; i++) below.push(first + i);
  }
  return below;
}

/**
 * Mark the texels that a quad refers to as visited.
 *
 * @param {Uint8Array} met
 * @param {number} quad
 * @param {number} first
 * @param {number} count
 * @param {number} kind
 */
function meet(met, quad, first, count, kind) {
  if (count && (first <= quad || first + count > met.length)) {
    throw new VextureError(
      `quad ${quad} has ${count} ${kind === QUAD ? 'quads' : 'curves'} from texel ${first}; they must lie after it ` +
        `and within ${met.length} texels; ${REMEDY}`,
      `quad ${quad}`,
    );
  }
  for (let texel = first; texel < first + count; texel++) {
    if (met[texel]) {
      throw new VextureError(
        `texel ${texel} is referred to twice, by quad ${quad} now; each may be once; ${REMEDY}`,
        `texel ${texel}`,
      );
    }
    met[texel] = kind;
  }
}

/**
 * Check the curves, and that texels reached from no root are zero.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 */
function checkRest(texels, met) {
  for (let texel = 0; texel < met.length; texel++) {
    const at = 4 * texel;
    if (met[texel] === CURVE) {
      for (const end of [texels[at], texels[at + 3]]) {
        const most = Math.max(end & COORDINATE_MASK, end >>> COORDINATE_BITS);
        if (most > LATTICE) {
          throw new VextureError(
            `curve ${texel} has an end at ${most}; the limit is ${LATTICE}; ${REMEDY}`,
            `curve ${texel}`,
          );
        }
      }
    } else if (!met[texel] && (texels[at] | texels[at + 1] | texels[at + 2] | texels[at + 3]) !== 0) {
      throw new VextureError(`texel ${texel} belongs to no root and is not 0; ${REMEDY}`, `texel ${texel}`);
    }
  }
}
