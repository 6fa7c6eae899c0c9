// The shader of maps with pictures: chosen for these alone, in all languages.
import { beforeAll, describe, expect, it } from 'vitest';
import { loadMaps } from '../src/maps.js';
import { texts } from '../src/mask-shader.js';
import { gradientsAmong } from '../src/select-root.js';
import { tileShader } from '../src/tiles/tile-shader.js';
import { endingOf, shaderText } from '../src/webgpu/shader-text.js';

const PLAIN = { hasGradients: false, hasPictures: false };
const GRADIENTS = { hasGradients: true };
const PICTURES = { hasGradients: true, hasPictures: true };
const NODE = { colours: true, linear: false, wrap: 'none', flat: false, fold: false };
const MASK = { mode: 'paint', maps: 'all', wrap: 'none', background: 'own', instanced: null, uv: 'uv', fold: '', other: null };

beforeAll(loadMaps);

describe('the number of the variant', () => {
  it.each([
    [[], 0],
    [[PLAIN], 0],
    [[PLAIN, GRADIENTS], 1],
    [[GRADIENTS, PICTURES, PLAIN], 2],
  ])('of %j is %i', (roots, number) => expect(gradientsAmong(roots)).toBe(number));

  it('differs in the endings of all names', () => {
    const endings = [0, 1, 2].flatMap((gradients) => [true, false].map((linear) => endingOf({ ...NODE, gradients, linear })));
    expect(new Set(endings).size).toBe(6);
  });
});

describe.each([0, 1, 2])('the shader with the number %i', (gradients) => {
  it.each(['glsl', 'wgsl'])('has functions for pictures in %s if it is 2', (language) => {
    const text = shaderText({ ...NODE, gradients }, language);
    expect(/vexture_picture_mean_\w+\(/.test(text)).toBe(gradients === 2);
    expect(/vexture_program_\w+\(/.test(text)).toBe(gradients > 0);
    expect(text).not.toMatch(/^#/m);
  });

  it('is chosen by masks and tiles', () => {
    const line = `#define VEXTURE_GRADIENTS ${gradients}\n`;
    expect(texts({ ...MASK, gradients }).fragmentDeclare).toContain(line);
    expect(tileShader(gradients)).toContain(line);
  });
});
