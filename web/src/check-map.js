// Validates a planar map (FORMAT.md, D.1 to D.6): its parts lie within the texels, do not overlap, and use existing paints.
import {
  CELL_BITS,
  COORDINATE_BITS,
  COUNT_SHIFT,
  HOLDS_PROGRAM,
  IS_MEAN,
  MAP_HEAD,
  MOST_CURVES,
  MOST_PAINTS,
  QUAD_FLAG,
  STRAIGHT,
} from '../generated/layout.js';
import { LOW_MASK, PAIR, PART, checkTree } from './check-tree.js';
import { REMEDY, VextureError, line } from './errors.js';
import { texelsIn } from './leaf.js';
import { basePaint, headOf, meanBytes, paintSteps, quadsInBlock, sidesInTexel, sidesOf } from './planar-map.js';
import { checkPrograms, programOf } from './programs.js';

/** @typedef {import('./planar-map.js').Head} Head */

/**
 * @typedef {object} Found Counts of a tree.
 * @property {number} quads number of quads
 * @property {number} lastQuad largest index of a quad
 * @property {number} curves number of curves
 * @property {number} curveTexels number of the curves' texels
 * @property {number} firstCurve smallest index of those; Infinity if there are none
 * @property {number} lastCurve
 */

const CELL_MASK = (1 << CELL_BITS) - 1;

/**
 * Check a map, and mark its texels in `met`.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met kind of each texel visited
 * @param {number} quad index of its root quad
 */
export function checkMap(texels, met, quad) {
  const found = walked(texels, met, quad);
  if (quad < MAP_HEAD) refuse(quad, `the root of a map is quad ${quad}, which has no head before it`);
  const head = headOf(texels, quad);
  if (!head.operations && (head.programs || head.stops || head.pixels)) {
    refuse(quad, `the map with root ${quad} has a head that is not 0 where it must be`);
  }
  if (head.used < 1 || head.used > MOST_PAINTS) {
    refuse(quad, `the map with root ${quad} has ${head.used} paints; the limit is ${MOST_PAINTS}`);
  }
  const { quads, lastQuad, curves, curveTexels, firstCurve, lastCurve } = found;
  if (lastQuad - quad + 1 !== quads) refuse(quad, `the quads of the map with root ${quad} are not consecutive`);
  if (curves && lastCurve - firstCurve + 1 !== curveTexels) {
    refuse(quad, `the curves of the map with root ${quad} are not consecutive`);
  }
  checkWords(texels, met, quad, found);
  takeParts(met, head, found);
  checkPrograms(texels, head);
  checkPaints(texels, head, found);
}

/**
 * Check the quads and curves of a map.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 * @param {number} root index of its root quad
 * @returns {Found}
 */
function walked(texels, met, root) {
  const found = { quads: 0, lastQuad: -1, curves: 0, curveTexels: 0, firstCurve: Infinity, lastCurve: -1 };
  const see = (/** @type {number} */ quad, /** @type {number} */ curve, /** @type {number} */ curveTexels) => {
    found.quads++;
    found.lastQuad = Math.max(found.lastQuad, quad);
    if (!curveTexels) return;
    const cells = texels[4 * quad + 2];
    markPairs(texels, met, cells, curve);
    for (let k = 0; k < 4; k++) {
      const cell = (cells >>> (CELL_BITS * k)) & CELL_MASK;
      if (cell !== QUAD_FLAG) found.curves += cell >> COUNT_SHIFT;
    }
    found.curveTexels += curveTexels;
    found.firstCurve = Math.min(found.firstCurve, curve);
    found.lastCurve = Math.max(found.lastCurve, curve + curveTexels - 1);
  };
  checkTree(texels, met, [root], { isLeaf, see });
  return found;
}

/** @param {number} cell its byte */
function isLeaf(cell) {
  const curves = cell >> COUNT_SHIFT;
  if (curves > MOST_CURVES) return false;
  return !(cell & LOW_MASK & ~(HOLDS_PROGRAM | (curves ? STRAIGHT : 0))) || cell === IS_MEAN;
}

/**
 * Mark the texels that hold two curves.
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
 * @param {number} quad
 * @param {string} what
 * @returns {never}
 */
function refuse(quad, what) {
  throw new VextureError(`${what}; ${REMEDY}`, `quad ${quad}`);
}

/**
 * Check the numbers of the quads' first curves, and that curves are ordered.
 *
 * @param {Uint32Array} texels
 * @param {Uint8Array} met
 * @param {number} root
 * @param {Found} found
 */
function checkWords(texels, met, root, { quads, curveTexels, firstCurve }) {
  const heightOf = (/** @type {number} */ word) => word >>> COORDINATE_BITS;
  let isWrong = false;
  let number = 0;
  for (let quad = root; quad < root + quads; quad++) {
    isWrong ||= texels[4 * quad + 3] !== number;
    for (let k = 0; k < 4; k++) {
      const cell = (texels[4 * quad + 2] >>> (CELL_BITS * k)) & CELL_MASK;
      if (cell !== QUAD_FLAG) number += cell >> COUNT_SHIFT;
    }
  }
  for (let texel = firstCurve; texel < firstCurve + curveTexels; texel++) {
    const isPair = met[texel] === PAIR;
    isWrong ||= heightOf(texels[4 * texel]) > heightOf(texels[4 * texel + (isPair ? 1 : 3)]);
    isWrong ||= isPair && heightOf(texels[4 * texel + 2]) > heightOf(texels[4 * texel + 3]);
  }
  if (isWrong) refuse(root, `the map with root ${root} has curves out of number or a curve that goes down`);
}

/**
 * Mark the texels of the parts other than quads and curves.
 *
 * @param {Uint8Array} met
 * @param {Head} head
 * @param {Found} found
 */
function takeParts(met, { quad, used, cells, sides, paints, ...head }, { quads, curves }) {
  for (const { what, first, count } of [
    { what: 'head', first: quad - MAP_HEAD, count: MAP_HEAD },
    { what: 'cells', first: cells, count: quads + Math.ceil(quads / quadsInBlock(used)) },
    { what: 'sides', first: sides, count: Math.ceil(curves / sidesInTexel(used)) },
    { what: 'paints', first: paints, count: Math.ceil(used / 2) },
    { what: 'programs', first: head.programs, count: head.operations + head.stops + head.pixels },
  ]) {
    if (count && first + count > met.length) {
      refuse(quad, `the ${what} of the map with root ${quad} end at texel ${first + count} of ${met.length}`);
    }
    for (let texel = first; texel < first + count; texel++) {
      if (met[texel]) throw new VextureError(`texel ${texel} is a part of two things; ${REMEDY}`, `texel ${texel}`);
      met[texel] = PART;
    }
  }
}

/**
 * Check the numbers of paints, and that no premultiplied colour exceeds its opacity.
 *
 * @param {Uint32Array} texels
 * @param {Head} head whose parts lie within the texels
 * @param {Found} found
 */
function checkPaints(texels, head, { quads, curves }) {
  const { quad: root, used } = head;
  let last = 0;
  let isBright = false;
  const see = (/** @type {number[]} */ [red, green, blue, opacity]) => {
    isBright ||= Math.max(red, green, blue) > opacity;
  };
  for (let quad = root; quad < root + quads; quad++) {
    for (let k = 0; k < 4; k++) {
      const cell = (texels[4 * quad + 2] >>> (CELL_BITS * k)) & CELL_MASK;
      const base = basePaint(texels, head, quad, k);
      if (base && (cell === QUAD_FLAG || cell === IS_MEAN)) refuse(quad, 'a cell without a base paint has one');
      last = Math.max(last, base);
      see(meanBytes(texels, head, quad, k));
    }
  }
  for (let i = 0; i < curves; i++) last = Math.max(last, ...sidesOf(texels, head, i));
  if (last >= used) refuse(root, `the map with root ${root} has paint ${last} of ${used}`);
  for (let paint = 0; paint < used; paint++) if (!programOf(texels, head, paint)) see(paintSteps(texels, head, paint));
  if (isBright) refuse(root, `the map with root ${root} has a colour above its opacity`);
}

/**
 * Note whether a checked map holds gradients and pictures, and check that its style fits its paints.
 *
 * @param {import('./data.js').Root} root
 * @param {Uint32Array} texels
 */
export function checkPaintsOf(root, texels) {
  const { used, operations, pixels } = headOf(texels, root.quad);
  root.hasGradients = operations > 0;
  root.hasPictures = pixels > 0;
  const what = `the map ${line(root.name)} has`;
  if (root.style && root.hasGradients) throw new VextureError(`${what} a style, and paints that are programs; ${REMEDY}`, 'style');
  if (root.style && root.style.stacks.length !== used) {
    throw new VextureError(`${what} ${used} paints, and stacks of ${root.style.stacks.length}; ${REMEDY}`, 'style');
  }
}
