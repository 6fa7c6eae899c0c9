import { describe, expect, it } from 'vitest';
import { lengthText, roundLength } from '../flood/bearings.js';
import { areaText, lineOf, placesOf } from '../flood/chart.js';
import { entries } from '../flood/legend.js';
import { hashOf, lookOf } from '../flood/link.js';
import { Places } from '../flood/place.js';
import { arrivals, greatestDepths, greatestHazards, roundHours, shadeOf } from '../flood/shades.js';

describe('shades', () => {
  it('are none for water, classes of depths, and times of arrival', () => {
    const flood = {
      depths: [0, 0.5, 2].map((from, at) => ({ from, color: `#${at}0${at}0${at}0` })), arrivals: ['#000000', '#ffffff'],
      hazards: [{ from: 0, color: '#ffff00', text: 'low' }, { from: 0.75, color: '#ff0000', text: 'high' }],
    };
    expect(shadeOf('water', flood, 0)).toBeNull();
    const depth = /** @type {NonNullable<ReturnType<typeof shadeOf>>} */ (shadeOf('depth', flood, 0));
    expect(entries(depth)).toEqual([
      { color: '#000000', text: '0 to 0.5 m' }, { color: '#101010', text: '0.5 to 2 m' }, { color: '#202020', text: 'over 2 m' },
    ]);
    expect(depth.mapped).toBe(true);
    const ended = { ...flood, depths: flood.depths.map((one, at) => (at === 2 ? { ...one, to: 4 } : one)) };
    expect(entries(/** @type {NonNullable<ReturnType<typeof shadeOf>>} */ (shadeOf('depth', ended, 0)))[2].text).toBe('2 to 4 m');
    const smooth = /** @type {NonNullable<ReturnType<typeof shadeOf>>} */ (shadeOf('smooth', flood, 0));
    expect(entries(smooth).map(({ text }) => text)).toEqual(['0 m', '0.5 m', '2 m']);
    expect(smooth.mapped).toBe(false);
    const late = /** @type {NonNullable<ReturnType<typeof shadeOf>>} */ (shadeOf('arrival', flood, 12));
    expect(entries(late)).toEqual([{ color: '#000000', text: '0 to 6 h' }, { color: '#ffffff', text: 'over 6 h' }]);
    const odd = /** @type {NonNullable<ReturnType<typeof shadeOf>>} */ (shadeOf('arrival', flood, 7));
    expect(entries(odd).map(({ text }) => text)).toEqual(['0 to 4 h', 'over 4 h']);
    expect([0.01, 0.4, 3.83, 12, 30].map(roundHours)).toEqual([1 / 60, 0.5, 4, 12, 48]);
    const danger = /** @type {NonNullable<ReturnType<typeof shadeOf>>} */ (shadeOf('hazard', flood, 12));
    expect(entries(danger)).toEqual([{ color: '#ffff00', text: 'low' }, { color: '#ff0000', text: 'high' }]);
  });

  it('of the greatest hazard are of all steps, and go on a little beside the water', () => {
    const ratings = [[1, 2, NaN, NaN, NaN, NaN, NaN], [1.5, NaN, NaN, NaN, NaN, NaN, NaN]].map((one) => Float32Array.from(one));
    expect([...greatestHazards(ratings, 7)]).toEqual([1.5, 2, 2, 2, 2, NaN, NaN]);
  });

  it('of the greatest depth are of all steps', () => {
    const levels = [[1, 2, NaN], [1.5, NaN, NaN]].map((one) => Float32Array.from(one));
    expect([...greatestDepths(levels, [1, 0, 0])]).toEqual([0.5, 2, NaN]);
  });

  it('of arrival are of the first step that is wet, and go on a little beside the water', () => {
    const steps = [{ hours: 0, wet: [1, 0, 0, 0, 0, 0, 0] }, { hours: 3, wet: [1, 1, 0, 0, 0, 0, 0] }]
      .map(({ hours, wet }) => ({ hours, wet: Uint8Array.from(wet) }));
    expect([...arrivals(steps, { columns: 7, rows: 1 })]).toEqual([0, 3, 3, 3, 3, NaN, NaN]);
  });
});

describe('scale', () => {
  it.each([[99, 50, '50 m'], [100, 100, '100 m'], [4999, 2000, '2 km'], [0.3, 0.2, '0.2 m']])('%f m: %f', (most, length, text) => {
    expect(roundLength(most)).toBeCloseTo(length);
    expect(lengthText(roundLength(most))).toBe(text);
  });
});

describe('chart', () => {
  it('is a line from the least to the greatest, with gaps where there is no water', () => {
    expect(lineOf([1, 3, NaN, 2])).toEqual({ path: 'M0.0 41.0L200.0 3.0M600.0 22.0', low: 1, high: 3 });
    expect(lineOf([5, 5]).path).toBe('M0.0 41.0L600.0 41.0');
    expect([areaText(2_345_000), areaText(12_000)]).toEqual(['2.35 km²', '1.2 ha']);
  });
});

describe('link', () => {
  it('keeps step, view or camera, and colours', () => {
    const looks = [
      { step: 5, view: 'Flooded land', colours: 'depth' }, { camera: [1, 2.5, -3, 0, 0, 0] }, {}, { step: 1 },
    ];
    for (const look of looks) expect(lookOf(hashOf(look))).toEqual(look);
    expect(hashOf({ step: 0, colours: 'water' })).toBe('');
  });

  it('takes nothing that makes no sense', () => {
    for (const hash of ['#step=-3', '#step=a', '#camera=1,2,3', '#camera=1,2,3,4,5,x', '#camera=,,,,,', '#camera=1e9,0,0,0,0,0', '#=&&']) {
      expect(lookOf(hash), hash).toEqual({});
    }
  });
});

describe('coordinates', () => {
  it('are longitude and latitude too, interpolated', () => {
    const geodetic = { columns: 2, rows: 2, places: [4, 52, 6, 52.2, 4, 51, 6, 51.2] };
    const frame = /** @type {any} */ ({ box: [0, 0, 1, 1], metres: [1000, 1000], to_source: [1, 0, 0, 0, 1, 0], geodetic });
    expect(new Places(frame).geodetic(0.5, 0.5)).toBe('51.60000° N, 5.00000° E');
    expect(new Places(frame).geodetic(0, 1)).toBe('52.00000° N, 4.00000° E');
    expect(new Places({ ...frame, geodetic: null }).geodetic(0, 0)).toBeNull();
  });
});

describe('places of steps along the chart', () => {
  it('are by their times, or even without them or out of order', () => {
    const day = (/** @type {number} */ hour) => `2026-01-05T${String(hour).padStart(2, '0')}:00:00Z`;
    expect(placesOf([day(0), day(1), day(10)])).toEqual([0, 0.1, 1]);
    expect(placesOf([day(0), null, day(10)])).toEqual([0, 0.5, 1]);
    expect(placesOf([day(10), day(1), day(20)])).toEqual([0, 0.5, 1]);
    expect(placesOf([day(3)])).toEqual([0]);
  });
});

describe('a link to a plan', () => {
  it('has its middle and how much larger it is', () => {
    const hash = hashOf({ step: 0, plan: [10.5, -3, 4.25] });
    expect(lookOf(hash)).toEqual({ plan: [10.5, -3, 4.25] });
    expect(lookOf('#plan=1,2,0')).toEqual({});
    expect(lookOf('#plan=1,2')).toEqual({});
  });
});
