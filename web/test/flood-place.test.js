import { describe, expect, it } from 'vitest';
import { Places } from '../flood/place.js';

const METRES = /** @type {any} */ ({
  box: [0.03125, 0.265625, 0.96875, 0.734375], metres: [2000, 1000], crs: 'EPSG:28992', geographic: false,
  to_source: [2133.3333333333335, 0, 79933.33333333333, 0, 2133.3333333333335, 449433.3333333333],
});
const DEGREES = /** @type {any} */ ({
  ...METRES, crs: 'OGC:CRS84', geographic: true, to_source: [1, 0, -123, 0, 1, 36],
});

describe('Places', () => {
  const places = new Places(METRES);

  it('makes the longer side 100 units, x east and z south', () => {
    expect([places.width, places.depth, places.scale]).toEqual([100, 50, 0.05]);
    expect(places.toWorld(0.5, 0.5)).toEqual([0, 0]);
    expect(places.toWorld(1, 1)).toEqual([50, -25]);
    expect(places.toBox(-50, 25)).toEqual([0, 0]);
  });

  it('goes from the box to the unit square and back', () => {
    expect(places.toUnit(0, 1)).toEqual([0.03125, 0.734375]);
    expect(places.fromUnit(0.5, 0.5)).toEqual([0.5, 0.5]);
  });

  it('says coordinates as the reference system has them', () => {
    expect(places.text(0.03125, 0.265625)).toBe('80,000 E, 450,000 N');
    const degrees = new Places(DEGREES);
    expect(degrees.text(0.25, 0.5)).toBe('36.50000° N, 122.75000° W');
    expect(new Places({ ...DEGREES, to_source: [1, 0, 4, 0, 1, -52] }).text(0, 0)).toBe('52.00000° S, 4.00000° E');
    expect(new Places({ ...DEGREES, to_source: [1, 0, 180.25, 0, 1, 0] }).text(0.5, 0)).toBe('0.00000° N, 179.25000° W');
  });

  it('has a short name for a reference system', () => {
    expect(places.crs).toBe('EPSG:28992');
    expect(new Places({ ...METRES, crs: 'PROJCRS["Amersfoort / RD New",BASEGEOGCRS["Amersfoort"]]' }).crs)
      .toBe('Amersfoort / RD New');
  });
});
