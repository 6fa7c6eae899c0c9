/** What lies below the picture: one colour, or a checkerboard. */
import { Vector4 } from 'three';
import { Pass } from './pass.js';

/**
 * @typedef {import('./state.js').Background} Background
 * @typedef {[number, number, number]} Rgb sRGB, 0..1
 * @typedef {{paper: Rgb, checks: Rgb}} Colors of the squares of the board; alike where it is one colour
 */

/** Side of a square of the checkerboard, in CSS pixels. */
const SQUARE = 8;
const WHITE = '#ffffff';
const GREY = '#d9d9d9';
const BLACK = '#000000';
/** Where the mean of paper and checks is darker, what is drawn over it is light. */
const DARK = 0.4;

/** Declares `backdrop()`, the colour below a pixel. */
export const BACKDROP = `
uniform vec4 paper;
uniform vec4 checks;
uniform float square;
vec4 backdrop() {
  ivec2 place = ivec2(gl_FragCoord.xy / square);
  return ((place.x ^ place.y) & 1) == 0 ? paper : checks;
}
`;

/** @param {string} hex @returns {Rgb} */
function rgb(hex) {
  const value = parseInt(hex.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

/** @param {Background} background @returns {Colors} */
function colorsOf(background) {
  const theme = () => getComputedStyle(document.documentElement).getPropertyValue('--paper').trim();
  const named = { white: WHITE, black: BLACK, checks: WHITE };
  const paper = rgb(background === 'theme' ? theme() : background in named ? named[/** @type {'white'} */ (background)] : background);
  return { paper, checks: background === 'checks' ? rgb(GREY) : paper };
}

/** The uniforms of `BACKDROP`, which all passes over it share, and a pass of nothing else. */
export class Backdrop {
  uniforms = { paper: { value: new Vector4() }, checks: { value: new Vector4() }, square: { value: SQUARE } };
  /** Whether light marks are seen on it better than dark ones. */
  isDark = false;
  pass = new Pass(`${BACKDROP}out vec4 pixel;\nvoid main() { pixel = backdrop(); }\n`, this.uniforms);

  /** @param {Background} background */
  set(background) {
    const { paper, checks } = colorsOf(background);
    this.uniforms.paper.value.set(...paper, 1);
    this.uniforms.checks.value.set(...checks, 1);
    const light = (/** @type {Rgb} */ [red, green, blue]) => 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    this.isDark = (light(paper) + light(checks)) / 2 < DARK;
  }

  /** @param {number} ratio device pixels of a CSS pixel */
  scale(ratio) {
    this.uniforms.square.value = SQUARE * ratio;
  }

  /**
   * Do something with nothing below the picture.
   *
   * @param {() => void} act
   */
  without(act) {
    const { paper, checks } = this.uniforms;
    const before = [paper.value, checks.value];
    paper.value = checks.value = new Vector4(0, 0, 0, 0);
    act();
    [paper.value, checks.value] = before;
  }
}
