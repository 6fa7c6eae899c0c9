import { describe, expect, test } from 'vitest';
import { readGeojson } from '../src/convert/read-geojson.js';

const ring = [[4, 52], [6, 52], [6, 53], [4, 53], [4, 52]];
const polygon = { type: 'Polygon', coordinates: [ring] };
const feature = (properties, rest = {}) => ({ type: 'Feature', geometry: polygon, properties, ...rest });

describe('readGeojson', () => {
  test('obeys its signal and its time limit', async () => {
    const rings = Array.from({ length: 200_000 }, () => [ring]);
    const many = { type: 'MultiPolygon', coordinates: rings };
    await expect(readGeojson(many, { maxSeconds: 0.01 })).rejects.toThrow('reading takes longer than 0.01 s; give a larger `maxSeconds`');
    const stop = new AbortController();
    setTimeout(() => stop.abort(new RangeError('no more')), 5);
    await expect(readGeojson(many, { signal: stop.signal })).rejects.toThrow('no more');
  });

  test('fits the bounding box into the unit square, as Python does', async () => {
    const { paths, toSource: [a, b, c, d, e, f], crs, sides } = await readGeojson(JSON.stringify(polygon));
    const [contour] = paths[0].contours;
    expect([0, 8, 16, 24].map((k) => [contour[k], contour[k + 1]])).toEqual([[0, 0.25], [1, 0.25], [1, 0.75], [0, 0.75]]);
    expect([c * 0.25 + e, d * 0.25 + f, a, b]).toEqual([4, 52, 2, 0]);
    expect([crs, sides, paths[0].fillRule]).toEqual(['OGC:CRS84', [1, 0.5], 1]);
  });

  test('takes paints and names of features, and notes what has no area', async () => {
    const point = { type: 'Feature', geometry: { type: 'Point', coordinates: [1, 2] }, properties: null };
    const features = [feature({ fill: '#f80', 'fill-opacity': 0.5, name: 'a' }), feature({ NAME: 'b', fill: 'red' }, { id: 7 }), point];
    const { paths, notes } = await readGeojson({ type: 'FeatureCollection', features });
    expect(paths.map(({ paint, element }) => [paint.color, paint.opacity, element])).toEqual([
      [[1, 0x88 / 255, 0], 0.5, 'a'],
      [[0, 0, 0], 1, '7'],
    ]);
    expect(notes).toEqual([
      { kind: 'left out', message: 'fill "red" (colours are #rgb or #rrggbb)', count: 1 },
      { kind: 'left out', message: 'Point', count: 1 },
    ]);
    const named = await readGeojson({ type: 'FeatureCollection', features }, { names: 'NAME' });
    expect(named.paths.map(({ element }) => element)).toEqual(['', 'b']);
    await expect(readGeojson({ type: 'FeatureCollection', features }, { names: 'x' })).rejects.toThrow("no feature has the property 'x' of `names`; there are 'NAME'");
  });

  test('reads TopoJSON', async () => {
    const topology = {
      type: 'Topology', transform: { scale: [1, 1], translate: [4, 52] }, arcs: [[[0, 0], [2, 0], [0, 1], [-2, 0], [0, -1]]],
      objects: { lands: { type: 'GeometryCollection', geometries: [{ type: 'Polygon', arcs: [[0]], id: 'x' }] } },
    };
    const { paths } = await readGeojson(topology);
    expect(paths.map(({ contours, element }) => [contours.length, contours[0].length / 8, element])).toEqual([[1, 4, 'x']]);
    await expect(readGeojson({ ...topology, arcs: [] })).rejects.toThrow('its topology is damaged');
  });

  test.each([
    ['[]', 'its outermost value is [], not an object'],
    ['{', 'not JSON'],
    ['{"a": 1}', 'its outermost object has no "type"'],
    ['{"type": "Curve"}', 'type "Curve" is none that GeoJSON knows'],
    ['{"type": "Point", "coordinates": [1, 2]}', 'it holds no polygon to fill (left out: Point)'],
    ['{"type": "Polygon", "coordinates": [[[1, 2], [3, 4]]]}', 'left out: ring of fewer than three positions'],
    ['{"type": "Polygon", "coordinates": [[[1, 2], [3, "x"], [5, 6]]]}', 'ring 1, position 2 is [3,"x"]; it must be two finite numbers'],
    ['{"type": "Polygon", "coordinates": [[[1, 2], [3, 2], [5, 2]]]}', 'both must be above 0'],
    [`{"type":"Polygon","coordinates":${'['.repeat(1e5)}${']'.repeat(1e5)}}`, 'its lists are nested too deeply; GeoJSON needs no more than a few levels'],
    ['{"type":"GeometryCollection","geometries":['.repeat(1e5) + ']}'.repeat(1e5), 'is nested more than 32 deep; flatten it'],
    [`{"type":"Feature","properties":{"fill":${'['.repeat(1e5)}${']'.repeat(1e5)}},"geometry":null}`, 'it holds no polygon'],
    [' '.repeat(2 ** 25 + 1), 'the text has 33,554,433 letters; a page reads 33,554,432; simplify or split it, or convert it'],
  ])('refuses %.60s', async (text, message) => {
    await expect(readGeojson(text)).rejects.toThrow(message);
  });
});
