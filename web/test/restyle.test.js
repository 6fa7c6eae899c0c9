import { Color } from 'three';
import { describe, expect, test } from 'vitest';
import { readPacked } from '../src/packed.js';
import { readStyle } from '../src/style.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture } from './files.js';

const read = async () => new VectorTexture(await readPacked(fixture('elements.ktx2')));
const restyled = await readPacked(fixture('restyled.ktx2'));

/** What `make.sh` lets Python do. @type {Record<string, any>} */
const PAINTS = {
  sky: '#123456', sun: 'red', hill: [0, 1, 0, 128 / 255], cloud: 'orange', sail: 0x333333, fog: [0, 0, 0, 0],
};

describe('new colours', () => {
  test('the texels and the style are what Python makes of them', async () => {
    const texture = await read();
    texture.setPaints(PAINTS);
    expect([...texture.data.texels]).toEqual([...restyled.texels]);
    expect(texture.roots[0].style).toEqual(restyled.roots[0].style);
  });

  test('the old colours give the old texels', async () => {
    const [texture, before] = [await read(), await read()];
    const { elements } = before.roots[0].style ?? { elements: [] };
    texture.setPaints(PAINTS);
    texture.setPaints(Object.fromEntries(elements.filter(({ name }) => name)
      .map(({ name, color, opacity }) => [name, [...color, opacity]])));
    expect([...texture.data.texels]).toEqual([...before.data.texels]);
  });

  test('the same texture on the GPU is sent again, and other bounds make a change', async () => {
    const texture = await read();
    const { texels } = texture.textures;
    const { version } = texels;
    texture.setPaints({ sky: new Color('green') });
    expect(texture.textures.texels).toBe(texels);
    expect(texels.version).toBe(version + 1);
    let changes = 0;
    texture.addEventListener('change', () => changes++);
    texture.setPaints({ sky: [0, 0, 0, 0] });
    expect(changes).toBe(1);
    expect(texture.contains(0.9, 0.6)).toBe(false);
  });

  test('names that no element has, and colours that are none', async () => {
    const texture = await read();
    expect(() => texture.setPaints({ skye: 'red' })).toThrow(/no element "skye"; near names are "sky"/);
    expect(() => texture.setPaints({ sky: [0, 0, 2, 1] })).toThrow(/a paint is .*four numbers in 0..1/);
    expect(() => new VectorTexture(restyled).setPaints({ toString: 'red' })).toThrow(/no element "toString"/);
    const maps = new VectorTexture(await readPacked(fixture('maps.ktx2')));
    expect(() => maps.setPaints({ a: 'red' }, 'flag')).toThrow(/has no elements; convert the drawing with --restyle/);
  });

  test('what hides something stays opaque', async () => {
    const texture = await read();
    const { elements } = texture.roots[0].style ?? { elements: [] };
    elements[0].hides = true;
    expect(() => texture.setPaints({ sky: [1, 0, 0, 0.5] })).toThrow(/"sky" gets the opacity 0.5, but .* what it hides/);
  });
});

describe('what is at a point', () => {
  test('the topmost element, but no mask, and nothing that one hides', async () => {
    const texture = await read();
    const at = (/** @type {number} */ x, /** @type {number} */ y) => texture.elementAt(x / 64, 1 - y / 64)?.name ?? null;
    expect([at(60, 2), at(60, 60), at(20, 12), at(26, 26), at(46, 14)]).toEqual(['sky', 'sea', 'sun', 'hill', 'cloud']);
    expect([at(36, 36), at(25, 34), at(26, 50), at(33, 62)]).toEqual(['sail', 'sea', 'fog', 'sea']);
    expect(at(70, 2)).toBeNull();
  });
});

describe('untrusted styles', () => {
  const element = { name: 'a', color: [0, 0, 0] };
  const group = { outer: -1, opacity: 1, blend: 'normal' };
  const good = { elements: [element], groups: [], stacks: [[], [0]] };

  test('what Python writes', () => {
    expect(readStyle(good, 'root 0').elements).toEqual([{ ...element, opacity: 1, group: -1, hides: false }]);
  });

  /** @type {[string, any][]} */
  const broken = [
    ['a text', 'style'],
    ['no stacks', { ...good, stacks: null }],
    ['a stack of no element', { ...good, stacks: [[1]] }],
    ['an element without a name', { ...good, elements: [{ color: [0, 0, 0] }] }],
    ['a colour beyond 1', { ...good, elements: [{ ...element, color: [0, 0, 1.5] }] }],
    ['an element of no group', { ...good, elements: [{ ...element, group: 0 }] }],
    ['a group in itself', { ...good, groups: [{ ...group, outer: 0 }] }],
    ['an unknown blend mode', { ...good, groups: [{ ...group, blend: 'melt' }] }],
    ['a mask of nothing', { ...good, groups: [{ ...group, mask: 'opacity' }] }],
    ['an unknown mask', { ...good, groups: [group, { ...group, outer: 0, mask: 'ghost' }] }],
    ['very deep groups', { ...good, groups: Array.from({ length: 200 }, (_, k) => ({ ...group, outer: k - 1 })) }],
    ['a group that goes on', {
      ...good, groups: [group], elements: [{ ...element, group: 0 }, element, { ...element, group: 0 }],
    }],
  ];
  test.each(broken)('%s', (_, style) => expect(() => readStyle(style, 'root 0')).toThrow(/which no style has/));
});
