import { afterEach, describe, expect, test } from 'vitest';
import { cover } from '../src/globe/cover.js';
import { TileClient } from '../src/tiles/client.js';
import { choose } from '../src/tiles/choose.js';
import { ancestor, fixed, keyOf, lngLat, mercator, placeIn, squareOf } from '../src/tiles/grid.js';
import { Pyramid } from '../src/tiles/pyramid.js';
import { RequestQueue } from '../src/tiles/queue.js';
import { openTiles } from '../src/tiles/source.js';
import { readPacked } from '../src/packed.js';
import { fixture } from './files.js';
import { serve } from './server.js';

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

test('the poles are in tiles of the grid', () => {
  for (const lat of [-90, 90]) {
    const [, y] = mercator(5, lat);
    expect(Math.floor(y * 2 ** 20)).toBe(lat > 0 ? 0 : 2 ** 20 - 1);
  }
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

describe('a pyramid of a server', () => {
  const METADATA = JSON.stringify({ tiles: ['{z}/{x}/{y}.ktx2'], vexture: { margin: 0, zooms: [0] } });
  /** @type {import('./server.js').Server} */
  let server;
  afterEach(() => server.close());

  /** A pyramid, and what it tells. */
  const pyramidOf = async (answers, options = {}) => {
    server = await serve(answers);
    const told = [];
    const onError = (error, tile) => told.push(`${tile ? keyOf(tile) : ''} ${error.message}`);
    return { told, pyramid: new Pyramid({ source: new URL(`${server.url}/tiles.json`), pause: 0, onError, ...options }) };
  };

  const failing = (times, answer = METADATA) => (_, response) => (times-- > 0 ? response.writeHead(503).end() : response.end(answer));

  test('asks again for its metadata', async () => {
    const { pyramid, told } = await pyramidOf({ '/tiles.json': failing(2) });
    expect((await pyramid.ready).source.zooms).toEqual([0]);
    expect(told).toEqual([]);
  });

  test('opens at the next try where its metadata could not be had', async () => {
    const { pyramid, told } = await pyramidOf({ '/tiles.json': failing(1) }, { retries: 0 });
    await expect(pyramid.ready).rejects.toThrow('HTTP 503');
    expect(told).toHaveLength(1);
    pyramid.retry();
    expect((await pyramid.ready).source.zooms).toEqual([0]);
    expect([told.length, server.log.length]).toEqual([1, 2]);
  });

  test('asks once for what is no pyramid', async () => {
    const { pyramid } = await pyramidOf({ '/tiles.json': 'no JSON' });
    await expect(pyramid.ready).rejects.toThrow('is no TileJSON');
    expect(server.log).toHaveLength(1);
  });

  test.each(['tiles.json', 'map.pmtiles'])('is silent when it is not wanted any more: %s', async (name) => {
    server = await serve({ [`/${name}`]: () => {} });
    const told = [];
    const pyramid = new Pyramid({ source: `${server.url}/${name}`, pause: 0, onError: (error) => told.push(error) });
    await later();
    pyramid.dispose();
    await server.close();
    expect(await pyramid.ready).toBe(null);
    pyramid.retry();
    expect([told, pyramid.update(quads, () => {}), pyramid.client]).toEqual([[], [], null]);
  });

  test('loads nothing after its end', async () => {
    const { pyramid } = await pyramidOf({ '/tiles.json': METADATA });
    const client = await pyramid.ready;
    pyramid.dispose();
    pyramid.update(quads, () => {});
    expect(client.running).toBe(0);
  });

  test('has nothing where its server sends a page instead', async () => {
    const { pyramid, told } = await pyramidOf({ '/tiles.json': METADATA, '/0/0/0.ktx2': '<!doctype html><title>App</title>' });
    const client = await pyramid.ready;
    pyramid.update(quads, () => {});
    await expect.poll(() => client.get({ z: 0, x: 0, y: 0 })?.state).toBe('empty');
    expect([told, server.log.length]).toEqual([[], 2]);
  });

  test('says of a damaged tile what to do', async () => {
    const { pyramid, told } = await pyramidOf({ '/tiles.json': METADATA, '/0/0/0.ktx2': new Uint8Array(3) }, { retries: 0 });
    await pyramid.ready;
    pyramid.update(quads, () => {});
    await expect.poll(() => told).toHaveLength(1);
    expect(told[0]).toMatch(/^0\/0\/0 .* is a KTX 2.0 file; copy all tiles again, or make them again$/);
  });
});

test('a camera above a globe sees few quads, the deepest below it', () => {
  const eye = { position: [0, 0, 1.001], planes: [[1, 0, -1, 1.001], [-1, 0, -1, 1.001], [0, 1, -1, 1.001], [0, -1, -1, 1.001]], pixels: 500 };
  const found = cover(/** @type {any} */ (eye));
  expect(found.length).toBeLessThan(60);
  const [x, y] = mercator(0.001, 0.001);
  expect(found.some((quad) => keyOf(quad) === keyOf(ancestor({ z: 30, x: Math.floor(x * 2 ** 30), y: Math.floor(y * 2 ** 30) }, quad.z)))).toBe(true);
});

describe('an archive in memory', () => {
  const archive = fixture('parcels.pmtiles');
  const { signal } = new AbortController();
  const places = /** @type {[number, number][]} */ ([[4.5, 52.5], [5.5, 52.5]]);

  test.each([
    ['bytes', archive],
    ['a part of a buffer', new Uint8Array([...archive.slice(0, 9), ...archive]).subarray(9)],
    ['a buffer', archive.buffer.slice(archive.byteOffset, archive.byteOffset + archive.length)],
    ['a blob', new Blob([archive])],
    ['a file of a user', new File([archive], 'mine.pmtiles')],
  ])('is a pyramid: %s', async (_, given) => {
    const source = await openTiles(given);
    expect(source).toMatchObject({ name: 'parcels', attribution: 'a survey', zooms: [0, 2, 4] });
    const [x, y] = mercator(...places[0]);
    const file = await source.load({ z: 4, x: Math.floor(16 * x), y: Math.floor(16 * y) }, signal);
    expect((await readPacked(file)).roots[0].style.elements.map(({ name }) => name).sort()).toEqual(['east', 'west']);
    expect(await source.load({ z: 4, x: 0, y: 0 }, signal)).toBe(null);
  });

  test('is taken where an address is, and so is a source of one', async () => {
    for (const given of [new Blob([archive]), await openTiles(archive)]) {
      const pyramid = new Pyramid({ source: given });
      await pyramid.ready;
      const found = () => places.map((place) => pyramid.featureAt(place)?.id);
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
    expect(await says(new TextEncoder().encode('no tiles '.repeat(99)))).toMatch(/^the archive: cannot be read \(.*\); give all bytes of a \.pmtiles$/);
    expect(await says(archive.slice(0, 200))).toMatch(/^the archive: cannot be read \(.*\); give all bytes of a \.pmtiles$/);
    for (const given of [undefined, [1, 2], new Uint16Array(9)]) {
      expect(await says(given)).toMatch(/^the source is .*; give the address of a \.pmtiles or a TileJSON, or the bytes of a \.pmtiles$/);
    }
    expect(await says('http://[')).toMatch(/^the source is "http:\/\/\["; give the address/);
    await expect(new Pyramid({ source: archive.slice(0, 200) }).ready).rejects.toThrow('give all bytes of a .pmtiles');
  });
});
