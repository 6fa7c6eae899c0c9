/** Pointer, wheel, touch and keyboard on a stage: the viewer's, and besides them picking, hovering, and going home. */
import { listen } from '../viewer/gestures.js';

/** CSS pixels that a pointer may move while it clicks. */
const STILL = 4;

/**
 * @param {HTMLElement} element
 * @param {import('./stage.js').Stage} stage
 * @param {AbortSignal} signal ends what is not the element's own
 */
export function listenTo(element, stage, signal) {
  const place = (/** @type {MouseEvent} */ event) => {
    const box = element.getBoundingClientRect();
    return /** @type {[number, number]} */ ([event.clientX - box.left, event.clientY - box.top]);
  };
  const home = () => stage.home();
  element.addEventListener('dblclick', (event) => {
    event.stopImmediatePropagation(); // the viewer's would zoom
    home();
  }, { capture: true });
  const middle = (/** @type {number} */ factor) => stage.zoom(element.clientWidth / 2, element.clientHeight / 2, factor);
  listen(element, {
    drag: (dx, dy) => stage.drag(dx, dy), zoom: (px, py, factor) => stage.zoom(px, py, factor), zoomMiddle: middle, reset: home,
  });
  watchClicks(element, stage, place);
  watchPlaces(element, stage, place, signal);
}

/** @param {HTMLElement} element @param {import('./stage.js').Stage} stage @param {(event: MouseEvent) => [number, number]} place */
function watchClicks(element, stage, place) {
  /** @type {Map<number, [number, number]>} */
  const down = new Map();
  let isClick = false;
  element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    down.set(event.pointerId, place(event));
    isClick = down.size === 1;
    stage.hold(true);
  });
  element.addEventListener('pointermove', (event) => {
    const [x, y] = place(event);
    const from = down.get(event.pointerId);
    if (from && Math.hypot(x - from[0], y - from[1]) > STILL) isClick = false;
  });
  const up = (/** @type {PointerEvent} */ event) => {
    if (!down.delete(event.pointerId)) return;
    if (down.size === 0) stage.hold(false);
    if (isClick && event.type === 'pointerup') stage.pick(...place(event));
  };
  element.addEventListener('pointerup', up);
  element.addEventListener('pointercancel', up);
}

/** @param {HTMLElement} element @param {import('./stage.js').Stage} stage @param {(event: MouseEvent) => [number, number]} place @param {AbortSignal} signal */
function watchPlaces(element, stage, place, signal) {
  let frame = 0;
  /** @type {[number, number] | null} */
  let last = null;
  const look = (/** @type {[number, number] | null} */ at) => {
    last = at;
    if (frame !== 0) return;
    frame = requestAnimationFrame(() => {
      frame = 0;
      if (!signal.aborted) stage.hover(last);
    });
  };
  element.addEventListener('pointermove', (event) => {
    if (event.buttons === 0) look(place(event));
  });
  element.addEventListener('pointerleave', () => look(null));
  element.addEventListener('pointerover', ({ target }) => {
    if (target !== element && !(target instanceof HTMLCanvasElement)) look(null); // it is over the legend, or the time
  });
}

