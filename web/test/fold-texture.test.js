import { Matrix3, Mesh, MeshBasicMaterial, PlaneGeometry, ShaderLib } from 'three';
import { describe, expect, test } from 'vitest';
import { ENCODING_FOLD, FOLD_FILE_LIMIT, FOLD_VERSION, TEXT_FOLD } from '../generated/fold-layout.js';
import { TEXT_ENCODING, TEXT_VERSION } from '../generated/layout.js';
import { VextureError } from '../src/errors.js';
import { FoldTexture } from '../src/fold-texture.js';
import { readPacked } from '../src/packed.js';
import { ThesisTexture, readThesis } from '../src/thesis/index.js';
import { applyVectorMask } from '../src/vector-mask.js';
import { VectorMaterial } from '../src/vector-material.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture, ktx2 } from './files.js';
import { expectRefusal } from './refused.js';

const SECOND = 65536;
const [LINEAR, START, END, BOTH, PERIODIC] = [0, 1, 2, 3, 4];

/** @param {number} value */
const bits = (value) => new Uint32Array(Float32Array.of(value).buffer)[0];

/**
 * @param {number} kind
 * @param {{ x?: number, y?: number, begin?: number, duration?: number }} [facts] seconds
 */
const texel = (kind, { x = 0.25, y = -0.5, begin = 0, duration = 2 } = {}) => [
  bits(x), bits(y), ((kind << 29) | (begin * SECOND)) >>> 0, duration * SECOND,
];

/**
 * @param {number[][]} texels
 * @param {unknown} facts
 * @param {Record<string, string>} [texts]
 */
const file = (texels, facts, texts = {}) =>
  ktx2(texels, {
    [TEXT_ENCODING]: ENCODING_FOLD,
    [TEXT_VERSION]: FOLD_VERSION,
    [TEXT_FOLD]: typeof facts === 'string' ? facts : JSON.stringify(facts),
    ...texts,
  });

const ONE = { columns: 1, rows: 1, cycle: 0 };
const one = (/** @type {number} */ kind, cycle = 0, facts = {}) =>
  FoldTexture.parse(file([texel(kind, facts)], { ...ONE, cycle }));

/** @param {FoldTexture} fold @param {number[]} times */
const progress = (fold, times) => times.map((time) => (fold.at(0.5, 0.5, time).u - 0.5) / 0.25);

describe('what a fold does', () => {
  test('each kind', async () => {
    const times = [-1, 0, 0.5, 1, 1.5, 2, 9];
    expect(progress(await one(LINEAR), times)).toEqual([0, 0, 0.25, 0.5, 0.75, 1, 1]);
    expect(progress(await one(START), times)).toEqual([0, 0, 0.0625, 0.25, 0.5625, 1, 1]);
    expect(progress(await one(END), times)).toEqual([0, 0, 0.4375, 0.75, 0.9375, 1, 1]);
    expect(progress(await one(BOTH), times)).toEqual([0, 0, 0.15625, 0.5, 0.84375, 1, 1]);
    const waves = progress(await one(PERIODIC), times);
    [0, 0, 1, 0, -1, 0, 0].forEach((wave, k) => expect(waves[k]).toBeCloseTo(wave, 9));
  });

  test('a cycle, and begins of their own', async () => {
    expect(progress(await one(LINEAR, 4, { begin: 3 }), [1, 3, 0, 4e6])).toEqual([1, 0, 0.5, 0.5]);
    const fold = await one(LINEAR, 4);
    expect([fold.clock(-1), fold.clock(86401.5), fold.cycle]).toEqual([3, 1.5, 4]);
    expect((await one(LINEAR)).clock(-7)).toBe(-7);
  });

  test('texels from the top left, smooth between', async () => {
    const texels = [texel(LINEAR, { y: 0 }), texel(LINEAR, { y: 0, x: 0 }), texel(LINEAR), texel(LINEAR)];
    const fold = await FoldTexture.parse(file(texels, { columns: 2, rows: 2, cycle: 0 }));
    expect(fold.size).toEqual({ columns: 2, rows: 2 });
    expect(fold.at(0, 1, 9)).toEqual({ u: 0.25, v: 1 });
    expect(fold.at(0, 0, 9)).toEqual({ u: 0.25, v: -0.5 });
    expect(fold.at(0.5, 1, 9).u).toBeCloseTo(0.625, 12);
    expect(fold.at(1.25, 2, 9, 'repeat').u - 1.25).toBeCloseTo(fold.at(0.25, 0, 9, 'repeat').u - 0.25, 12);
  });
});

describe('a file', () => {
  test('of other kinds of content is refused', async () => {
    for (const contents of [null, 'text', {}]) {
      await expectRefusal(FoldTexture.parse(/** @type {any} */ (contents)), 'contents');
    }
    await expectRefusal(FoldTexture.parse(new ArrayBuffer(FOLD_FILE_LIMIT + 1)), 'byteLength');
    await expectRefusal(FoldTexture.parse(fixture('duck.ktx2'), 'theirs'), TEXT_ENCODING, /^theirs: /);
    await expectRefusal(readPacked(file([texel(LINEAR)], ONE)), TEXT_ENCODING);
  });

  test.each([
    [TEXT_VERSION, file([texel(LINEAR)], ONE, { [TEXT_VERSION]: '2' })],
    [TEXT_FOLD, file([texel(LINEAR)], '{')],
    [TEXT_FOLD, file([texel(LINEAR)], '[1]')],
    [TEXT_FOLD, file([texel(LINEAR)], 'null')],
    [`${TEXT_FOLD}.columns`, file([texel(LINEAR)], { ...ONE, columns: 1.5 })],
    [`${TEXT_FOLD}.rows`, file([texel(LINEAR)], { ...ONE, rows: 257 })],
    [`${TEXT_FOLD}.cycle`, file([texel(LINEAR)], { ...ONE, cycle: -1 })],
    [`${TEXT_FOLD}.cycle`, file([texel(LINEAR)], { ...ONE, cycle: '4' })],
    ['texels', file([texel(LINEAR)], { ...ONE, rows: 2 })],
    ['texels', file([texel(LINEAR), [0, 0, 0, 0]], ONE)],
    ['texel 0', file([texel(LINEAR, { x: NaN })], ONE)],
    ['texel 0', file([texel(LINEAR, { y: -Infinity })], ONE)],
    ['texel 0', file([texel(LINEAR, { y: 1.01 })], ONE)],
    ['texel 0', file([texel(5)], ONE)],
    ['texel 0', file([texel(LINEAR, { duration: 0 })], ONE)],
    ['texel 0', file([texel(LINEAR, { duration: 9000 })], ONE)],
    ['texel 0', file([texel(LINEAR, { begin: 8191.5 })], ONE)],
    ['texel 0', file([texel(LINEAR, { begin: 4 })], { ...ONE, cycle: 4 })],
    ['texel 0', file([texel(LINEAR, { duration: 5 })], { ...ONE, cycle: 4 })],
    ['texel 3', file([0, 0, 0, 0].map(() => texel(LINEAR)), { ...ONE, rows: 3 })],
  ])('with a wrong %s is refused', async (field, damaged) => {
    await expectRefusal(FoldTexture.parse(damaged, 'theirs'), field, /^theirs: .*make the fold again/);
  });
});

describe('a mask', async () => {
  const duck = new VectorTexture(await readPacked(fixture('duck.ktx2'), 'duck'));
  const fold = await one(PERIODIC, 4, { x: 0.1, y: 0 });
  const compiled = (/** @type {import('three').Material} */ material) => {
    const program = { ...ShaderLib.basic, uniforms: /** @type {Record<string, {value: any}>} */ ({}) };
    material.onBeforeCompile(/** @type {any} */ (program), /** @type {any} */ (null));
    return program;
  };

  test('follows the fold at its time', () => {
    const mask = applyVectorMask(new MeshBasicMaterial(), duck, { fold });
    const still = applyVectorMask(new MeshBasicMaterial(), duck);
    for (const time of [0, 0.5, 1.5, 402.5]) {
      mask.time = time;
      for (let k = 0; k < 200; k++) {
        const [u, v] = [(k * 0.618) % 1, (k * 0.7548) % 1];
        expect(mask.hits(u, v)).toBe(still.hits(fold.at(u, v, time).u, v));
      }
    }
    expect(Array.from({ length: 99 }, (_, k) => mask.hits(k / 99, 0.5))).not.toEqual(
      Array.from({ length: 99 }, (_, k) => still.hits(k / 99, 0.5)),
    );
  });

  test('has the fold in its program, and its time as a uniform only', () => {
    const material = new MeshBasicMaterial();
    const mask = applyVectorMask(material, duck, { fold, time: 5 });
    const { fragmentShader, uniforms } = compiled(material);
    expect(fragmentShader).toContain('vextureWrapped(vextureRootQuad, vextureFolded.uv, vextureFolded.dx, vextureFolded.dy)');
    expect([uniforms.vextureTime.value, uniforms.vextureCycle.value]).toEqual([1, 4]);
    const { version } = material;
    mask.time = 4003;
    expect([uniforms.vextureTime.value, material.version, mask.options.time]).toEqual([3, version, 4003]);
    mask.fold = null;
    expect(material.version).toBeGreaterThan(version);
    expect(compiled(material).fragmentShader).not.toMatch(/Fold/);
  });

  test('without a fold has the text it always had', () => {
    const material = new MeshBasicMaterial();
    applyVectorMask(material, duck, { mode: 'cut' });
    expect(compiled(material).fragmentShader).toContain(
      'if (vextureWrapped(vextureRootQuad, vextureUv, vextureStepX(vextureUv), vextureStepY(vextureUv)) < vextureThreshold) discard;',
    );
  });

  test('is copied with its material', () => {
    const material = new VectorMaterial({ texture: duck, fold, time: 3, transform: new Matrix3() });
    expect([material.clone().mask?.fold, material.clone().mask?.time]).toEqual([fold, 3]);
    new Mesh(new PlaneGeometry(), material);
  });

  test('refuses what does not go with one', async () => {
    const thesis = new ThesisTexture(
      await readThesis(fixture('eight/simple-small.quads.png'), fixture('eight/simple-small.curves.png'), 'thesis'),
    );
    const mask = (/** @type {any} */ texture, /** @type {any} */ options) =>
      applyVectorMask(new MeshBasicMaterial(), texture, options);
    expect(() => mask(thesis, { fold })).toThrow(/no fold; convert/);
    expect(() => mask(duck, { fold: {} })).toThrow(/FoldTexture.parse/);
    expect(() => mask(duck, { time: NaN })).toThrow(VextureError);
  });
});
