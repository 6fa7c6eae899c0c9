// Validates the quads and curves of trees (FORMAT.md, B.3, D.2): they are disjoint, of limited depth, and within the texels.
import { CELL_BITS, COUNT_SHIFT, MOST_CURVES, MOST_DEPTH, QUAD_FLAG } from '../generated/layout.js';
import { REMEDY, VextureError } from './errors.js';
import { texelsIn } from './leaf.js';

const CELL_MASK = (1 << CELL_BITS) - 1;

/** Bits of a cell's byte below the number of its curves. */
export const LOW_MASK = (1 << COUNT_SHIFT) - 1;

/** Kinds of texels already visited; PART: of a planar map, beside its quads and curves; PAIR: two straight curves of one. */
export const QUAD = 1;
export const CURVE = 2;
export const PART = 3;
export const PAIR = 4;

/**
 * @typedef {object} Rules Differences between planar maps and silhouettes.
 * @property {(cell: number) => boolean} isLeaf whether a cell's byte is that of a leaf
 * @property {(quad: number, curve: number, curveTexels: number) => void} see called for each quad, with the first of the
 *   texels of its curves and their number
 */

/**
 * Walk down from some roots, and mark visited texels in `met`.
 *
 * Untrusted input is validated: the walk stays within the texels, visits each once and therefore ends.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met kind of each texel visited
 * @param {Iterable<number>} roots index of each root's quad, each once
 * @param {Rules | null} rules of a planar map, or null
 */
export function checkTree(texels, met, roots, rules) {
  for (const quad of roots) {
    if (quad >= met.length) {
      throw new VextureError(`a root is quad ${quad} of ${met.length} texels; ${REMEDY}`, `quad ${quad}`);
    }
    meet(met, quad, quad, 1, QUAD);
  }
  let quads = [...roots];
  for (let depth = 0; quads.length; depth++) {
    if (depth === MOST_DEPTH) {
      throw new VextureError(
        `quad ${quads[0]} lies at depth ${depth}; the limit is ${MOST_DEPTH - 1}; ${REMEDY}`,
        `quad ${quads[0]}`,
      );
    }
    /** @type {number[]} */
    const below = [];
    for (const quad of quads) checkQuad(texels, met, quad, rules, below);
    quads = below;
  }
}

/**
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 * @param {number} quad
 * @param {Rules | null} rules
 * @param {number[]} below receives the quads below it
 */
function checkQuad(texels, met, quad, rules, below) {
  const cells = texels[4 * quad + 2];
  let quadCount = 0;
  let curveTexels = 0;
  for (let k = 0; k < 4; k++) {
    const cell = (cells >>> (CELL_BITS * k)) & CELL_MASK;
    if (cell === QUAD_FLAG) quadCount++;
    else if (!(rules?.isLeaf ?? isLeaf)(cell)) {
      throw new VextureError(
        `quad ${quad}, cell ${k} is ${cell}, which is no valid cell; update this package or ${REMEDY}`,
        `quad ${quad}`,
      );
    } else curveTexels += texelsIn(cell, !!rules);
  }
  const [first, curve] = [texels[4 * quad], texels[4 * quad + 1]];
  refer(met, quad, first, quadCount, QUAD);
  refer(met, quad, curve, curveTexels, CURVE);
  for (let i = 0; i < quadCount; i++) below.push(first + i);
  rules?.see(quad, curve, curveTexels);
}

/** @param {number} cell its byte, of a silhouette */
function isLeaf(cell) {
  return cell >> COUNT_SHIFT <= MOST_CURVES && cell >> COUNT_SHIFT > 0 === (cell & LOW_MASK) > 0;
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
function refer(met, quad, first, count, kind) {
  if (count && (first <= quad || first + count > met.length)) {
    throw new VextureError(
      `quad ${quad} has ${count} ${kind === QUAD ? 'quads' : 'curves'} from texel ${first}; they must lie after it ` +
        `and within ${met.length} texels; ${REMEDY}`,
      `quad ${quad}`,
    );
  }
  meet(met, quad, first, count, kind);
}

/**
 * @param {Uint8Array} met
 * @param {number} quad
 * @param {number} first
 * @param {number} count
 * @param {number} kind
 */
function meet(met, quad, first, count, kind) {
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
