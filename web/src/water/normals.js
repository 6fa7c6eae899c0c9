import { DataTexture, LinearFilter, LinearMipmapLinearFilter, RepeatWrapping } from 'three';
import { VextureError, line } from '../errors.js';

/** Number of waves in the sum. */
const WAVES = 40;

/** Periods across the tile, of the longest and the shortest waves. */
const LONGEST = 2;
const SHORTEST = 24;

/** Root mean square of the slopes. */
const STEEPNESS = 0.3;

/**
 * Factor of the slopes in each smaller mip level, in addition to averaging: from far away the repetition of the tile
 * must not show, and the sea looks calm.
 */
const FAR = 0.62;

/** Limits of the tile's side in pixels. */
const SIDES = Object.freeze([8, 2048]);

/**
 * Seeded random numbers from 0 to 1.
 *
 * @param {number} seed
 * @returns {() => number}
 */
function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x9e3779b9) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 16), 0x21f0aaad);
    mixed = Math.imul(mixed ^ (mixed >>> 15), 0x735a2d97);
    return ((mixed ^ (mixed >>> 15)) >>> 0) / 2 ** 32;
  };
}

/**
 * Waves with a whole number of periods in both directions, so that the tile repeats. Most run in similar directions,
 * the shorter ones in any; all have similar slopes, as in a wind sea.
 *
 * @param {() => number} random
 */
function wavesOf(random) {
  return Array.from({ length: WAVES }, (_, i) => {
    const count = LONGEST * (SHORTEST / LONGEST) ** (i / (WAVES - 1));
    const spread = 0.9 + 1.6 * (i / WAVES);
    const angle = (random() + random() - 1) * spread;
    const [x, y] = [Math.round(count * Math.cos(angle)), Math.round(count * Math.sin(angle))];
    return { x, y, phase: 2 * Math.PI * random(), slope: 0.6 + 0.8 * random() };
  });
}

/**
 * Slopes of the sum of all waves. Their sines are looked up in a table, since all angles are multiples of one.
 *
 * @param {number} size
 * @param {ReturnType<typeof wavesOf>} waves
 */
function slopesOf(size, waves) {
  const slopes = new Float32Array(2 * size * size);
  const sines = new Float32Array(size);
  for (const { x, y, phase, slope } of waves) {
    const length = Math.hypot(x, y);
    const [right, up] = [(slope * x) / length, (slope * y) / length];
    for (let i = 0; i < size; i++) sines[i] = Math.cos((2 * Math.PI * i) / size + phase);
    const step = ((x % size) + size) % size;
    for (let row = 0, at = 0; row < size; row++) {
      let turn = (((y * row) % size) + size) % size;
      for (let column = 0; column < size; column++, at += 2) {
        slopes[at] += right * sines[turn];
        slopes[at + 1] += up * sines[turn];
        turn += step;
        if (turn >= size) turn -= size;
      }
    }
  }
  return slopes;
}

/**
 * Slopes at half the resolution.
 *
 * @param {Float32Array} slopes
 * @param {number} size
 */
function halved(slopes, size) {
  const half = Math.max(1, size >> 1);
  const found = new Float32Array(2 * half * half);
  for (let row = 0, at = 0; row < half; row++) {
    for (let column = 0; column < half; column++, at += 2) {
      for (const y of [2 * row, 2 * row + 1]) {
        for (const x of [2 * column, 2 * column + 1]) {
          const from = 2 * ((y % size) * size + (x % size));
          found[at] += 0.25 * FAR * slopes[from];
          found[at + 1] += 0.25 * FAR * slopes[from + 1];
        }
      }
    }
  }
  return found;
}

/**
 * @param {Float32Array} slopes
 * @param {number} size
 * @param {number} scale
 */
function imageOf(slopes, size, scale) {
  const data = new Uint8Array(4 * size * size);
  for (let i = 0; i < size * size; i++) {
    const [x, y] = [scale * slopes[2 * i], scale * slopes[2 * i + 1]];
    const half = 127.5 / Math.hypot(x, y, 1);
    data.set([127.5 - half * x, 127.5 - half * y, 127.5 + half, 255], 4 * i);
  }
  return { data, width: size, height: size };
}

/**
 * Normal map of a sea that repeats in both directions, in the format of three.js's Water: x, y along the surface and z
 * up, -1..1 mapped to 0..255.
 *
 * @param {number} [size] pixels of a side
 * @param {number} [seed] of the random waves
 * @returns {DataTexture}
 * @throws {VextureError} if the size is out of range
 */
export function waterNormals(size = 256, seed = 1) {
  if (!Number.isInteger(size) || size < SIDES[0] || size > SIDES[1]) {
    throw new VextureError(`size is ${line(size)}; it must be a whole number from ${SIDES.join(' to ')}`, 'size');
  }
  const slopes = slopesOf(size, wavesOf(randomOf(seed)));
  let sum = 0;
  for (const slope of slopes) sum += slope * slope;
  const scale = STEEPNESS / Math.sqrt(sum / (size * size));
  const images = [imageOf(slopes, size, scale)];
  for (let side = size, far = slopes; side > 1; side >>= 1) {
    far = halved(far, side);
    images.push(imageOf(far, side >> 1, scale));
  }
  const texture = new DataTexture(images[0].data, size, size);
  texture.mipmaps = images;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}
