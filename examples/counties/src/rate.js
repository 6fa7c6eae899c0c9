// The invented statistic, and the colours that show it.
import { Color, SRGBColorSpace } from 'three';

/** From 0 to 1: dark blue, blue, green, yellow, as light as they are high. */
const STOPS = ['#25316b', '#2c6b9a', '#2fa39a', '#8fd070', '#f4dc5a'].map((stop) => new Color(stop));

const STEPS = 256;

/** Paints of `setPaints`: sRGB components and opacity. */
export const SHADES = Array.from({ length: STEPS }, (_, step) => {
  const place = (step / (STEPS - 1)) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  const { r, g, b } = new Color().lerpColors(STOPS[below], STOPS[below + 1], place - below).getRGB({}, SRGBColorSpace);
  return [r, g, b, 1];
});

export const shadeOf = (rate) => SHADES[Math.round(rate * (STEPS - 1))];

/** What a county has of its own, -1 to 1: by its id, so that it is always the same. */
export const ownOf = (id) => Math.sin(Number(id) * 12.9898) ** 3;

/**
 * The rate of a county, 0 to 1: waves that cross the country, and what it has of its own.
 *
 * @param {number} x
 * @param {number} y of its middle, 0..1 of the map's width
 * @param {number} own
 * @param {number} seconds
 */
export function rateAt(x, y, own, seconds) {
  const west = Math.sin(7 * x + 2 * Math.sin(5 * y + 0.3 * seconds) - 0.9 * seconds);
  const south = Math.sin(11 * y - 4 * x + 0.6 * seconds);
  return Math.min(Math.max(0.5 + 0.28 * west + 0.16 * south + 0.12 * own, 0), 1);
}
