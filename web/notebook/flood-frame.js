/** The page of a flood in a frame of a notebook; the widget's step is that of the page. */
import { element } from '../viewer/dom.js';

/**
 * @typedef {object} FloodPage what the page offers
 * @property {Promise<void>} ready
 * @property {EventTarget & { index: number, count: number }} player
 * @property {(at: number) => Promise<void>} step
 */

/** @param {{ model: import('./widget.js').Model, el: HTMLElement }} widget */
function render({ model, el }) {
  const ended = new AbortController();
  const frame = element('iframe', {
    title: model.get('_name'), allow: 'fullscreen; clipboard-write', style: 'width: 100%; border: 0',
    srcdoc: new TextDecoder().decode(model.get('_page')),
  });
  const sized = () => {
    frame.style.height = `${model.get('height')}px`;
  };
  const told = (/** @type {FloodPage} */ { player }) => {
    if (ended.signal.aborted || model.get('step') === player.index) return;
    model.set('step', player.index);
    model.save_changes();
  };
  const stepped = async () => {
    const page = pageOf(frame);
    if (!page || page.player.index === model.get('step')) return;
    await page.step(Math.min(model.get('step'), page.player.count - 1));
    told(page);
  };
  for (const [event, act] of /** @type {const} */ ([['change:height', sized], ['change:step', () => void stepped()]])) {
    model.on(event, act);
    ended.signal.addEventListener('abort', () => model.off(event, act));
  }
  frame.addEventListener('load', async () => {
    const page = pageOf(frame);
    await page?.ready;
    if (!page || ended.signal.aborted) return;
    await stepped();
    page.player.addEventListener('step', () => told(page));
  });
  sized();
  el.append(frame);
  return () => {
    ended.abort();
    frame.remove();
  };
}

/** @param {HTMLIFrameElement} frame @returns {FloodPage | undefined} */
const pageOf = (frame) => /** @type {any} */ (frame.contentWindow)?.vexture?.flood;

export default { render };
