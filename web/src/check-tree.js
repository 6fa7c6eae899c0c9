// Validates the quads and curves of trees (FORMAT.md, B.3, D.2): they are disjoint, of limited depth, and within the texels.
import { CELL_BITS, COUNT_SHIFT, HOLDS_PROGRAM, IS_MEAN, MOST_CURVES, MOST_DEPTH, QUAD_FLAG, STRAIGHT } from '../generated/layout.js';
import { REMEDY, VextureError } from './errors.js';
import { texelsIn } from './leaf.js';

const CELL_MASK = (1 << CELL_BITS) - 1;
const LOW_MASK = (1 << COUNT_SHIFT) - 1;

/** Kinds of texels already visited; PART: of a planar map, beside its quads and curves; PAIR: two straight curves of one. */
export const QUAD = 1;
export const CURVE = 2;
export const PART = 3;
export const PAIR = 4;

/**
 * @typedef {object} Found What some trees consist of.
 * @property {number} quads their number
 * @property {number} lastQuad largest index; -1 without any
 * @property {number} curves their number
 * @property {number} curveTexels number of their texels
 * @property {number} firstCurve smallest index of those; Infinity without any
 * @property {number} lastCurve
 */

/**
 * Walk down from some roots, and mark in `met` what is visited.
 *
 * Untrusted input is validated: the walk stays within the texels, visits each once and therefore ends.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met kind of each texel visited
 * @param {Iterable<number>} roots index of each root's quad, each once
 * @param {boolean} ofMap whether the cells are those of a planar map
 * @returns {Found}
 */
export function checkTree(texels, met, roots, ofMap) {
  const found = { quads: 0, lastQuad: -1, curves: 0, curveTexels: 0, firstCurve: Infinity, lastCurve: -1 };
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
    for (const quad of quads) checkQuad(texels, met, quad, ofMap, below, found);
    quads = below;
  }
  return found;
}

/**
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 * @param {number} quad
 * @param {boolean} ofMap
 * @param {number[]} below receives the quads below it
 * @param {Found} found
 */
function checkQuad(texels, met, quad, ofMap, below, found) {
  const cells = texels[4 * quad + 2];
  let quadCount = 0;
  let curveTexels = 0;
  for (let k = 0; k < 4; k++) {
    const cell = (cells >>> (CELL_BITS * k)) & CELL_MASK;
    if (cell === QUAD_FLAG) quadCount++;
    else if (!isLeaf(cell, ofMap)) {
      throw new VextureError(
        `quad ${quad}, cell ${k} is ${cell}, which is no valid cell; update this package or ${REMEDY}`,
        `quad ${quad}`,
      );
    } else {
      curveTexels += texelsIn(cell, ofMap);
      found.curves += cell >> COUNT_SHIFT;
    }
  }
  const [first, curve] = [texels[4 * quad], texels[4 * quad + 1]];
  refer(met, quad, first, quadCount, QUAD);
  refer(met, quad, curve, curveTexels, CURVE);
  for (let i = 0; i < quadCount; i++) below.push(first + i);
  found.quads++;
  found.lastQuad = Math.max(found.lastQuad, quad);
  if (!curveTexels) return;
  if (ofMap) markPairs(texels, met, cells, curve);
  found.curveTexels += curveTexels;
  found.firstCurve = Math.min(found.firstCurve, curve);
  found.lastCurve = Math.max(found.lastCurve, curve + curveTexels - 1);
}

/**
 * Mark the texels of two curves.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 * @param {number} cells word of a quad
 * @param {number} first texel of its curves
 */
function markPairs(texels, met, cells, first) {
  for (let k = 0; k < 4; k++) {
    const cell = (cells >>> (CELL_BITS * k)) & CELL_MASK;
    const end = first + texelsIn(cell, true);
    if (cell & STRAIGHT) met.fill(PAIR, first, end);
    if (cell & STRAIGHT && (cell >> COUNT_SHIFT) % 2 && texels[4 * end - 2] | texels[4 * end - 1]) {
      throw new VextureError(`texel ${end - 1} of one curve has a second one; ${REMEDY}`, `texel ${end - 1}`);
    }
    if (cell !== QUAD_FLAG) first = end;
  }
}

/**
 * @param {number} cell its byte
 * @param {boolean} ofMap
 */
function isLeaf(cell, ofMap) {
  const curves = cell >> COUNT_SHIFT;
  if (curves > MOST_CURVES) return false;
  const low = cell & LOW_MASK;
  if (!ofMap) return curves > 0 === low > 0;
  return !(low & ~(HOLDS_PROGRAM | (curves ? STRAIGHT : 0))) || cell === IS_MEAN;
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
