// Files and addresses that are none of ours, for every loader: servers answer a wrong address with a page, or with nothing.
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { FoldLoader } from '../src/fold-loader.js';
import { LiveVectorTexture } from '../src/live-vector-texture.js';
import { textureSource } from '../src/globe/texture-source.js';
import { ThesisLoader } from '../src/thesis/loader.js';
import { openTiles } from '../src/tiles/source.js';
import { VectorTextureLoader } from '../src/vector-texture-loader.js';
import { readPacked } from '../src/packed.js';
import { expectRefusal } from './refused.js';
import { serve } from './server.js';

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"/>';

/** @param {string} text */
const utf16 = (text) => Buffer.from(`\ufeff${text}`, 'utf16le');

/** @type {[string, string | Uint8Array, string][]} */
const FILES = [
  ['a doctype', '<!doctype html><title>App</title>', 'a web page'],
  ['an element html', '<html lang="nl">', 'a web page'],
  ['an element head', '<head><title>App</title>', 'a web page'],
  ['an element body', '<body>Not found</body>', 'a web page'],
  ['an element div', '<div>Not found</div>', 'a web page'],
  ['a page that holds an SVG', `<!doctype html><body>${SVG}</body>`, 'a web page'],
  ['a part of a page that holds an SVG', `<div>${SVG}</div>`, 'a web page'],
  ['a comment', '<!-- cached --><p>Not found</p>', 'a web page'],
  ['a comment without an end', '<!-- cached', 'a web page'],
  ['white space', '\r\n\t <body>', 'a web page'],
  ['a byte order mark', '\ufeff<body>', 'a web page'],
  ['all of these', '\ufeff\n<!-- a -->\n<!-- b -->\n<div>', 'a web page'],
  ['UTF-16', utf16('<!doctype html>'), 'a web page'],
  ['XHTML', '<?xml version="1.0"?>\n<!DOCTYPE html PUBLIC "-//W3C//DTD XHTML 1.0 Strict//EN">', 'a web page'],
  ['a refusal in XML', '<?xml version="1.0"?>\n<Error><Code>NoSuchKey</Code></Error>', 'XML'],
  ['an SVG after a byte order mark', `\ufeff<?xml version="1.0"?>\n<!-- by hand -->\n${SVG}`, 'an SVG'],
  ['an SVG of an old program', `<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN">${SVG}`, 'an SVG'],
  ['an SVG after a comment', `<!-- by hand -->${SVG}`, 'an SVG'],
  ['nothing', new Uint8Array(), 'nothing'],
];

const LOADERS = {
  texture: { load: (url) => new VectorTextureLoader().loadAsync(url), field: 'identifier', make: 'vexture convert FILE' },
  fold: { load: (url) => new FoldLoader().loadAsync(url), field: 'identifier', make: 'vexture fold FILE' },
  'thesis texture': { load: (url) => new ThesisLoader().loadAsync([url, url]), field: 'signature', make: 'vexture convert --encoding thesis' },
  'pyramid of tiles': { load: (url) => openTiles(`${url}?.pmtiles`), field: 'url', make: 'give the address of a .pmtiles' },
};

/** @type {import('./server.js').Server} */
let server;
beforeAll(async () => {
  server = await serve(Object.fromEntries(FILES.flatMap(([, content], place) => [`/${place}`, `/${place}?.pmtiles`].map((path) => [path, content]))));
});
afterAll(() => server.close());

/** @param {string} kind @param {string} what @param {string} make */
function said(kind, what, make) {
  if (kind === 'nothing') return `has no bytes, so is no ${what}; check the address, and the file on its server`;
  return `is ${kind}, not a ${what}; ${kind === 'an SVG' ? '' : 'check the address'}${kind === 'an SVG' ? `.*${make}` : '$'}`;
}

describe.each(Object.entries(LOADERS))('a %s', (what, { load, field, make }) => {
  test.each(FILES.map(([name, , kind], place) => /** @type {const} */ ([name, kind, place])))('that is %s', async (_, kind, place) => {
    await expectRefusal(load(`${server.url}/${place}`), field, new RegExp(said(kind, what, make)));
  });
});

test('a TileJSON that is a page or empty', async () => {
  const load = (/** @type {string} */ kind) => openTiles(`${server.url}/${FILES.findIndex((file) => file[2] === kind)}`);
  await expectRefusal(load('a web page'), 'tiles', /is a web page, not a pyramid of tiles; check the address$/);
  await expectRefusal(load('nothing'), 'tiles', /has no bytes, so is no pyramid of tiles/);
});

test('contents that are a page or empty', async () => {
  const page = new TextEncoder().encode('<body>');
  await expectRefusal(readPacked(page, 'logo'), 'identifier', 'logo: is a web page, not a texture; check the address');
  await expectRefusal(openTiles(page), 'url', /^the archive: is a web page, not a pyramid of tiles/);
  await expectRefusal(openTiles(new Blob()), 'url', /^the archive: has no bytes, so is no pyramid of tiles/);
  const { load } = textureSource(page, { name: 'world' });
  await expectRefusal(load({ z: 0, x: 0, y: 0 }, new AbortController().signal).then((file) => readPacked(file, 'world')), 'identifier', /^world: is a web page/);
});

test.each([undefined, null, '', ' '])('no address: %j', async (address) => {
  const url = /** @type {any} */ (address);
  for (const loader of [new VectorTextureLoader(), new FoldLoader(), new ThesisLoader()]) {
    await expectRefusal(loader.setPath(`${server.url}/`).loadAsync(url), 'url', /^the address is .*; give that of a file, a text such as 'logo.ktx2'$/);
  }
  await expectRefusal(LiveVectorTexture.connect(url), 'url', /^the address is /);
  await expectRefusal(openTiles(url), 'source', /^the source is .*; give the address of a \.pmtiles/);
  expect(server.log.some(({ path }) => path === '/')).toBe(false);
});
