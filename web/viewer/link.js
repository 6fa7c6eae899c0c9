/** The address of the view. */
import { START, decodeView, encodeView } from './state.js';

const KEY = '#view=';
const PATIENCE = 250; // ms without a change before the address is written

/** @param {import('./state.js').State} state */
export function linkTo(state) {
  return location.href.replace(/#.*$/, '') + KEY + encodeView(state.value);
}

/**
 * The state in the address: null without one, undefined if it is damaged.
 *
 * @returns {import('./state.js').ViewState | null | undefined}
 */
export function linkedView() {
  if (!location.hash.startsWith(KEY)) return null;
  return decodeView(location.hash.slice(KEY.length)) ?? undefined;
}

/**
 * Synchronize the address and the state.
 *
 * @param {import('./state.js').State} state
 * @param {(message: string) => void} note
 */
export function followLink(state, note) {
  let timer = 0;
  state.addEventListener('change', () => {
    clearTimeout(timer);
    timer = window.setTimeout(() => history.replaceState(null, '', linkTo(state)), PATIENCE);
  });
  addEventListener('hashchange', () => {
    const wanted = linkedView();
    if (wanted === undefined) note('This link is damaged; the view stays as it is.');
    else state.update(wanted ?? START);
  });
}
