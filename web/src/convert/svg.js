// The drawing of an SVG, from any source.
import { Pace } from './pace.js';
import { readSvg } from './read-svg.js';
import { loadMarkup } from './source.js';

/** @import { StrokeOutline } from './strokes.js' */

/**
 * Read an SVG. Only its own address is fetched, nothing that it refers to.
 *
 * @param {string | Blob | ArrayBuffer | Uint8Array | URL | Response | Element} source markup or its place, or an `<svg>` of
 *   the page, which keeps the colours and variables that it has there
 * @param {import('./read-svg.js').SvgOptions & import('./pace.js').PaceOptions & { loadStrokes?: () => Promise<StrokeOutline> }} [options]
 *   `loadStrokes` is called for a document that may have strokes
 * @returns {Promise<import('./drawing.js').Drawing>}
 * @throws {VextureError} if it is no SVG, or exceeds a limit
 */
export async function svgDrawing(source, options = {}) {
  const isElement = typeof Element !== 'undefined' && source instanceof Element;
  const opened = isElement ? source : await loadMarkup(/** @type {Exclude<typeof source, Element>} */ (source), options);
  const { openSvg } = await import('#svg-engine'); // the browser's own engine, or ours where there is no page
  const hasStrokes = typeof opened !== 'string' || /stroke/i.test(opened);
  const strokeOutline = options.strokeOutline ?? (hasStrokes ? await options.loadStrokes?.() : undefined);
  const { pace = new Pace(options) } = options;
  const engine = await pace.run(openSvg(/** @type {string} */ (opened), pace));
  try {
    return await pace.run(readSvg(engine, { ...options, strokeOutline, pace }));
  } finally {
    engine.close();
  }
}
