/** Position of the pointer on the canvas. */

/**
 * @param {import('./engine.js').Engine} engine
 * @param {(px: number, py: number) => void} pointed at CSS pixels of the canvas
 */
export function watchPointer({ canvas }, pointed) {
  const stage = canvas.parentElement ?? canvas; // it is what captures the pointer while the picture is dragged
  const point = (/** @type {PointerEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    pointed(event.clientX - box.left, event.clientY - box.top);
  };
  stage.addEventListener('pointerdown', point);
  stage.addEventListener('pointermove', point);
}
