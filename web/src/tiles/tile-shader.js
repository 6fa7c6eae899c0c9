// The fragment shader of a tile, for WebGL 2 with and without three.js: the project's functions, called for one root.
import { LATTICE } from '../../generated/layout.js';
import { packed, steps } from '../../generated/shaders.js';
import { WRAPS } from '../../generated/wraps.js';
import { withMaps } from '../maps.js';
import { fixed, placeIn } from './grid.js';

/** What a footprint keeps from where the grid ends, as a part of its lengths: thin ones are widened, and numbers are rounded. */
const APART = 1 / 64;

/** And what a tile's outlines are rounded to, as a part of its square. */
const ROUNDED = 1 / LATTICE;

const planar = withMaps(async () => (await import('../../generated/planar-shader.js')).planar);

/**
 * The text without its first line, the version. A footprint that is half outside the grid would see half of what is there: it
 * is moved to lie within.
 *
 * @param {0 | 1 | 2} gradients whether maps hold gradients (1) or pictures as well (2)
 */
export const tileShader = (gradients) => `precision highp float;
precision highp int;
precision highp usampler2D;
#define VEXTURE_FLAT 0
#define VEXTURE_LINEAR 0
#define VEXTURE_WRAP ${WRAPS.none}
#define VEXTURE_GRADIENTS ${gradients}
${steps}${packed}${planar()}
uniform uint tileRoot;
uniform uvec2 tileBase;
uniform vec4 tilePaint;
uniform float tileOpacity;
uniform vec2 tileEnds;
in vec2 tileOffset;
out vec4 tileColor;
void main() {
    vec2 dx = vextureStepX(tileOffset);
    vec2 dy = vextureStepY(tileOffset);
    vec2 wide = abs(dx) + abs(dy);
    float reach = 0.5 * wide.y + ${APART} * (wide.x + wide.y) + ${ROUNDED};
    vec2 place = vec2(tileOffset.x, clamp(tileOffset.y, tileEnds.x + reach, tileEnds.y - reach));
    vec4 color;
    if (tilePaint.a < 0.0) {
        color = vextureWrappedColor(tileRoot, tileBase, place, dx, dy);
    } else {
        color = tilePaint.a * vextureWrapped(tileRoot, tileBase, place, dx, dy) * vec4(tilePaint.rgb, 1.0);
    }
    tileColor = tileOpacity * color;
}`;

/** Beyond all offsets. */
const FAR = 2 ** 10;

/** What the shader takes for a planar map, which has its own paints. */
const OWN = Object.freeze([0, 0, 0, -1]);

/**
 * What the shader takes as tilePaint for a root.
 *
 * @param {import('../data.js').Root} root
 */
export const paintOf = ({ isMap, paint }) => (isMap || !paint ? (isMap ? OWN : [0, 0, 0, 1]) : [...paint.color, paint.opacity]);

/**
 * Where a quad begins in a tile's square, and how large it is there: with the exactness of fixed point, whatever the zoom.
 *
 * @param {import('./grid.js').TileId} quad
 * @param {import('./grid.js').TileId} tile
 * @param {number} margin
 * @returns {{ base: [number, number], rest: [number, number], side: number, ends: [number, number] }} base in 2^-32, and the rest;
 *   ends: offsets from the base at which the grid ends in the south and in the north, if it does within the quad
 */
export function lookup(quad, tile, margin) {
  const { u, v, side } = placeIn(quad, tile, margin);
  const [x, right] = fixed(u);
  const [y, above] = fixed(v);
  const ends = /** @type {[number, number]} */ ([quad.y + 1 === 2 ** quad.z ? above - side : -FAR, quad.y ? FAR : above]);
  return { base: [x, y], rest: [right, above], side, ends };
}
