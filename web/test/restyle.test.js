import { Color, DataTexture, InstancedMesh, Matrix4, Mesh, PlaneGeometry, Raycaster, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { readPacked } from '../src/packed.js';
import { readStyle } from '../src/style.js';
import { rootAttribute } from '../src/attributes.js';
import { VectorMaterial } from '../src/vector-material.js';
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

  test('each element has its own colour back', async () => {
    const [texture, before] = [await read(), await read()];
    for (const element of [texture, before].flatMap(({ roots }) => roots[0].style?.elements ?? [])) {
      if (element.name === 'sea') element.name = 'sky'; // two of one name, in two colours
    }
    texture.setPaints({ ...PAINTS, hill: null });
    texture.setPaints(new Map(Object.keys(PAINTS).map((name) => [name, 'own'])));
    expect([...texture.data.texels]).toEqual([...before.data.texels]);
    expect(texture.roots[0].style).toEqual(before.roots[0].style);
  });

  test('a clone has colours of its own', async () => {
    const [texture, before] = [await read(), await read()];
    const copy = texture.clone();
    copy.setPaints(PAINTS);
    expect([...texture.data.texels]).toEqual([...before.data.texels]);
    expect(texture.roots[0].style).toEqual(before.roots[0].style);
    expect([...copy.data.texels]).toEqual([...restyled.texels]);
    expect([copy.name, copy.textures.texels === texture.textures.texels]).toEqual([texture.name, false]);
  });

  test('one element after another, as all at once', async () => {
    const texture = await read();
    texture.setPaints({});
    for (const [name, paint] of Object.entries(PAINTS)) {
      texture.setPaints({ [name]: [0.1, 0.7, 0.3, 1] });
      texture.setPaints(new Map([[name, paint]]));
    }
    expect([...texture.data.texels]).toEqual([...restyled.texels]);
    expect(texture.roots[0].style).toEqual(restyled.roots[0].style);
  });

  test('elements of one name change together', async () => {
    const [texture, other] = [await read(), await read()];
    for (const element of texture.roots[0].style?.elements ?? []) if (element.name === 'sea') element.name = 'sky';
    texture.setPaints({ sky: 'red' });
    other.setPaints({ sky: 'red', sea: 'red' });
    expect([...texture.data.texels]).toEqual([...other.data.texels]);
  });

  test('the same texture on the GPU is sent again, and other bounds make a change', async () => {
    const texture = await read();
    const { texels } = texture.textures;
    const { version } = texels;
    texture.setPaints({ sky: new Color('green') });
    expect(texture.textures.texels).toBe(texels);
    expect(texels.version).toBeGreaterThan(version);
    let changes = 0;
    texture.addEventListener('change', () => changes++);
    texture.setPaints({ sky: [0, 0, 0, 0] });
    expect(changes).toBe(1);
    expect(texture.contains(0.9, 0.6)).toBe(false);
  });

  test('texts with an opacity, and nothing at all', async () => {
    const [texture, other] = [await read(), await read()];
    texture.setPaints({ sky: '#12345680', hill: '#0F08', cloud: 'rgba(255, 0, 0, 0.5)', sail: 'hsla(0, 100%, 50%, 20%)', fog: null });
    other.setPaints({
      sky: [18 / 255, 52 / 255, 86 / 255, 128 / 255], hill: [0, 1, 0, 8 / 15], cloud: [1, 0, 0, 0.5], sail: [1, 0, 0, 0.2],
      fog: 'none',
    });
    expect([...texture.data.texels]).toEqual([...other.data.texels]);
    other.setPaints({ fog: [0, 0, 0, 0] });
    expect([...texture.data.texels]).toEqual([...other.data.texels]);
  });

  test.each([['reddish'], ['currentColor'], ['oklch(60% 0.1 50)'], ['#12345'], [NaN], [-1], [0.5], [undefined], [{}]])(
    '%s is no colour',
    async (paint) => {
      const texture = await read();
      const before = [...texture.data.texels];
      expect(() => texture.setPaints(/** @type {any} */ ({ sky: paint }))).toThrow(/a paint is .*; give a colour, four/);
      expect([...texture.data.texels]).toEqual(before);
    },
  );

  test('names that no element has, and colours that are none', async () => {
    const texture = await read();
    expect(() => texture.setPaints({ skye: 'red' })).toThrow(/no element "skye"; near names are "sky"/);
    expect(() => texture.setPaints(/** @type {any} */ (null))).toThrow(/paints are null; give an object or a Map/);
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

describe('what is sent to the GPU', () => {
  const rows = async () => {
    const { data } = await read();
    const texture = new VectorTexture({ ...data, width: 16, height: data.texels.length / 64 });
    const texels = /** @type {import('../src/upload.js').WordTexture} */ (texture.textures.texels);
    return { texture, texels, sent: texels.image.data.slice() };
  };
  const isRanged = 'updateRanges' in new DataTexture(); // since three.js 0.177

  test.runIf(isRanged)('whole rows, with all that has changed since the beginning', async () => {
    const { texture, texels, sent } = await rows();
    for (const name of ['sky', 'hill']) {
      texture.setPaints({ [name]: 'red' });
      texels.image.data.forEach((word, at) => {
        if (texels.updateRanges.some(({ start, count }) => start <= at && at < start + count)) sent[at] = word;
      });
      expect([...sent]).toEqual([...texels.image.data]);
      expect(texels.updateRanges.every(({ start, count }) => start % 64 === 0 && count === 64)).toBe(true);
      expect(texels.updateRanges.length).toBeLessThan(texels.image.height / 2);
    }
  });

  test.runIf(isRanged)('everything to a renderer that meets it', async () => {
    const { texture, texels } = await rows();
    texture.setPaints({ sky: 'red' });
    expect(texels.updateRanges.length).toBeGreaterThan(0);
    texels.addEventListener('dispose', () => {}); // as a renderer does before it sends
    expect(texels.updateRanges).toEqual([]);
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

describe('what a ray meets', () => {
  const texture = new VectorTexture(restyled);
  const mesh = new Mesh(new PlaneGeometry(1, 1), new VectorMaterial({ texture, mode: 'paint', wrap: 'repeat' }));
  const mask = /** @type {import('../src/vector-mask.js').VectorMask} */ (mesh.material.mask);
  const meet = (/** @type {number} */ x, /** @type {number} */ y, object = mesh) => {
    object.updateMatrixWorld();
    const caster = new Raycaster(new Vector3(x / 64 - 0.5, 0.5 - y / 64, 1), new Vector3(0, 0, -1));
    return /** @type {import('../src/index.js').MaskedIntersection[]} */ (caster.intersectObject(object));
  };

  test('is an element of the drawing, where the mask puts it', () => {
    mask.attach(mesh);
    expect(meet(60, 2)[0].element).toEqual({ name: 'sky', element: 0, root: 0 });
    expect(meet(26, 26)[0].element).toMatchObject({ name: 'hill' });
    mask.transform.setUvTransform(0, 0, 2, 2, 0, 0, 0);
    expect(meet(13, 45)[0].element).toMatchObject({ name: 'hill' });
    mask.transform.identity();
  });

  test('is none where the material alone is, and of drawings without elements', async () => {
    const [plain, blank] = [mesh.clone(), mesh.clone()];
    plain.material = new VectorMaterial({ texture: new VectorTexture(await readPacked(fixture('duck.ktx2'))) });
    plain.material.mask?.attach(plain);
    expect(meet(32, 32, plain)[0].element).toBeNull();
    blank.material = new VectorMaterial({ texture, mode: 'paint', background: 'own' });
    blank.material.mask?.attach(blank).transform.setUvTransform(0, 0, 3, 3, 0, 0, 0);
    expect(meet(2, 2, blank)[0].element).toBeNull();
    expect(meet(0.1, 63.9, blank)[0].element).toMatchObject({ name: 'sea' });
  });

  test('is of the instance', () => {
    const material = new VectorMaterial({ texture, mode: 'paint', instanced: true });
    const instances = new InstancedMesh(new PlaneGeometry(1, 1), material, 1);
    instances.setMatrixAt(0, new Matrix4());
    instances.geometry.setAttribute('vextureRoot', rootAttribute(texture, [0]));
    material.mask?.attach(/** @type {any} */ (instances));
    expect(meet(20, 12, /** @type {any} */ (instances))[0].element).toMatchObject({ name: 'sun' });
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
