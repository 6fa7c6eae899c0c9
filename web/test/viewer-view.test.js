import { describe, expect, it } from 'vitest';
import { FIT, MOST_ZOOM, panned, pixelSide, shaderView, toScreen, toUnit, zoomed } from '../viewer/view.js';

const SIZE = { width: 1280, height: 800 };

describe('the flat view', () => {
  it('shows the whole unit square in the middle at zoom 1', () => {
    const view = { center: [0.5, 0.5], zoom: 1 };
    const side = FIT * SIZE.height;
    const corners = [[0, 0], [1, 1]].map(([u, v]) => toScreen(view, SIZE, u, v));
    expect(corners.flat()).toEqual([640 - side / 2, 400 + side / 2, 640 + side / 2, 400 - side / 2].map((x) => expect.closeTo(x, 9)));
  });

  it('goes to the screen and back within a millionth of a pixel at its largest zoom', () => {
    const view = { center: [0.123456789, 0.7654321], zoom: MOST_ZOOM };
    const [u, v] = toUnit(view, SIZE, 17.25, 611.5);
    const [x, y] = toScreen(view, SIZE, u, v);
    expect(Math.hypot(x - 17.25, y - 611.5)).toBeLessThan(1e-6);
  });

  it('moves with the pointer', () => {
    const view = { center: [0.4, 0.6], zoom: 1000 };
    const before = toUnit(view, SIZE, 300, 200);
    const after = toUnit(panned(view, SIZE, 13, -7), SIZE, 313, 193);
    expect(Math.hypot(after[0] - before[0], after[1] - before[1])).toBeLessThan(1e-6 * pixelSide(1000, SIZE));
  });

  it('keeps the point below the pointer when it is magnified, in any number of steps', () => {
    let view = { center: [0.5, 0.5], zoom: 1 };
    const point = toUnit(view, SIZE, 700, 300);
    for (let i = 0; i < 40; i++) view = zoomed(view, SIZE, 700, 300, 1.25);
    expect(view.zoom).toBeGreaterThan(7000);
    const [x, y] = toScreen(view, SIZE, ...point);
    expect(Math.hypot(x - 700, y - 300)).toBeLessThan(1e-4);
  });

  it.each([1, 100, 10000, MOST_ZOOM])('gives the shader positions that float32 resolves, at zoom %d', (zoom) => {
    const view = { center: [0.2718281828, 0.5772156649], zoom };
    const ratio = 2;
    const { base, start, step } = shaderView(view, SIZE, ratio);
    const x = 2 * 1000.25;
    const y = 2 * 123.75;
    const offset = [0, 1].map((i) => Math.fround(Math.fround(start[i]) + Math.fround([x, y][i] * Math.fround(step))));
    const [u, v] = toUnit(view, SIZE, 1000.25, SIZE.height - 123.75);
    const pixels = [u, v].map((at, i) => Math.abs(base[i] / 2 ** 32 + offset[i] - at) / step);
    expect(Math.max(...pixels)).toBeLessThan(1e-3);
  });

  it('has its base in the unit square, whatever is in the middle', () => {
    for (const center of [[0, 0], [1, 1]]) {
      for (const word of shaderView({ center, zoom: 1 }, SIZE, 1).base) {
        expect(Number.isInteger(word) && word >= 0 && word < 2 ** 32).toBe(true);
      }
    }
  });
});
