import { beforeEach, expect, test, vi } from 'vitest';
import { fixture } from './files.js';

/** The package in a thread that has loaded nothing yet. */
const fresh = () => import('../src/index.js');

beforeEach(() => vi.resetModules());

test('a file with a map brings what maps need', async () => {
  const { VectorTexture, readPacked } = await fresh();
  const { mapParts } = await import('../src/maps.js');
  new VectorTexture(await readPacked(fixture('duck.ktx2')));
  expect(mapParts).toThrow('the module for planar maps is not loaded; read the file with readPacked, or await loadMaps()');
  const texture = new VectorTexture(await readPacked(fixture('restyled.ktx2')));
  expect(mapParts().checkMap).toBeTypeOf('function');
  expect(texture.elementAt(0.5, 0.5)).not.toBeNull();
});

test('data from another thread need it asked for', async () => {
  const other = await fresh();
  const data = structuredClone(await other.readPacked(fixture('restyled.ktx2')));
  const outline = structuredClone(await other.readPacked(fixture('duck.ktx2')));
  vi.resetModules();
  const { VectorTexture, VextureError, loadMaps, paintAt } = await fresh();
  expect(() => new VectorTexture(data)).toThrow(VextureError);
  expect(() => paintAt(data, data.roots[0].quad, 0.5, 0.5)).toThrow('await loadMaps()');
  expect(new VectorTexture(outline).contains(0.5, 0.5)).toBe(true);
  await loadMaps();
  expect(new VectorTexture(data).colorAt(0.5, 0.5)).toEqual(new other.VectorTexture(data).colorAt(0.5, 0.5));
});

test('textures without a map need none to say that they have no elements', async () => {
  const { VectorTexture, readPacked } = await fresh();
  const texture = new VectorTexture(await readPacked(fixture('duck.ktx2')));
  expect(() => texture.setPaints({ body: 'red' })).toThrow('has no elements; convert the drawing with --restyle');
  expect(() => texture.elementAt(0.5, 0.5)).toThrow('has no elements; convert the drawing with --restyle');
});

test('a map is refused in one line where its module cannot be had', async () => {
  vi.doMock('../src/map-parts.js', () => { throw new TypeError('Failed to fetch'); });
  const { VextureError, readPacked } = await fresh();
  const refused = await readPacked(fixture('restyled.ktx2'), 'map').catch((error) => error);
  expect(refused).toBeInstanceOf(VextureError);
  expect(refused.message).toMatch(/^map: the module for planar maps cannot be loaded \(.*\); check the network and the site's files$/);
  expect(refused.field).toBe('url');
  vi.doUnmock('../src/map-parts.js');
});
