// Validates texels (FORMAT.md, B.2 to B.4, D.1 to D.5): they form disjoint trees and maps, and all others are zero.
import { COORDINATE_BITS, LATTICE } from '../generated/layout.js';
import { CURVE, PAIR, checkTree } from './check-tree.js';
import { REMEDY, VextureError } from './errors.js';
import { mapParts } from './maps.js';

const COORDINATE_MASK = (1 << COORDINATE_BITS) - 1;

/**
 * Check that texels follow the format, in linear time.
 *
 * @param {Uint32Array} texels
 * @param {Pick<import('./data.js').Root, 'quad' | 'isMap'>[]} roots
 */
export function checkForest(texels, roots) {
  const met = new Uint8Array(texels.length / 4);
  const quadsOf = (/** @type {boolean} */ ofMap) =>
    new Set(roots.filter(({ isMap }) => isMap === ofMap).map(({ quad }) => quad));
  checkTree(texels, met, quadsOf(false), null);
  for (const quad of quadsOf(true)) mapParts().checkMap(texels, met, quad);
  checkRest(texels, met);
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
    if (met[texel] === CURVE || met[texel] === PAIR) {
      const ends = met[texel] === PAIR ? texels.subarray(at, at + 4) : [texels[at], texels[at + 3]];
      for (const end of ends) {
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
