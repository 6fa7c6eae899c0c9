/**
 * What is added to the page beside its engine, in the order in which it stands there.
 *
 * @typedef {object} Extra
 * @property {(engine: import('./engine.js').Engine, state: import('./state.js').State) => Element} create
 * @property {'panel' | 'stage'} place a part of the side panel, or a layer over the picture
 */

/** @type {Extra[]} */
export const EXTRAS = [];
