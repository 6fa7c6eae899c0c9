// Images in an SVG, which notes list: nothing is fetched, and pictures are not traced.
import { isFlat } from './space.js';
import { shortenText } from './report.js';

/** Longest file name in a note. */
const SHOWN = 40;

/** @param {any} element @param {import('./space.js').Place} place @param {import('./report.js').Report} report */
export function noteImage(element, place, report) {
  const link = (report.engine.link(element) ?? '').trim();
  if (!link || place.style.get('visibility') !== 'visible' || isFlat(place.space)) return;
  const isEmbedded = link.slice(0, 5).toLowerCase() === 'data:';
  report.leftOut(isEmbedded ? 'an embedded image' : `image '${nameOf(link)}' (nothing is fetched from an address)`);
}

/** @param {string} link @returns {string} the name of its file */
function nameOf(link) {
  const path = link.split(/[?#]/, 1)[0];
  let name = path.replace(/[/\\]+$/, '').split(/[/\\:]/).pop() || path;
  try {
    name = decodeURIComponent(name);
  } catch { // a name with a bare percent sign
  }
  return shortenText(name, SHOWN);
}
