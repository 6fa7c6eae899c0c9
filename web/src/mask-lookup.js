// Position in the unit square at which a mask looks up its shape; mirror of the shader for one point.
import { Vector2 } from 'three';

/** Distance of clamped positions from the upper and right borders, which are outside the unit square. */
const BORDER = 2 ** -32;

/**
 * @param {number} u
 * @param {number} v the mesh's uv
 * @param {ReturnType<typeof import('./mask-options.js').complete>} options
 */
export function lookedUp(u, v, { transform, fold, time, wrap }) {
  const place = new Vector2(u, v).applyMatrix3(transform);
  if (fold) {
    const folded = fold.at(place.x, place.y, time, wrap);
    place.set(folded.u, folded.v);
  }
  if (wrap === 'none') return place;
  if (wrap === 'clamp') return place.clampScalar(0, 1 - BORDER);
  return place.set(place.x - Math.floor(place.x), place.y - Math.floor(place.y));
}
