import { describe, expect, test } from 'vitest';
import { convertData, readSvg } from '../src/convert/index.js';
import { Pace, atOnce } from '../src/convert/pace.js';

const many = (count, inner = '<path fill="#f00" d="M1 1h5v5z"/>') =>
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">${inner.repeat(count)}</svg>`;

/** Work of many short parts. */
function* parts(pace, count) {
  for (let k = 0; k < count; k++) {
    for (const end = performance.now() + 5; performance.now() < end;);
    if (pace.isDue()) yield;
  }
  return count;
}

describe('the pace of long work', () => {
  test('gives others their turns, and adds up its time', async () => {
    const pace = new Pace();
    let turns = 0;
    const timer = setInterval(() => turns++, 1);
    expect(await pace.run(parts(pace, 60))).toBe(60);
    clearInterval(timer);
    expect(turns).toBeGreaterThanOrEqual(3);
    expect(pace.seconds).toBeGreaterThan(0.29);
    expect(pace.seconds).toBeLessThan(3);
    expect(atOnce(parts(pace, 3))).toBe(3);
  });

  test('ends when it is stopped', async () => {
    const stop = new AbortController();
    const pace = new Pace({ signal: stop.signal });
    setTimeout(() => stop.abort(new RangeError('no more')), 20);
    await expect(pace.run(parts(pace, 1e6))).rejects.toThrow('no more');
  });

  test.each([NaN, 0, -1, '9', null])('refuses %s as its limit', (maxSeconds) => {
    expect(() => new Pace({ maxSeconds })).toThrow('is no number above 0; leave it out');
  });
});

describe('reading in Node.js', () => {
  test('obeys its limit', async () => {
    await expect(readSvg(many(30_000), { name: 'many', maxSeconds: 0.05 })).rejects.toThrow(
      'many: reading takes longer than 0.05 s; give a larger `maxSeconds`, or a simpler drawing',
    );
    await expect(convertData(many(30_000), { maxSeconds: 0.05 })).rejects.toThrow('reading takes longer than 0.05 s');
  });

  test('obeys its signal', async () => {
    await expect(readSvg(many(1), { signal: AbortSignal.abort(new RangeError('no more')) })).rejects.toThrow('no more');
    await expect(convertData(many(100_000), { signal: AbortSignal.timeout(30) })).rejects.toThrow(/timeout/);
  });
});
