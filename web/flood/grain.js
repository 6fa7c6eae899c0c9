/** A fine grain of the ground, where its picture has fewer pixels than the screen. */
import { DataTexture, LinearFilter, LinearMipmapLinearFilter, RedFormat, RepeatWrapping } from 'three';
import { chance } from './canvas-textures.js';

/** Texels along each side. */
const SIDE = 256;
/** Texels between points of the noise: coarse to fine, all of the same strength. */
const STEPS = Object.freeze([16, 8, 4, 2, 1]);
/** Texels of the grain to one of the picture, and how much finer it is laid over itself. */
const FINER = Object.freeze([4, 15, 53]);
/** Parts by which the grain makes the ground lighter or darker, at most. */
const STRENGTH = 0.42;

/** Periodic noise about the middle of 0..255, in which mipmaps leave nothing of what is finer than a pixel. */
export function grainTexture() {
  const random = chance(13);
  const sums = new Float32Array(SIDE * SIDE);
  for (const step of STEPS) {
    const count = SIDE / step;
    const points = Float32Array.from({ length: count * count }, () => random() - 0.5);
    for (let at = 0; at < sums.length; at++) {
      const [x, y] = [(at % SIDE) / step, Math.floor(at / SIDE) / step];
      const [column, row] = [Math.floor(x), Math.floor(y)];
      const [right, down] = [x - column, y - row];
      const point = (/** @type {number} */ dx, /** @type {number} */ dy) =>
        points[((row + dy) % count) * count + ((column + dx) % count)];
      const upper = point(0, 0) * (1 - right) + point(1, 0) * right;
      const lower = point(0, 1) * (1 - right) + point(1, 1) * right;
      sums[at] += upper * (1 - down) + lower * down;
    }
  }
  const mean = sums.reduce((sum, value) => sum + value, 0) / sums.length;
  const texels = Uint8Array.from(sums, (value) => Math.min(Math.max(127.5 + (value - mean) * 105, 0), 255));
  const texture = new DataTexture(texels, SIDE, SIDE, RedFormat);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

const DECLARED = `uniform sampler2D vextureGrain;
uniform vec2 vextureGrainScale;
`;
const APPLIED = `
#ifdef USE_MAP
{
  vec2 at = vMapUv * vextureGrainScale;
  float grain = ${FINER.map((finer) => `texture2D(vextureGrain, at * ${finer}.0).r`).join(' + ')};
  diffuseColor.rgb *= 1.0 + ${STRENGTH.toFixed(2)} * (2.0 / ${FINER.length}.0 * grain - 1.0);
}
#endif`;

/**
 * Give a material with a picture the grain.
 *
 * @param {import('three').MeshLambertMaterial} material
 */
export function addGrain(material) {
  const { width, height } = /** @type {{width: number, height: number}} */ (material.map?.image);
  const uniforms = { vextureGrain: { value: grainTexture() }, vextureGrainScale: { value: [width / SIDE, height / SIDE] } };
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.fragmentShader = DECLARED + shader.fragmentShader.replace('#include <map_fragment>', `$&${APPLIED}`);
  };
  material.customProgramCacheKey = () => 'vexture-grain';
}
