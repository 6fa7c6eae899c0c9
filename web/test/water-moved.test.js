// A three.js whose Water has changed: its real shader, with one include gone.
import { PlaneGeometry } from 'three';
import { expect, test, vi } from 'vitest';
import { VectorWater } from '../src/water/index.js';

const gone = vi.hoisted(() => ({ include: '' }));

vi.mock('three/addons/objects/Water.js', async (importOriginal) => {
  const { Water } = /** @type {typeof import('three/addons/objects/Water.js')} */ (await importOriginal());
  class Changed extends Water {
    /** @param {ConstructorParameters<typeof Water>} given */
    constructor(...given) {
      super(...given);
      const { material } = /** @type {{ material: import('three').ShaderMaterial }} */ (/** @type {unknown} */ (this));
      for (const stage of /** @type {const} */ (['vertexShader', 'fragmentShader'])) {
        material[stage] = material[stage].replace(gone.include, '');
      }
    }
  }
  return { Water: Changed };
});

test.each(['common', 'logdepthbuf_vertex', 'tonemapping_fragment', 'fog_fragment'])('without %s no water is made', (name) => {
  gone.include = `#include <${name}>`;
  expect(() => new VectorWater(new PlaneGeometry(), null)).toThrow(`lacks '#include <${name}>'`);
});
