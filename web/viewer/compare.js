/** The divider: this texture on its left, another representation of the drawing on its right. */
import { BrowserSvg } from './browser-svg.js';
import { element } from './dom.js';
import { convertedOf } from './converted.js';
import { shownDrawing } from './drawing.js';
import { Flat } from './flat.js';
import { bytesText } from './numbers.js';
import { bareRival, rasterRival } from './rivals.js';
import { bytesOf } from './library.js';
import { thesisRival } from './thesis-rival.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 * @typedef {import('./library.js').Document} Document
 */

const STEP = 0.02;
const LONG_STEP = 0.1;

/** @type {Record<string, (split: number) => number>} */
const KEYS = {
  ArrowLeft: (split) => split - STEP, ArrowDown: (split) => split - STEP,
  ArrowRight: (split) => split + STEP, ArrowUp: (split) => split + STEP,
  PageDown: (split) => split - LONG_STEP, PageUp: (split) => split + LONG_STEP,
  Home: () => 0, End: () => 1,
};

/** @param {State} state @param {HTMLElement} stage */
function createDivider(state, stage) {
  const divider = element('div', {
    class: 'divider', role: 'slider', tabindex: 0, 'aria-label': 'Divider', 'aria-valuemin': 0, 'aria-valuemax': 100,
    'aria-orientation': 'horizontal',
  }, element('span', { class: 'grip' }));
  divider.addEventListener('keydown', (event) => {
    const move = KEYS[event.key];
    if (!move) return;
    state.update({ split: move(state.value.split) });
    event.preventDefault();
    event.stopPropagation();
  });
  divider.addEventListener('pointerdown', (event) => {
    divider.setPointerCapture(event.pointerId);
    divider.focus();
    event.preventDefault();
    event.stopPropagation();
  });
  divider.addEventListener('pointermove', (event) => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const box = stage.getBoundingClientRect();
    state.update({ split: (event.clientX - box.left) / box.width });
  });
  divider.addEventListener('dblclick', (event) => event.stopPropagation());
  return divider;
}

/**
 * A raster of as many bytes as `vexture convert` writes, and that texture beside it; of a texture without its source, as
 * many as it has itself.
 *
 * @param {Document} shown
 * @param {Engine} engine
 * @param {import('./drawing.js').ShownDrawing} drawing
 * @returns {Promise<import('./rivals.js').Rival>}
 */
async function equalRaster(shown, engine, drawing) {
  const { renderer, flat, overlayUniforms, backdrop } = engine;
  const converted = await convertedOf(shown);
  const { nbytes } = converted?.texture ?? drawing.texture;
  const rival = rasterRival(renderer, flat, drawing, nbytes);
  const leftLabel = `vexture${converted ? ' convert' : ''}: ${bytesText(nbytes)}`;
  if (!converted) return { ...rival, leftLabel };
  const left = new Flat({ ...overlayUniforms }, backdrop);
  left.setDrawing(shownDrawing(converted.texture, drawing.name));
  const paint = drawing.count === 1 ? drawing.texture.roots[drawing.first].paint : null;
  if (paint && !converted.texture.roots[0].paint) left.paintAll(paint); // of one colour a silhouette is written
  await left.plain.compile(renderer);
  return { ...rival, left, leftLabel, dispose: () => {
    rival.dispose();
    left.dispose();
    converted.texture.dispose();
  } };
}

/**
 * @param {import('./state.js').Rival} which
 * @param {Document} shown
 * @param {Engine} engine
 * @returns {Promise<import('./rivals.js').Rival | BrowserSvg>}
 */
async function prepared(which, shown, engine) {
  const drawing = engine.drawing;
  if (!drawing) throw new Error('nothing is shown');
  if (which === 'raster') return equalRaster(shown, engine, drawing);
  const view = /** @type {any} */ (shown.manifest.views ?? {})[which];
  if (!view) throw new Error(which === 'svg' ? 'the SVG source is not in this file' : 'the source is not in this file');
  if (view.error) throw new Error(view.error);
  if (which === 'svg') {
    const text = new TextDecoder().decode(await bytesOf(view, shown.base));
    const box = shown.manifest.facts?.box;
    if (!box) throw new Error('where the SVG stands is not in this file');
    return new BrowserSvg(text, shown.texture.roots[drawing.first].transform, box);
  }
  const pair = await Promise.all(view.map((/** @type {string} */ url) => bytesOf(url, shown.base)));
  const rival = await thesisRival(pair, shown.name, drawing, engine.backdrop);
  await rival.pass.compile(engine.renderer);
  return rival;
}

/**
 * @param {Engine} engine
 * @param {State} state
 * @param {HTMLElement} stage
 * @param {(message: string) => void} note
 */
export function createCompare(engine, state, stage, note) {
  const divider = createDivider(state, stage);
  const left = element('div', { class: 'half left' }, 'vexture');
  const right = element('div', { class: 'half right' });
  const layer = element('div', { class: 'compare' }, left, right);
  /** @type {BrowserSvg | null} */
  let svg = null;
  let turn = 0;

  const place = () => {
    const { compare, mode, split } = state.value;
    const seen = compare !== null && mode === 'flat' && engine.rival !== null;
    layer.hidden = divider.hidden = !seen;
    if (!seen) return;
    layer.style.setProperty('--split', `${split * 100}%`);
    divider.style.left = `${split * 100}%`;
    divider.setAttribute('aria-valuenow', String(Math.round(split * 100)));
    divider.setAttribute('aria-valuetext', `${Math.round(split * 100)} % this texture`);
    svg?.show(state.value, engine.size);
    svg?.element.classList.toggle('silhouette', engine.drawing?.silhouette ?? false);
  };
  const clear = () => {
    engine.setRival(null);
    svg?.element.remove();
    svg = null;
  };
  const change = async () => {
    const mine = ++turn;
    const { compare } = state.value;
    const shown = engine.document;
    if (!compare || !shown) clear();
    else {
      try {
        const made = await prepared(compare, shown, engine);
        if (mine !== turn) return made instanceof BrowserSvg ? undefined : made.dispose();
        clear();
        const rival = made instanceof BrowserSvg ? bareRival(engine.backdrop, /** @type {any} */ (engine.drawing)) : made;
        if (made instanceof BrowserSvg) layer.prepend((svg = made).element);
        engine.setRival(rival);
        left.textContent = rival.leftLabel ?? 'vexture';
        right.textContent = rival.label;
      } catch (error) {
        if (mine !== turn) return;
        clear();
        note(`Cannot compare: ${/** @type {Error} */ (error).message}`);
        state.update({ compare: null });
      }
    }
    place();
    engine.requestFrame();
  };
  state.addEventListener('change', (event) => {
    if (/** @type {CustomEvent} */ (event).detail.changed.has('compare')) void change();
    else place();
  });
  engine.addEventListener('shape', () => void change());
  engine.addEventListener('restored', () => void change());
  engine.addEventListener('view', place);
  place();
  stage.append(layer, divider);
  return { image: () => (state.value.mode === 'flat' ? svg?.image ?? null : null) };
}
