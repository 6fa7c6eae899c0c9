import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { LiveVectorTexture } from '../src/live-vector-texture.js';
import { backOff } from '../src/patience.js';
import { VectorTextureLoader } from '../src/vector-texture-loader.js';
import { fixture, patched } from './files.js';
import { expectRefusal } from './refused.js';
import { serve } from './server.js';

// Node has no EventSource: here a server is polled. What a browser does with events is tested in one.

const INTERVAL = 15;

/** @type {import('./server.js').Server} */
let server;
/** @type {LiveVectorTexture[]} */
const connected = [];
/** @type {{ name: string, version: string, texture: string, events: string, note: string | null }} */
let manifest;

/** Publish other bytes under a version. */
function publish(/** @type {string} */ version, /** @type {Uint8Array} */ file) {
  manifest = { name: 'shape', version, texture: `../files/${version}.ktx2`, events: '../events', note: null };
  server.answers[`/files/${version}.ktx2`] = file;
}

/** The manifest as a server gives it. */
function manifestAnswer(/** @type {import('node:http').IncomingMessage} */ request, /** @type {import('node:http').ServerResponse} */ response) {
  const etag = `"${manifest.version}"`;
  if (request.headers['if-none-match'] === etag) return void response.writeHead(304, { ETag: etag }).end();
  response.writeHead(200, { ETag: etag, 'Cache-Control': 'no-cache', 'Content-Type': 'application/json' });
  response.end(JSON.stringify(manifest));
}

async function connect(options = {}) {
  const texture = await LiveVectorTexture.connect(`${server.url}/shapes/shape`, { interval: INTERVAL, ...options });
  connected.push(texture);
  /** @type {any[]} */
  const events = [];
  for (const type of /** @type {const} */ (['change', 'note', 'offline', 'online'])) {
    texture.addEventListener(type, (event) => events.push({ ...event, name: texture.name }));
  }
  return { texture, events };
}

/** The next event of a kind. */
const next = (/** @type {LiveVectorTexture} */ texture, /** @type {'change' | 'note' | 'offline' | 'online'} */ type) =>
  new Promise((resolve) => {
    const heard = (/** @type {any} */ event) => {
      texture.removeEventListener(type, heard);
      resolve(event);
    };
    texture.addEventListener(type, heard);
  });

/** Wait until the server has answered so many more requests. */
async function answered(/** @type {number} */ count) {
  const until = server.log.length + count;
  while (server.log.length < until) await new Promise((resolve) => setTimeout(resolve, 5));
}

beforeEach(async () => {
  server = await serve({ '/shapes/shape': manifestAnswer });
  publish('1', fixture('duck.ktx2'));
});
afterEach(async () => {
  for (const texture of connected.splice(0)) texture.close();
  await server.close();
});

describe('connecting', () => {
  test('gives the shape that is there', async () => {
    const { texture } = await connect();
    expect(texture).toMatchObject({ name: 'duck', online: true, closed: false });
    expect(texture.manifest).toMatchObject({ name: 'shape', version: '1' });
  });

  test('refuses what is no server of shapes', async () => {
    const refuse = (/** @type {string} */ url, /** @type {string} */ field) => expectRefusal(LiveVectorTexture.connect(url), field);
    await refuse(`${server.url}/shapes/none`, 'status 404');
    await refuse('/shapes/relative-to-nothing', 'url');
    server.answers['/page'] = '<!doctype html>';
    await refuse(`${server.url}/page`, 'manifest.name');
    publish('2', patched(fixture('duck.ktx2'), 12, 37));
    await refuse(`${server.url}/shapes/shape`, 'vkFormat');
    await server.close();
    await refuse(`${server.url}/shapes/shape`, 'url');
  });

  test('with the headers of a loader', async () => {
    const loader = new VectorTextureLoader().setRequestHeader({ Authorization: 'Bearer 1' }).setPath(`${server.url}/shapes/`);
    connected.push(await LiveVectorTexture.connect('shape', { loader, interval: INTERVAL }));
    await answered(1);
    expect(server.log.map(({ headers }) => headers.authorization)).toEqual(server.log.map(() => 'Bearer 1'));
  });
});

describe('following', () => {
  test('an update takes the place of the last shape in one go', async () => {
    const { texture, events } = await connect();
    const before = texture.textures.texels;
    let disposedAfterChange = false;
    before?.addEventListener('dispose', () => (disposedAfterChange = events.length === 1));
    const changed = next(texture, 'change');
    publish('2', fixture('badge.ktx2'));
    await changed;
    expect(events).toEqual([expect.objectContaining({ type: 'change', name: 'badge' })]);
    expect(texture.manifest.version).toBe('2');
    expect(texture.textures.texels).not.toBe(before);
    expect(texture.textures.texels?.image.data).toBe(/** @type {any} */ (texture.data).texels);
    expect(disposedAfterChange).toBe(true);
  });

  test('another manifest of the same texture is news, and the texture is not sent again', async () => {
    const { texture } = await connect();
    const changed = next(texture, 'change');
    const before = texture.textures;
    manifest = { ...manifest, version: '2', facts: { time: '2026-02-14T07:00:00Z' } };
    await changed;
    expect(texture.manifest.facts).toEqual(manifest.facts);
    expect(texture.textures).toBe(before);
    expect(server.log.filter((line) => JSON.stringify(line).includes('.ktx2'))).toHaveLength(1);
  });

  test('what has not changed is not sent again', async () => {
    await connect();
    await answered(3);
    expect(server.log.map(({ path, status }) => `${path} ${status}`).slice(0, 5)).toEqual([
      '/shapes/shape 200',
      '/files/1.ktx2 200',
      '/shapes/shape 304',
      '/shapes/shape 304',
      '/shapes/shape 304',
    ]);
  });

  test('a broken texture is told of once and leaves the last good one', async () => {
    const { texture, events } = await connect();
    const told = next(texture, 'note');
    publish('2', patched(fixture('badge.ktx2'), 12, 37));
    expect((await told).message).toMatch(/2.ktx2: vkFormat is 37/);
    expect(texture).toMatchObject({ name: 'duck', online: true });
    expect(texture.manifest.version).toBe('1');
    await answered(4);
    expect(events).toHaveLength(1);
    expect(server.log.filter(({ path }) => path === '/files/2.ktx2')).toHaveLength(1);
    const changed = next(texture, 'change');
    publish('3', fixture('badge.ktx2'));
    await changed;
    expect(texture.name).toBe('badge');
  });

  test("the server's own note", async () => {
    manifest.note = 'duck.svg: not a drawing';
    const { texture } = await connect();
    expect(texture.note).toBe('duck.svg: not a drawing');
    const told = next(texture, 'note');
    publish('2', fixture('duck.ktx2'));
    manifest.note = 'duck.svg: still not';
    expect((await told).message).toBe('duck.svg: still not');
    publish('3', fixture('duck.ktx2'));
    await next(texture, 'change');
    expect(texture.note).toBeNull();
  });

  test('a texture that is replaced while its manifest is on the way', async () => {
    const { texture, events } = await connect();
    const changed = next(texture, 'change');
    publish('2', fixture('badge.ktx2'));
    server.answers['/files/2.ktx2'] = (_, response) => {
      publish('3', fixture('badge.ktx2'));
      delete server.answers['/files/2.ktx2'];
      response.writeHead(404).end();
    };
    await changed;
    expect(texture.manifest.version).toBe('3');
    expect(events.map(({ type }) => type)).toEqual(['change']);
  });

  test('a listener that fails is not the fault of the server', async () => {
    const { texture, events } = await connect();
    const said = console.error;
    /** @type {unknown[]} */
    const errors = [];
    console.error = (error) => errors.push(error);
    texture.addEventListener('change', () => {
      throw new Error('a listener');
    });
    publish('2', fixture('badge.ktx2'));
    while (!errors.length) await answered(1);
    await answered(2);
    console.error = said;
    expect(errors).toEqual([expect.objectContaining({ message: 'a listener' })]);
    expect(events.map(({ type }) => type)).toEqual(['change']);
  });
});

describe('a server that is gone', () => {
  test('offline once, and back with what is new', async () => {
    const { texture, events } = await connect();
    const { answers, port } = server;
    const offline = next(texture, 'offline');
    await server.close();
    expect((await offline).message).toContain(`${server.url}/shapes/shape: cannot be fetched`);
    expect(texture).toMatchObject({ name: 'duck', online: false });
    await new Promise((resolve) => setTimeout(resolve, 700)); // more than one attempt fails meanwhile
    const changed = next(texture, 'change');
    publish('2', fixture('badge.ktx2'));
    server = await serve({ ...answers, '/files/2.ktx2': fixture('badge.ktx2') }, port);
    await changed;
    if (!texture.online) await next(texture, 'online');
    expect(events.map(({ type }) => type).sort()).toEqual(['change', 'offline', 'online']);
    expect(events[0].type).toBe('offline');
    expect(texture.name).toBe('badge');
  });

  test('answers with errors are as good as none', async () => {
    const { texture } = await connect();
    const offline = next(texture, 'offline');
    server.answers['/shapes/shape'] = (_, response) => void response.writeHead(503).end();
    expect((await offline).message).toContain('HTTP 503');
    const online = next(texture, 'online');
    server.answers['/shapes/shape'] = manifestAnswer;
    await online;
    expect(texture.name).toBe('duck');
  });

  test('a texture that cannot be had is asked for again', async () => {
    const { texture } = await connect();
    const offline = next(texture, 'offline');
    publish('2', fixture('badge.ktx2'));
    server.answers['/files/2.ktx2'] = (_, response) => void response.destroy();
    await offline;
    const changed = next(texture, 'change');
    server.answers['/files/2.ktx2'] = fixture('badge.ktx2');
    await changed;
    expect(texture.name).toBe('badge');
  });

  test('waits longer after each failure, never too long, and not in step with others', () => {
    expect(backOff(0)).toBe(0);
    for (let failures = 1; failures < 2000; failures++) {
      const wait = backOff(failures);
      expect(wait).toBeGreaterThanOrEqual(Math.min(15000, 250 * 2 ** (failures - 1)));
      expect(wait).toBeLessThanOrEqual(30000);
    }
    expect(new Set(Array.from({ length: 20 }, () => backOff(9))).size).toBeGreaterThan(1);
  });
});

describe('closing', () => {
  test('stops everything', async () => {
    const { texture, events } = await connect();
    texture.close();
    publish('2', fixture('badge.ktx2'));
    await new Promise((resolve) => setTimeout(resolve, 5 * INTERVAL));
    const requests = server.log.length;
    await server.close();
    await new Promise((resolve) => setTimeout(resolve, 5 * INTERVAL));
    expect(server.log).toHaveLength(requests);
    expect(events).toEqual([]);
    expect(texture).toMatchObject({ closed: true, name: 'duck' });
  });

  test('while a texture is on its way', async () => {
    const { texture, events } = await connect();
    publish('2', fixture('badge.ktx2'));
    const asked = new Promise((resolve) => {
      server.answers['/files/2.ktx2'] = (_, response) => {
        response.writeHead(200).write('a part');
        response.on('close', () => resolve('closed'));
        texture.dispose();
      };
    });
    expect(await asked).toBe('closed');
    await new Promise((resolve) => setTimeout(resolve, 2 * INTERVAL));
    expect(events).toEqual([]);
  });
});
