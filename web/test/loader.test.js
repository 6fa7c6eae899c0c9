import { LoadingManager } from 'three';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { VectorTextureLoader } from '../src/vector-texture-loader.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture, patched } from './files.js';
import { expectRefusal } from './refused.js';
import { serve } from './server.js';

const duck = fixture('duck.ktx2');
const quads = fixture('sixteen/duck.quads.png');

/** @type {import('./server.js').Server} */
let server;

beforeAll(async () => {
  server = await serve({
    '/duck.ktx2': duck,
    '/duck.ktx2?v=2': duck,
    '/nameless': duck,
    '/pair.quads.png': quads,
    '/broken.ktx2': patched(duck, 12, 37),
    '/page': '<!doctype html>',
    '/page.ktx2': '\n<!DOCTYPE HTML><title>Nothing here</title>',
    '/junk.ktx2': 'junk',
    '/logo.svg': '\ufeff<?xml version="1.0"?>\n<!-- by hand -->\n<svg xmlns="http://www.w3.org/2000/svg"/>',
    '/slow.ktx2': (_, response) => void response.writeHead(200, { 'Content-Length': duck.length }).write(duck.subarray(0, 500)),
    '/cut.ktx2': (_, response) => {
      response.writeHead(200, { 'Content-Length': duck.length });
      response.write(duck.subarray(0, 500), () => response.destroy());
    },
    '/endless.ktx2': (_, response) => void response.writeHead(200, { 'Content-Length': 2 ** 30 }).write('much'),
    '/teapot.ktx2': (_, response) => void response.writeHead(418, 'Short and stout').end(),
  });
});
afterAll(() => server.close());

describe('what is loaded', () => {
  test('a packed texture, with progress', async () => {
    /** @type {number[][]} */
    const seen = [];
    const texture = await new VectorTextureLoader().loadAsync(`${server.url}/duck.ktx2`, (event) => {
      expect(event.type).toBe('progress');
      expect(event.lengthComputable).toBe(true);
      seen.push([event.loaded, event.total]);
    });
    expect(texture).toBeInstanceOf(VectorTexture);
    expect(texture).toMatchObject({ name: 'duck', encoding: 'packed' });
    expect(seen.at(-1)).toEqual([duck.length, duck.length]);
  });

  test('by load, in the order of three.js: onLoad, then the manager', async () => {
    /** @type {string[]} */
    const events = [];
    const manager = new LoadingManager(undefined, (url, loaded, total) => events.push(`${url} ${loaded}/${total}`));
    const texture = await new Promise((resolve, reject) =>
      new VectorTextureLoader(manager).setPath(`${server.url}/`).load('duck.ktx2', resolve, undefined, reject),
    );
    expect(texture.name).toBe('duck');
    expect(events).toEqual([`${server.url}/duck.ktx2 1/1`]);
  });

  test('a packed texture whose address does not say so', async () => {
    for (const path of ['/nameless', '/duck.ktx2?v=2']) {
      expect(await new VectorTextureLoader().loadAsync(server.url + path)).toMatchObject({ encoding: 'packed' });
    }
  });

  test('addresses that hold their content', async () => {
    const data = `data:image/ktx2;base64,${Buffer.from(duck).toString('base64')}`;
    const blob = URL.createObjectURL(new Blob([duck]));
    const loader = new VectorTextureLoader().setPath('/not/in/front/of/these/');
    for (const url of [data, blob]) expect(await loader.loadAsync(url)).toMatchObject({ name: 'duck' });
  });

  test('contents by parse', async () => {
    const loader = new VectorTextureLoader();
    expect(await loader.parse(duck.buffer)).toMatchObject({ name: 'duck', encoding: 'packed' });
    await expectRefusal(loader.parse(quads, 'picture'), 'identifier', /^picture: is a picture/);
  });

  test('with headers, and with the rules of the manager', async () => {
    const manager = new LoadingManager();
    manager.setURLModifier((url) => url.replace('elsewhere.ktx2', 'duck.ktx2'));
    const loader = new VectorTextureLoader(manager).setRequestHeader({ Authorization: 'Bearer 1' });
    await loader.loadAsync(`${server.url}/elsewhere.ktx2`);
    expect(server.log.at(-1)).toMatchObject({ path: '/duck.ktx2', headers: { authorization: 'Bearer 1' } });
  });
});

describe('what is refused', () => {
  test('answers that are no texture', async () => {
    const loader = new VectorTextureLoader();
    const load = (/** @type {string} */ path) => loader.loadAsync(server.url + path);
    await expectRefusal(load('/none.ktx2'), 'status 404', `${server.url}/none.ktx2: HTTP 404 Not Found`);
    await expectRefusal(load('/none'), 'status 404', `${server.url}/none: HTTP 404`);
    await expectRefusal(load('/teapot.ktx2'), 'status 418', 'HTTP 418 Short and stout');
    await expectRefusal(load('/broken.ktx2'), 'vkFormat', `${server.url}/broken.ktx2: vkFormat is 37`);
    await expectRefusal(load('/page'), 'identifier', `${server.url}/page: is a web page, not a texture; check the address`);
    await expectRefusal(load('/page.ktx2'), 'identifier', 'check the address');
    await expectRefusal(load('/logo.svg'), 'identifier', `${server.url}/logo.svg: is an SVG, not a texture; convert it first: vexture convert`);
    await expectRefusal(load('/junk.ktx2'), 'identifier', `${server.url}/junk.ktx2: begins with "junk`);
    await expectRefusal(load('/pair.quads.png'), 'identifier', /pair.quads.png: is a picture, not a texture; convert it first: vexture convert/);
    await expectRefusal(load('/cut.ktx2'), 'url', `${server.url}/cut.ktx2: cannot be fetched`);
    await expectRefusal(load('/endless.ktx2'), 'byteLength', 'longer than 570425344 bytes');
  });

  test('what is no address and no contents', async () => {
    const loader = new VectorTextureLoader();
    for (const nothing of [undefined, null, 7, [undefined, 'b']]) {
      await expectRefusal(loader.loadAsync(/** @type {any} */ (nothing)), 'url', /the address is/);
    }
    await expectRefusal(loader.parse(/** @type {any} */ (null)), 'contents', /contents are null/);
  });

  test('no server, and no address', async () => {
    const gone = await serve({});
    await gone.close();
    const loader = new VectorTextureLoader();
    await expectRefusal(loader.loadAsync(`${gone.url}/duck.ktx2`), 'url', /duck.ktx2: cannot be fetched \(.*ECONNREFUSED/);
    await expectRefusal(loader.loadAsync('http://[/duck.ktx2'), 'url', /cannot be fetched .*Access-Control-Allow-Origin \(CORS\)$/);
    await expectRefusal(loader.loadAsync('data:image/ktx2;base64,AAAA'), 'identifier', /^data:image/);
  });

  test('errors reach onError and the manager, once', async () => {
    /** @type {string[]} */
    const failed = [];
    const manager = new LoadingManager(undefined, undefined, (url) => failed.push(url));
    const url = `${server.url}/none.ktx2`;
    const error = await new Promise((resolve, reject) => new VectorTextureLoader(manager).load(url, reject, undefined, resolve));
    expect(error).toMatchObject({ field: 'status 404' });
    expect(failed).toEqual([url]);
  });
});

describe('abort', () => {
  function withResolvers() {
    /** @type {(value?: unknown) => void} */
    let resolve = () => {};
    const promise = new Promise((done) => (resolve = done));
    return { promise, resolve };
  }

  test('of the loader, which loads again afterwards', async () => {
    const loader = new VectorTextureLoader();
    const { promise, resolve } = withResolvers();
    const outcome = loader.loadAsync(`${server.url}/slow.ktx2`, resolve).catch((error) => error.name);
    await promise;
    expect(loader.abort()).toBe(loader);
    expect(await outcome).toBe('AbortError');
    expect((await loader.loadAsync(`${server.url}/duck.ktx2`)).name).toBe('duck');
  });

  test('of one', async () => {
    const controller = new AbortController();
    const loader = new VectorTextureLoader();
    const { promise, resolve } = withResolvers();
    const outcome = loader.loadData(`${server.url}/slow.ktx2`, resolve, controller.signal).catch((error) => error.name);
    await promise;
    controller.abort();
    expect(await outcome).toBe('AbortError');
  });

  test('of the manager, where three.js has it', async ({ skip }) => {
    const manager = new LoadingManager();
    if (!manager.abort) skip('this three.js has no LoadingManager.abort');
    const { promise, resolve } = withResolvers();
    const outcome = new VectorTextureLoader(manager).loadAsync(`${server.url}/slow.ktx2`, resolve).catch((error) => error.name);
    await promise;
    manager.abort();
    expect(await outcome).toBe('AbortError');
  });
});
