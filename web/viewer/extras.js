import { create as createContents } from './contents.js';
import { create as createFacts } from './facts.js';
import { create as createInspector } from './inspector.js';
import { create as createOverlays } from './overlays.js';
import { create as createSizes } from './sizes.js';

/**
 * Parts of the page beside its engine, in their order on the page.
 *
 * @typedef {object} Extra
 * @property {(engine: import('./engine.js').Engine, state: import('./state.js').State) => Element} create
 * @property {'panel' | 'stage'} place a part of the side panel, or a layer over the picture
 */

/** @type {Extra[]} */
export const EXTRAS = [
  { create: createSizes, place: 'panel' },
  { create: createOverlays, place: 'panel' },
  { create: createInspector, place: 'panel' },
  { create: createContents, place: 'panel' },
  { create: createFacts, place: 'panel' },
];
