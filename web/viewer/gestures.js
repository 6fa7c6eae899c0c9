/**
 * Pointer, wheel, touch and keyboard input on the stage, as changes of the view.
 *
 * @typedef {object} Moves
 * @property {(dx: number, dy: number) => void} drag by CSS pixels
 * @property {(px: number, py: number, factor: number) => void} zoom about a place
 * @property {(factor: number) => void} zoomMiddle
 * @property {() => void} reset
 */

const KEY_STEP = 64;
export const ZOOM_STEP = 1.5;
const DOUBLE_CLICK_ZOOM = 2;
/** A wheel's notch is about 100 pixels. */
const WHEEL_RATE = 0.0022;
const WHEEL_LINE = 16;
const WHEEL_MOST = 240;
/** Pinching on a trackpad comes as a wheel with ctrl, in finer steps. */
const PINCH_RATE = 0.01;

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** @param {WheelEvent} event */
function wheelFactor(event) {
  const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : WHEEL_LINE;
  const way = Math.max(-WHEEL_MOST, Math.min(WHEEL_MOST, event.deltaY * unit));
  return Math.exp(-way * (event.ctrlKey ? PINCH_RATE : WHEEL_RATE));
}

/** @param {Moves} moves */
function keyHandler(moves) {
  return (/** @type {KeyboardEvent} */ event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = ARROWS[event.key];
    const step = event.shiftKey ? KEY_STEP / 8 : KEY_STEP;
    if (way) moves.drag(way[0] * step, way[1] * step);
    else if (event.key === '+' || event.key === '=') moves.zoomMiddle(ZOOM_STEP);
    else if (event.key === '-' || event.key === '_') moves.zoomMiddle(1 / ZOOM_STEP);
    else if (event.key === '0' || event.key === 'Home') moves.reset();
    else return;
    event.preventDefault();
  };
}

/**
 * @param {HTMLElement} stage takes the focus
 * @param {Moves} moves
 */
export function listen(stage, moves) {
  /** @type {Map<number, {x: number, y: number}>} places of the fingers or the mouse */
  const held = new Map();
  const spread = () => {
    const [one, other] = [...held.values()];
    return { x: (one.x + other.x) / 2, y: (one.y + other.y) / 2, length: Math.hypot(one.x - other.x, one.y - other.y) };
  };
  const place = (/** @type {MouseEvent} */ event) => {
    const box = stage.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  stage.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || held.size === 2) return;
    stage.setPointerCapture(event.pointerId);
    held.set(event.pointerId, place(event));
    stage.classList.add('held');
  });
  stage.addEventListener('pointermove', (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const before = held.size === 2 ? spread() : null;
    const now = place(event);
    held.set(event.pointerId, now);
    if (before) {
      const after = spread();
      moves.drag(after.x - before.x, after.y - before.y);
      if (before.length > 0) moves.zoom(after.x, after.y, after.length / before.length);
    } else moves.drag(now.x - last.x, now.y - last.y);
  });
  const release = (/** @type {PointerEvent} */ event) => {
    held.delete(event.pointerId);
    stage.classList.toggle('held', held.size > 0);
  };
  stage.addEventListener('pointerup', release);
  stage.addEventListener('pointercancel', release);
  stage.addEventListener('wheel', (event) => {
    event.preventDefault();
    const { x, y } = place(event);
    moves.zoom(x, y, wheelFactor(event));
  }, { passive: false });
  stage.addEventListener('dblclick', (event) => {
    const { x, y } = place(event);
    moves.zoom(x, y, event.shiftKey ? 1 / DOUBLE_CLICK_ZOOM : DOUBLE_CLICK_ZOOM);
  });
  stage.addEventListener('keydown', keyHandler(moves));
}
