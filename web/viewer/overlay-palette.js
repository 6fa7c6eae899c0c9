/**
 * Colours of the overlays. Colours that represent a number are monotone in lightness, so that colour-blind readers see
 * their order.
 *
 * @typedef {[number, number, number]} Rgb sRGB, 0..1
 */

/** Share of the overlay's colour in a pixel; the rest is the picture's. */
export const OPACITY = Object.freeze({ cells: 0.6, coverage: 0.85, depth: 0.75 });

/**
 * For each theme the colours of coverage 0 and 1: of cells by their stored coverage, and of quads at the cut-off, which
 * must differ from the drawing.
 *
 * @type {Record<'light' | 'dark', {coverage: [Rgb, Rgb], stored: [Rgb, Rgb]}>}
 */
export const RAMPS = {
  light: { coverage: [[0.95, 0.97, 1], [0.1, 0.24, 0.52]], stored: [[1, 0.94, 0.86], [0.72, 0.27, 0.02]] },
  dark: { coverage: [[0.08, 0.11, 0.18], [0.62, 0.78, 1]], stored: [[0.2, 0.12, 0.05], [1, 0.67, 0.35]] },
};

const DARKEST = 0.32;
const LIGHTEST = 0.93;
const FIRST_HUE = 4.6; // radians: blue
const LAST_HUE = 1.75; // yellow
const CHROMA = 0.125;

/** @param {number} linear */
function encoded(linear) {
  const held = Math.min(Math.max(linear, 0), 1);
  return held <= 0.0031308 ? 12.92 * held : 1.055 * held ** (1 / 2.4) - 0.055;
}

/**
 * A colour of Oklab (Ottosson 2020) as sRGB.
 *
 * @param {number} lightness @param {number} chroma @param {number} hue
 * @returns {Rgb}
 */
function fromOklch(lightness, chroma, hue) {
  const [a, b] = [chroma * Math.cos(hue), chroma * Math.sin(hue)];
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    encoded(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

/**
 * Colours of the depths 0 to `deepest`, the deepest the lightest, from blue to yellow.
 *
 * @param {number} deepest
 * @returns {Rgb[]}
 */
export function depthRamp(deepest) {
  return Array.from({ length: deepest + 1 }, (_, depth) => {
    const share = deepest > 1 ? Math.max(depth - 1, 0) / (deepest - 1) : 0;
    const chroma = CHROMA * (1 - 0.35 * Math.abs(2 * share - 1));
    return fromOklch(DARKEST + share * (LIGHTEST - DARKEST), chroma, FIRST_HUE + share * (LAST_HUE - FIRST_HUE));
  });
}

/** @param {Rgb} color for CSS */
export function css(color) {
  return `rgb(${color.map((part) => Math.round(255 * part)).join(' ')})`;
}

/**
 * A premultiplied colour and opacity, 0..1, as CSS writes the straight one.
 *
 * @param {number[]} color
 */
export function paintCss([red, green, blue, opacity]) {
  if (!opacity) return 'transparent';
  const straight = [red, green, blue].map((part) => part / opacity);
  const parts = opacity < 1 ? [...straight, opacity] : straight;
  return `#${parts.map((part) => Math.round(255 * part).toString(16).padStart(2, '0')).join('')}`;
}
