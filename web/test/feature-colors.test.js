import { beforeEach, describe, expect, test } from 'vitest';
import { textureSource } from '../src/globe/texture-source.js';
import { readPacked } from '../src/packed.js';
import { parts } from '../src/tiles/css-color.js';
import { FeatureColors } from '../src/tiles/feature-colors.js';
import { checkOptions, placeOf } from '../src/tiles/options.js';
import { fixture } from './files.js';

/** @type {any} */
let tile;
/** @type {any[]} */
let elements;
/** @type {string} */
let name;

beforeEach(async () => {
  const data = await readPacked(fixture('elements.ktx2'));
  tile = { data, colors: 0 };
  elements = data.roots[0].style.elements;
  name = elements[0].name;
});

/** The colour that the first feature of a tile has got. */
const seen = (/** @type {FeatureColors} */ colors) => {
  colors.apply(tile);
  const { color, opacity } = tile.data.roots[0].style.elements[0];
  return [...color, opacity].map((part) => Math.round(255 * part));
};

const RED = [255, 0, 0, 255];
const GREEN = [0, 255, 0, 255];
const BLUE = [0, 0, 255, 255];

/** @param {(colors: any) => void} act */
const said = (act) => {
  const colors = new FeatureColors();
  try {
    act(colors);
  } catch (error) {
    expect(error.name).toBe('VextureError');
    expect(error.message).not.toMatch(/\n/);
    expect(colors.version).toBe(0);
    return error.message;
  }
  return 'nothing';
};

test('colours are read, or refused in a line', () => {
  expect(parts('#f00')).toEqual([1, 0, 0, 1]);
  expect(parts('#00ff0033')).toEqual([0, 1, 0, 0.2]);
  expect(parts(0x0000ff)).toEqual([0, 0, 1, 1]);
  expect(parts('rgb(255, 0,51)')).toEqual([1, 0, 0.2, 1]);
  expect(parts(null)).toEqual([0, 0, 0, 0]);
  expect(() => parts('#ggg')).toThrow('a paint is "#ggg"; give a colour of CSS, four numbers in 0..1, or null');
});

describe('what cannot be is refused in a line, and changes nothing', () => {
  const itself = {};
  itself.self = itself;
  const times = (/** @type {any} */ table) => (/** @type {any} */ colors) => colors.setTimes(table);
  const A_COLOUR = 'give a colour of CSS, four numbers in 0..1, or null';
  const PAINTS = 'give an object or a Map of ids and colours, a function, or null';
  const TIMES = 'give { ids, colors }, a list and one for each step, or null';
  test.each([
    [(colors) => colors.setPaint('red'), `the paints are "red"; ${PAINTS}`],
    [(colors) => colors.setPaint(['#f00']), `the paints are ["#f00"]; ${PAINTS}`],
    [(colors) => colors.setPaint(5), `the paints are 5; ${PAINTS}`],
    [(colors) => colors.setPaint(undefined), `the paints are undefined; ${PAINTS}`],
    [(colors) => colors.setPaint(new Set(['a'])), `the paints are {}; ${PAINTS}`],
    [(colors) => colors.setPaint({ b: '#f00', a: '#ggg' }), `the paint of "a" is "#ggg"; ${A_COLOUR}`],
    [(colors) => colors.setPaint({ a: { isColor: true, r: 1 } }), 'the paint of "a" is a Color of three.js; give its getStyle()'],
    [(colors) => colors.setPaint({ a: itself }), `the paint of "a" is [object Object]; ${A_COLOUR}`],
    [(colors) => colors.setPaint(new Map([[null, '#f00']])), 'an id of the paints is null; give a text or a number'],
    [(colors) => colors.setFilter('abc'), 'the filter is "abc"; give a list of ids, a function, or null'],
    [(colors) => colors.setFilter(5), 'the filter is 5; give a list of ids, a function, or null'],
    [(colors) => colors.setFilter({ a: true }), 'the filter is {"a":true}; give a list of ids, a function, or null'],
    [(colors) => colors.setFilter(['a', undefined]), 'an id of the filter is undefined; give a text or a number'],
    [times({}), `the times are {}; ${TIMES}`],
    [times(undefined), `the times are undefined; ${TIMES}`],
    [times({ ids: ['a'] }), `the times are {"ids":["a"]}; ${TIMES}`],
    [times({ ids: ['a'], colors: ['#f00'] }), `the times are {"ids":["a"],"colors":["#f00"]}; ${TIMES}`],
    [times({ ids: ['a'], colors: [] }), 'step 0 has 0 colours; give 1, one for each id'],
    [times({ ids: ['a', 'b'], colors: [['#000', '#000'], ['#000']] }), 'step 1 has 1 colours; give 2, one for each id'],
    [times({ ids: ['a', 7, '7'], colors: [['#000', '#000', '#000']] }), 'the times have the id "7" twice; give it once'],
    [times({ ids: ['a', undefined], colors: [['#000', '#000']] }), 'an id of the times is undefined; give a text or a number'],
    [times({ ids: ['a', 'b'], colors: [['#000', '#000'], ['#000', '#ggg']] }), `the paint of "b" in step 1 is "#ggg"; ${A_COLOUR}`],
    [times({ ids: ['a', 'b'], colors: [[, '#000']] }), `the paint of "a" in step 0 is undefined; ${A_COLOUR}`],
    [(colors) => colors.setTime('x'), 'the time is "x"; give the number of a step'],
    [(colors) => colors.setTime(NaN), 'the time is NaN; give the number of a step'],
    [() => placeOf(undefined), 'the place is undefined; give [lng, lat] or { lng, lat } in degrees, latitudes of -90 to 90'],
    [() => placeOf([4, NaN]), /^the place is \[4,null\]; give/],
    [() => placeOf({ x: 4, y: 52 }), /^the place is \{"x":4,"y":52\}; give/],
    [() => placeOf([4, 91]), /^the place is \[4,91\]; give/],
    [() => placeOf(['4', '52']), /^the place is \["4","52"\]; give/],
    [() => checkOptions(undefined), /^the source is undefined; give the address of a .pmtiles or a TileJSON, or the bytes of a .pmtiles, or \{/],
    [() => checkOptions({ source: '' }), /^the source is ""; give/],
    [() => checkOptions({ source: { load: () => null, zooms: [1, 0], margin: 0 } }), /^the source is \{"zooms":\[1,0\],"margin":0\}; give/],
    [() => checkOptions({ source: 'a.pmtiles', budget: -1 }), 'budget is -1; give a number of 0 or more'],
    [() => checkOptions({ source: 'a.pmtiles', budget: 'much' }), 'budget is "much"; give a number of 0 or more'],
    [() => checkOptions({ source: 'a.pmtiles', most: 0 }), 'most is 0; give a number of 1 or more'],
    [() => checkOptions({ source: { load: () => null, zooms: [0], margin: '0' } }), /^the source is \{"zooms":\[0\],"margin":"0"\}; give/],
    [() => checkOptions({ source: 'a.pmtiles', onChange: 5 }), 'onChange is 5; give a function'],
    [() => checkOptions({ source: 'a.pmtiles', onError: null }), 'onError is null; give a function'],
    [() => textureSource(new ArrayBuffer(9), { margin: -3 }), 'the margin is -3; give 0 or more, below 1'],
    [() => checkOptions({ source: 'a.pmtiles', pause: NaN }), 'pause is NaN; give a number of 0 or more'],
  ])('%s', (act, message) => {
    expect(said(act)).toMatch(message);
  });

  test('and what can be is not', () => {
    expect(placeOf([4, -90])).toEqual([4, -90]);
    expect(placeOf({ lng: 4, lat: 52 })).toEqual([4, 52]);
    checkOptions({ source: 'a.pmtiles', budget: Infinity, most: 1, retries: undefined });
    checkOptions({ source: { load: async () => null, zooms: [0, 2], margin: 0 } });
    checkOptions({ source: new URL('https://example.org/a.pmtiles') });
    expect(textureSource(new ArrayBuffer(9), /** @type {any} */ (null)).margin).toBe(0);
  });
});

test('ids may be numbers', () => {
  for (const element of elements) element.name = '250';
  const colors = new FeatureColors();
  colors.setPaint(new Map([[250, '#f00']]));
  expect(seen(colors)).toEqual(RED);
  colors.setPaint(new Map([[250, undefined]]));
  colors.setTimes({ ids: [250], colors: [['#0f0']] });
  expect(seen(colors)).toEqual(GREEN);
  colors.setFilter(new Set([724]));
  expect(seen(colors)[3]).toBe(0);
  colors.setFilter([250]);
  expect(seen(colors)).toEqual(GREEN);
});

test('a table of paints comes before the time, and the time before a function', () => {
  const colors = new FeatureColors();
  colors.setPaint(() => '#f00');
  expect(seen(colors)).toEqual(RED);
  colors.setTimes({ ids: [name], colors: [[null], ['#0f0']] });
  colors.setTime(1);
  expect(seen(colors)).toEqual(GREEN);
  colors.setPaint({ [name]: '#00f' });
  expect(seen(colors)).toEqual(BLUE);
  colors.setTime(0);
  expect([seen(colors), colors.isSeen(name)]).toEqual([BLUE, true]);
  colors.setPaint({ [name]: undefined });
  expect([seen(colors)[3], colors.isSeen(name)]).toEqual([0, false]);
  colors.setTime(1);
  expect([seen(colors), colors.isSeen(name)]).toEqual([GREEN, true]);
  colors.setPaint({ [name]: null });
  expect([seen(colors)[3], colors.isSeen(name)]).toEqual([0, false]);
  colors.setPaint({ [name]: undefined });
  colors.setTimes(null);
  expect(seen(colors)).toEqual(RED);
});

test('a function that throws is told once, and the others go on', async () => {
  const own = seen(new FeatureColors());
  const colors = new FeatureColors();
  /** @type {any[]} */
  const told = [];
  colors.onError = (error) => {
    told.push(error);
    colors.setPaint({}); // who hears of it may do so
  };
  colors.setPaint((id) => {
    if (id === name) throw new Error('no colour');
    return '#f00';
  });
  expect(seen(colors)).toEqual(own);
  expect(colors.isSeen(name)).toBe(true);
  expect(seen(colors)).toEqual(own);
  const other = elements.find((one) => one.name && one.name !== name);
  expect(other.color).toEqual([1, 0, 0]);
  expect(told).toEqual([]); // not within the frame
  await Promise.resolve();
  expect(told.map(({ message }) => message)).toEqual([
    `the paint function throws for "${name}" (no colour); mend it; such features are drawn without it`]);
  expect(told[0].cause.message).toBe('no colour');
  colors.setPaint(() => '#ggg');
  expect(seen(colors)).toEqual(own);
  await Promise.resolve();
  expect(told[1].message).toBe(`the paint of "${name}" is "#ggg"; give a colour of CSS, four numbers in 0..1, or null`);
  colors.setPaint(null);
  colors.setFilter((/** @type {any} */ id) => id.nothing.at);
  expect(seen(colors)).toEqual(own);
  expect(colors.isSeen(name)).toBe(true);
  await Promise.resolve();
  expect(told).toHaveLength(3);
  expect(told[2].message).toMatch(`the filter throws for "${name}" (`);
});

test('a paint of null hides a feature, whatever a function says of it', () => {
  const colors = new FeatureColors();
  colors.setPaint(() => '#ff0000');
  expect(seen(colors)).toEqual(RED);
  colors.setPaint({ [name]: null });
  expect(seen(colors)[3]).toBe(0);
});

test('a paint of undefined takes back what a feature was given', () => {
  const colors = new FeatureColors();
  colors.setPaint(() => '#ff0000');
  colors.setPaint({ [name]: '#00f', b: '#fff' });
  expect(seen(colors)).toEqual(BLUE);
  colors.setPaint({ [name]: undefined });
  expect(seen(colors)).toEqual(RED);
});

test('a feature is hidden though the tile does not have what lies below it', () => {
  elements[0].hides = true;
  const colors = new FeatureColors();
  colors.setFilter((id) => id !== name);
  expect(colors.apply(tile)).not.toEqual([]);
  expect(tile.data.roots[0].style.elements[0].opacity).toBe(0);
});

test('what is not seen is not picked', () => {
  const colors = new FeatureColors();
  colors.setPaint({ a: null, d: '#ff000000', e: 'own' });
  const visible = () => ['a', 'b', 'c', 'd', 'e'].filter((id) => colors.isSeen(id));
  expect(visible()).toEqual(['b', 'c', 'e']);
  colors.setFilter((id) => id !== 'b');
  expect(visible()).toEqual(['c', 'e']);
  colors.setTimes({ ids: ['a', 'b', 'c', 'f'], colors: [['#fff', '#fff', null, '#000'], ['#fff', '#fff', '#000', null]] });
  expect(visible()).toEqual(['e']);
  colors.setTime(0.5);
  expect(visible()).toEqual(['c', 'e']);
  colors.setPaint({ a: undefined });
  expect(visible()).toEqual(['a', 'c', 'e']);
});
