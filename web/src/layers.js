// The layers of drawings: which roots they are, and the texture that tells a shader of them.
import { MOST_ROWS } from '../generated/layout.js';
import { VextureError } from './errors.js';
import { indexOf } from './names.js';
import { wordTexture } from './upload.js';
import { bounds } from './walk.js';

/** Coordinates of bounds: 16 bits behind the point. */
const FIXED_ONE = 65536;

const UNORM_ONE = 65535;

const SILHOUETTE = Object.freeze({ color: Object.freeze([0, 0, 0]), opacity: 1 });

/**
 * Texture with a row of two texels for each root: (quad, red and green, blue and opacity, 0), colours as 16 bits of
 * sRGB each; (x0, y0, x1, y1), the box around what is not empty, in 1/65536. It holds the first 16,384 roots.
 *
 * @param {import('./data.js').PackedData} data
 * @returns {import('three').DataTexture}
 */
export function layersTexture(data) {
  const height = Math.min(data.roots.length, MOST_ROWS);
  const words = new Uint32Array(8 * height);
  /** @type {Map<number, number[]>} */
  const boxes = new Map(); // roots may share a quad
  for (let row = 0; row < height; row++) {
    const { quad, paint } = data.roots[row];
    const { color, opacity } = paint ?? SILHOUETTE;
    const [red, green, blue, alpha] = [...color, opacity].map((part) => Math.round(UNORM_ONE * part));
    const box = boxes.get(quad) ?? outwards(bounds(data, quad));
    boxes.set(quad, box);
    words.set([quad, red | (green << 16), blue | (alpha << 16), 0, ...box], 8 * row);
  }
  return wordTexture(words, 2, height);
}

/**
 * A box in fixed point, rounded so that it grows.
 *
 * @param {number[]} box x0 y0 x1 y1
 */
function outwards([x0, y0, x1, y1]) {
  return [
    Math.floor(x0 * FIXED_ONE),
    Math.floor(y0 * FIXED_ONE),
    Math.ceil(x1 * FIXED_ONE),
    Math.ceil(y1 * FIXED_ONE),
  ];
}

/**
 * Which layers a drawing consists of: those of an atlas' drawing are named `NAME/...` and stand in a row.
 *
 * @param {import('./data.js').PackedData} data
 * @param {string | number} [root] name or place; without it all roots if they have paints, else the first one
 * @returns {{ first: number, count: number }}
 */
export function layersOf({ name, roots }, root) {
  const found = named(roots, root, name);
  if (found.first + found.count > MOST_ROWS) {
    throw new VextureError(
      `${name}: layers ${found.first} to ${found.first + found.count - 1}; only the first ${MOST_ROWS} can be drawn ` +
        'as layers; use several textures',
      'root',
    );
  }
  return found;
}

/**
 * @param {import('./data.js').Root[]} roots
 * @param {string | number | undefined} root
 * @param {string} texture
 */
function named(roots, root, texture) {
  if (root === undefined) return { first: 0, count: roots.every(({ paint }) => paint) ? roots.length : 1 };
  const first = typeof root === 'string' ? roots.findIndex(({ name }) => name.startsWith(`${root}/`)) : -1;
  if (first < 0 || roots.some(({ name }) => name === root)) return { first: indexOf(roots, root, texture), count: 1 };
  let end = first;
  while (end < roots.length && roots[end].name.startsWith(`${root}/`)) end++;
  return { first, count: end - first };
}
