/** Drawing over the canvas, in CSS pixels: sharp at every zoom. */

const NAMESPACE = 'http://www.w3.org/2000/svg';

/**
 * @param {string} tag
 * @param {Record<string, string | number>} [attributes]
 * @param {(Node | string)[]} children
 */
export function svgElement(tag, attributes = {}, ...children) {
  const made = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

/**
 * An empty layer that covers the canvas and lets the pointer through.
 *
 * @param {import('./engine.js').Engine} engine
 * @param {string} name class of it
 */
export function svgLayer(engine, name) {
  const layer = svgElement('svg', { class: `svg-layer ${name}`, 'aria-hidden': 'true' });
  engine.canvas.after(layer);
  return layer;
}

/**
 * Rectangle of a cell.
 *
 * @param {(u: number, v: number) => [number, number]} toScreen
 * @param {{x: number, y: number, size: number}} cell in the unit square
 * @param {string} name class of it
 */
export function cellRect(toScreen, { x, y, size }, name) {
  const [left, bottom] = toScreen(x, y);
  const [right, top] = toScreen(x + size, y + size);
  return svgElement('rect', { class: name, x: left, y: top, width: right - left, height: bottom - top });
}
