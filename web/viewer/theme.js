/** Light, dark, or what the system prefers; the stylesheet holds the colours. */

/**
 * @typedef {[number, number, number]} Rgb sRGB, 0..1
 * @typedef {{paper: Rgb, ink: Rgb}} Colors of the picture
 */

const DARK = matchMedia('(prefers-color-scheme: dark)');

/**
 * Dress the page.
 *
 * @param {import('./state.js').Theme} theme
 */
export function applyTheme(theme) {
  document.documentElement.dataset.theme = theme === 'system' ? (DARK.matches ? 'dark' : 'light') : theme;
}

/** @param {() => void} changed called when the system's preference does */
export function watchSystemTheme(changed) {
  DARK.addEventListener('change', changed);
}

/** @returns {Colors} */
export function pictureColors() {
  const style = getComputedStyle(document.documentElement);
  /** @param {string} name @returns {Rgb} */
  const color = (name) => {
    const value = parseInt(style.getPropertyValue(name).trim().slice(1), 16);
    return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
  };
  return { paper: color('--paper'), ink: color('--ink') };
}
