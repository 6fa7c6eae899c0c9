/** Light, dark, or what the system prefers, of the page around the picture; the stylesheet holds the colours. */

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
