import { expect, test } from 'vitest';
import { readSvg } from '../src/convert/index.js';

const gradient = (interpolation) =>
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><linearGradient id="g" color-interpolation="${interpolation}">` +
  '<stop/><stop offset="1" stop-color="#fff" stop-opacity="0"/></linearGradient><path fill="url(#g)" d="M0 0h9v9z"/></svg>';

/** The stops of the only path. */
const stopsOf = async (text) => (await readSvg(text)).paths[0].paint.gradient.stops;

test('a gradient in linear light has more stops, near its curve', async () => {
  expect(await stopsOf(gradient('sRGB'))).toHaveLength(2);
  const stops = await stopsOf(gradient('linearRGB'));
  expect(stops).toHaveLength(24); // as many as in Python
  for (let k = 1; k < stops.length; k += 1) {
    for (const part of [0, 0.3, 0.5, 0.7, 1]) {
      const [one, other] = [stops[k - 1], stops[k]];
      const at = one.offset + part * (other.offset - one.offset);
      const light = at <= 0.0031308 ? 12.92 * at : 1.055 * at ** (1 / 2.4) - 0.055;
      for (const channel of [0, 1, 2]) {
        const found = one.color[channel] + part * (other.color[channel] - one.color[channel]);
        expect(Math.abs(found - light)).toBeLessThan(0.5 / 255);
      }
      expect(one.opacity + part * (other.opacity - one.opacity)).toBeCloseTo(1 - at, 9);
    }
  }
});
