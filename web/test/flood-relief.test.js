import { describe, expect, it } from 'vitest';
import { Places } from '../flood/place.js';
import { Relief, Surface } from '../flood/relief.js';

const FACTS = { columns: 3, rows: 2, unit: 0.5, heights: '', invented: false };
const BYTES = new Int16Array([200, 0, -20, 400, 0, -40]).buffer;
const FRAME = /** @type {any} */ ({ box: [0, 0, 1, 1], metres: [1000, 1000], to_source: [1, 0, 0, 0, 1, 0] });
const PLACES = new Places(FRAME);

describe('Relief', () => {
  const relief = Relief.read(FACTS, BYTES);

  it('reads heights, the northernmost row first', () => {
    expect([relief.at(0, 1), relief.at(0, 0), relief.at(1, 1), relief.at(1, 0)]).toEqual([100, 200, -10, -20]);
    expect([relief.lowest, relief.highest]).toEqual([-20, 200]);
  });

  it('goes evenly between them, and no further than the border', () => {
    expect(relief.at(0.25, 0.5)).toBe(75);
    expect(relief.at(-3, 7)).toBe(100);
  });

  it('refuses what has another size', () => {
    expect(() => Relief.read({ ...FACTS, rows: 3 }, BYTES)).toThrow('12 bytes; 3 x 3 heights have 18');
  });

  it('is exaggerated so that it can be seen, and never made lower, if it is invented', () => {
    const invented = Relief.read({ ...FACTS, invented: true }, BYTES);
    expect(invented.exaggeration(0.01) * 220 * 0.01).toBeCloseTo(10);
    expect(invented.exaggeration(10)).toBe(1);
    expect(new Relief(FACTS, new Float32Array(6), { invented: true }).exaggeration(1)).toBe(1);
  });

  it('is shown as it is, if it is real', () => {
    expect(relief.exaggeration(0.01)).toBe(1);
  });
});

describe('Surface', () => {
  const surface = new Surface(Relief.read(FACTS, BYTES), PLACES);
  surface.exaggeration = 1;

  it('is the water where the ground is below it', () => {
    expect(surface.height(50, 0)).toBe(0);
    expect(surface.height(-50, -50)).toBe(10);
  });

  it('is the water at its own level, and never below the ground', () => {
    const levelled = new Surface(Relief.read(FACTS, BYTES), PLACES);
    levelled.levels = Float32Array.from([NaN, 3, 3, NaN, NaN, -30]);
    expect([...levelled.tops]).toEqual([100, 3, 3, 200, 0, -20]);
    expect([levelled.levelNear(0, 1), levelled.levelNear(1, 0), levelled.levelNear(0.5, 1)]).toEqual([3, -30, 3]);
    expect(levelled.range).toEqual({ low: -20, high: 200 });
    expect(levelled.meets({ x: 50, y: 80, z: 50 }, { x: 0, y: -1, z: 0 })).not.toBeNull(); // below the still water
  });

  it('is met by a look from above', () => {
    const met = surface.meets({ x: 30, y: 80, z: 10 }, { x: 0, y: -1, z: 0 });
    expect(met?.[0]).toBeCloseTo(0.8);
    expect(met?.[1]).toBeCloseTo(0.4);
  });

  it('is met on the hill that stands before the water', () => {
    const met = /** @type {[number, number]} */ (surface.meets({ x: -60, y: 25, z: 0 }, { x: 1, y: -0.9, z: 0 }));
    const [x] = PLACES.toWorld(...met);
    expect(25 - 0.9 * (x + 60)).toBeCloseTo(surface.height(x, 0), 3);
    expect(x).toBeLessThan(0);
  });

  it('is not met by a look beside it, up, or through a side', () => {
    expect(surface.meets({ x: 0, y: 10, z: 80 }, { x: 1, y: -1, z: 0 })).toBeNull();
    expect(surface.meets({ x: 0, y: 30, z: 0 }, { x: 0.1, y: 1, z: 0 })).toBeNull();
    expect(surface.meets({ x: -80, y: 2, z: 0 }, { x: 1, y: 0, z: 0 })).toBeNull();
  });
});
