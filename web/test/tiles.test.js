import { describe, expect, test } from 'vitest';
import { cover } from '../src/globe/cover.js';
import { TileClient } from '../src/tiles/client.js';
import { choose } from '../src/tiles/choose.js';
import { FeatureColors } from '../src/tiles/feature-colors.js';
import { parts } from '../src/tiles/css-color.js';
import { ancestor, fixed, keyOf, lngLat, mercator, placeIn, squareOf } from '../src/tiles/grid.js';
import { Pyramid } from '../src/tiles/pyramid.js';
import { RequestQueue } from '../src/tiles/queue.js';
import { openTiles } from '../src/tiles/source.js';
import { readPacked } from '../src/packed.js';
import { fixture } from './files.js';

const ZOOMS = [0, 2, 4];
const later = () => new Promise((resolve) => setTimeout(resolve, 5));
const quads = [0, 1].flatMap((x) => [0, 1].map((y) => ({ z: 2, x, y, distance: x + y })));

/** What is shown while some tiles are there. */
const seen = (states, some = quads) =>
  choose(some, ZOOMS, (key) => states[key]).shown.map(({ quad, tile }) => `${keyOf(quad)} by ${keyOf(tile)}`).sort();

test('a place is the same in all tiles that hold it', () => {
  const [x, y] = mercator(4.36, 52.01);
  lngLat(x, y).forEach((part, k) => expect(part).toBeCloseTo([4.36, 52.01][k], 10));
  const tile = ancestor({ z: 30, x: Math.floor(x * 2 ** 30), y: Math.floor(y * 2 ** 30) }, 4);
  const quad = { z: 20, x: Math.floor(x * 2 ** 20), y: Math.floor(y * 2 ** 20) };
  const [u, v] = squareOf(x, y, tile, 1 / 32);
  const place = placeIn(quad, tile, 1 / 32);
  expect(u).toBeCloseTo(place.u + place.side * (x * 2 ** 20 - quad.x), 12);
  expect(v).toBeCloseTo(place.v - place.side * (y * 2 ** 20 - quad.y), 12);
  const [whole, rest] = fixed(u);
  expect(whole / 2 ** 32 + rest).toBe(u);
});

describe('a view', () => {
  test('shows a tile until all of its children are there', () => {
    expect(seen({})).toEqual([]);
    const all = { '0/0/0': 'ready', '2/0/0': 'ready', '2/0/1': 'ready', '2/1/0': 'ready' };
    expect(seen(all).map((one) => one.split(' by ')[1])).toEqual(Array(4).fill('0/0/0'));
    expect(seen({ ...all, '2/1/1': 'ready' })).toContain('2/1/1 by 2/1/1');
    expect(seen({ ...all, '2/1/1': 'failed' })).toContain('2/1/1 by 0/0/0');
    expect(seen({ ...all, '2/1/1': 'empty' })).toHaveLength(3);
  });

  test('shows what there is without a parent', () => {
    expect(seen({ '2/0/0': 'ready' })).toEqual(['2/0/0 by 2/0/0']);
  });

  test('is covered once, never coarser with one more tile, and by the deepest ones at the end', () => {
    let seed = 20;
    const chance = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    const view = [...quads, ...[0, 1, 2, 3].flatMap((x) => [0, 1].map((y) => ({ z: 4, x: 8 + x, y: 4 + y })))];
    for (let round = 0; round < 50; round++) {
      const waiting = choose(view, ZOOMS, () => undefined).wanted.map(({ key }) => key).slice(1).sort(() => chance() - 0.5);
      const states = { '0/0/0': 'ready' };
      let before = view.map(() => 0);
      for (const key of waiting) {
        states[key] = 'ready';
        const { shown } = choose(view, ZOOMS, (one) => states[one]);
        const depths = view.map((quad) => shown.filter((one) => one.quad === quad).map(({ tile }) => tile.z));
        expect(depths.map(({ length }) => length)).toEqual(view.map(() => 1));
        depths.forEach(([z], k) => expect(z).toBeGreaterThanOrEqual(before[k]));
        before = depths.flat();
      }
      expect(before).toEqual(view.map(({ z }) => z));
    }
  });

  test('asks for parents first, then for what is nearest', () => {
    const { wanted } = choose(quads, ZOOMS, () => undefined);
    expect(wanted.map(({ key }) => key)).toEqual(['0/0/0', '2/0/0', '2/0/1', '2/1/0', '2/1/1']);
  });
});

describe('requests', () => {
  test('are few at once, and aborted when nobody wants them', async () => {
    const started = [];
    const aborted = [];
    const load = (item, signal) => {
      started.push(item);
      return new Promise((_, reject) => signal.addEventListener('abort', () => reject(aborted.push(item))));
    };
    const queue = new RequestQueue(load, () => {}, () => expect.unreachable(), { most: 2 });
    const want = (...keys) => queue.want(keys.map((key) => ({ key, item: key })));
    want('a', 'b', 'c');
    expect(started).toEqual(['a', 'b']);
    want('d', 'b');
    expect([started, aborted, queue.running]).toEqual([['a', 'b', 'd'], ['a'], 2]);
    want();
    await later();
    expect([aborted, queue.running]).toEqual([['a', 'b', 'd'], 0]);
  });

  test('are made once, though they are wanted again while they run', async () => {
    const started = [];
    const queue = new RequestQueue(async (item) => void started.push(item) ?? later(), () => {}, () => {});
    for (let frame = 0; frame < 3; frame++) queue.want([{ key: 'a', item: 'a' }]);
    await expect.poll(() => queue.running).toBe(0);
    expect(started).toEqual(['a']);
  });

  test('are tried again, and told when they fail for good', async () => {
    let tried = 0;
    const failed = [];
    const load = async () => {
      throw new Error(`attempt ${++tried}`);
    };
    const queue = new RequestQueue(load, () => {}, (item, error) => failed.push([item, error.message]), { retries: 2, pause: 0 });
    queue.want([{ key: 'a', item: 'a' }]);
    await expect.poll(() => failed).toEqual([['a', 'attempt 3']]);
  });
});

test('an empty tile is known, a failed one is asked for again', async () => {
  const errors = [];
  let fails = true;
  const load = async ({ z }) => {
    if (z && fails) throw new Error('no');
    return null;
  };
  const source = { name: 'map', attribution: '', zooms: ZOOMS, margin: 0, load };
  const client = new TileClient(source, { retries: 0, onError: (_, tile) => errors.push(keyOf(tile)) });
  client.update(quads);
  await expect.poll(() => errors).toHaveLength(4);
  expect(client.get({ z: 0, x: 0, y: 0 }).state).toBe('empty');
  fails = false;
  client.retry();
  client.update(quads);
  await expect.poll(() => client.get(quads[3])?.state).toBe('empty');
  client.dispose();
  expect([...client.tiles]).toEqual([]);
});

test('colours are read, or refused in a line', () => {
  expect(parts('#f00')).toEqual([1, 0, 0, 1]);
  expect(parts('#00ff0033')).toEqual([0, 1, 0, 0.2]);
  expect(parts(0x0000ff)).toEqual([0, 0, 1, 1]);
  expect(parts('rgb(255, 0,51)')).toEqual([1, 0, 0.2, 1]);
  expect(parts(null)).toEqual([0, 0, 0, 0]);
  expect(() => parts('#ggg')).toThrow('a paint is "#ggg"; give a colour of CSS, four numbers in 0..1, or null');
  const colors = new FeatureColors();
  expect(() => colors.setTimes({ ids: ['a', 'b'], colors: [['#000']] })).toThrow('step 0 has 1 colours; give 2, one for each id');
  expect(() => colors.setTime(NaN)).toThrow('the time is null; give the number of a step');
});

test('a camera above a globe sees few quads, the deepest below it', () => {
  const eye = { position: [0, 0, 1.001], planes: [[1, 0, -1, 1.001], [-1, 0, -1, 1.001], [0, 1, -1, 1.001], [0, -1, -1, 1.001]], pixels: 500 };
  const found = cover(/** @type {any} */ (eye));
  expect(found.length).toBeLessThan(60);
  const [x, y] = mercator(0.001, 0.001);
  expect(found.some((quad) => keyOf(quad) === keyOf(ancestor({ z: 30, x: Math.floor(x * 2 ** 30), y: Math.floor(y * 2 ** 30) }, quad.z)))).toBe(true);
});

test('a paint of null hides a feature, whatever a function says of it', () => {
  const hidden = (/** @type {any} */ paints) => {
    const colors = new FeatureColors();
    colors.setPaint(() => '#ff0000');
    colors.setPaint(paints);
    return colors.paintOf('a');
  };
  expect(hidden({ b: '#000' })).toBe('#ff0000');
  expect(hidden({ a: null })).toBe(null);
});

test('a feature is hidden though the tile does not have what lies below it', async () => {
  const data = await readPacked(fixture('elements.ktx2'));
  const { elements } = data.roots[0].style;
  elements[0].hides = true;
  const colors = new FeatureColors();
  colors.setFilter((id) => id !== elements[0].name);
  expect(colors.apply({ data, colors: 0 })).not.toEqual([]);
  expect(data.roots[0].style.elements[0].opacity).toBe(0);
});

test('what is not seen is not picked', () => {
  const colors = new FeatureColors();
  colors.setPaint({ a: null });
  const seen = () => ['a', 'b', 'c'].filter((id) => colors.isSeen(id));
  expect(seen()).toEqual(['b', 'c']);
  colors.setFilter((id) => id !== 'b');
  expect(seen()).toEqual(['c']);
  colors.setTimes({ ids: ['a', 'b', 'c'], colors: [['#fff', '#fff', null], ['#fff', '#fff', '#000']] });
  expect(seen()).toEqual(['a']);
  colors.setTime(0.5);
  expect(seen()).toEqual(['a', 'c']);
});

test('a paint of undefined takes back what a feature was given', () => {
  const colors = new FeatureColors();
  colors.setPaint(() => '#ff0000');
  colors.setPaint({ a: '#000', b: '#fff' });
  colors.setPaint({ a: undefined });
  expect(['a', 'b'].map((id) => colors.paintOf(id))).toEqual(['#ff0000', '#fff']);
});

describe('an archive in memory', () => {
  const archive = fixture('parcels.pmtiles');
  const { signal } = new AbortController();
  const place = [mercator(4.5, 52.5), mercator(5.5, 52.5)];

  test.each([
    ['bytes', archive],
    ['a part of a buffer', new Uint8Array([...archive.slice(0, 9), ...archive]).subarray(9)],
    ['a buffer', archive.buffer.slice(archive.byteOffset, archive.byteOffset + archive.length)],
    ['a blob', new Blob([archive])],
    ['a file of a user', new File([archive], 'mine.pmtiles')],
  ])('is a pyramid: %s', async (_, given) => {
    const source = await openTiles(given);
    expect(source).toMatchObject({ name: 'parcels', attribution: 'a survey', zooms: [0, 2, 4] });
    const [[x, y]] = place;
    const file = await source.load({ z: 4, x: Math.floor(16 * x), y: Math.floor(16 * y) }, signal);
    expect((await readPacked(file)).roots[0].style.elements.map(({ name }) => name).sort()).toEqual(['east', 'west']);
    expect(await source.load({ z: 4, x: 0, y: 0 }, signal)).toBe(null);
  });

  test('is taken where an address is, and so is a source of one', async () => {
    for (const given of [new Blob([archive]), await openTiles(archive)]) {
      const pyramid = new Pyramid(given, {});
      await pyramid.ready;
      const found = () => place.map(([x, y]) => pyramid.featureAt(x, y)?.id);
      for (let k = 0; k < 500 && !found()[0]; k++) {
        pyramid.update([{ z: 0, x: 0, y: 0, distance: 0 }], () => {});
        await later();
      }
      expect(found()).toEqual(['west', 'east']);
      pyramid.dispose();
    }
  });

  test('says what is wrong with it in a line', async () => {
    const says = (/** @type {any} */ given) => openTiles(given).then(() => '', ({ message }) => message);
    expect(await says(new TextEncoder().encode('<svg/>'.repeat(99)))).toMatch(/^the archive: cannot be read \(.*\); give all bytes of a \.pmtiles$/);
    expect(await says(archive.slice(0, 200))).toMatch(/^the archive: cannot be read \(.*\); give all bytes of a \.pmtiles$/);
    expect(await says(undefined)).toMatch(/^the archive: cannot be read \(.*\); give all bytes of a \.pmtiles$/);
    await expect(new Pyramid(/** @type {any} */ (undefined), {}).ready).rejects.toThrow('give all bytes of a .pmtiles');
  });
});
