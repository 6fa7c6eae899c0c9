/** The size of what `vexture convert` writes, beside that of the texture of the page, which is made for deep zoom. */
import { convertedOf } from './converted.js';
import { element, section } from './dom.js';
import { bytesText } from './numbers.js';

/** @typedef {import('./engine.js').Engine} Engine */

/**
 * @param {{bytes: number, texture: {nbytes: number}} | null} converted
 * @param {number | null | undefined} bytes of the page's file
 * @param {number} nbytes of its texture
 */
function tableOf(converted, bytes, nbytes) {
  const row = (/** @type {string} */ what, /** @type {string} */ file, /** @type {string} */ gpu) =>
    element('tr', {}, element('th', { scope: 'row' }, what), element('td', {}, file), element('td', {}, gpu));
  return element('table', { class: 'sizes' },
    element('thead', {}, element('tr', {}, element('td', {}), element('th', { scope: 'col' }, 'File'),
      element('th', { scope: 'col' }, 'GPU memory'))),
    element('tbody', {},
      ...(converted ? [row('vexture convert', bytesText(converted.bytes), bytesText(converted.texture.nbytes))] : []),
      row(converted ? 'This page, for deep zoom' : 'This texture', bytesText(bytes), bytesText(nbytes))));
}

/**
 * @param {Engine} engine
 * @param {import('./state.js').State} _state
 */
export function create(engine, _state) {
  const box = element('div', {});
  const update = async () => {
    const { document: opened, drawing } = engine;
    if (!opened || !drawing) return;
    const { nbytes } = drawing.texture;
    const bytes = opened.manifest.facts?.bytes ?? opened.manifest.bytes;
    box.replaceChildren(tableOf(null, bytes, nbytes));
    const converted = await convertedOf(opened)?.catch(() => null); // the size of the page's own is told without it
    if (converted && engine.drawing === drawing) box.replaceChildren(tableOf(converted, bytes, nbytes));
  };
  engine.addEventListener('shape', () => void update());
  void update();
  const made = section('Size', box);
  made.setAttribute('role', 'region');
  return made;
}
