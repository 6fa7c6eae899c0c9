/** The source drawn by the browser, following the view. It is an image element, so its scripts do not run. */
import { element } from './dom.js';
import { toUnit } from './view.js';

/**
 * @typedef {import('./view.js').View} View
 * @typedef {import('./view.js').Size} Size
 */

const SVG = 'http://www.w3.org/2000/svg';

/**
 * The source's root element, placed in another SVG at its own window: viewBox, aspect ratio and clipping act as in the
 * standalone document.
 *
 * @param {string} text
 * @param {[number, number, number, number]} window left, top, width and height, in the source's user units
 */
function nested(text, [x, y, width, height]) {
  const parsed = new DOMParser().parseFromString(text, 'image/svg+xml');
  const root = parsed.documentElement;
  if (root.namespaceURI !== SVG || root.localName !== 'svg' || parsed.querySelector('parsererror')) {
    throw new Error('the browser cannot read this SVG');
  }
  Object.entries({ x, y, width, height }).forEach(([name, value]) => root.setAttribute(name, String(value)));
  const { style } = /** @type {SVGSVGElement} */ (/** @type {unknown} */ (root));
  style.setProperty('width', `${width}px`, 'important');
  style.setProperty('height', `${height}px`, 'important');
  style.setProperty('overflow', 'hidden', 'important');
  return new XMLSerializer().serializeToString(root);
}

export class BrowserSvg {
  /** @type {{view: View, size: Size} | null} view of the image in place */
  #shown = null;
  #busy = false;
  #again = false;
  /** @type {View} */
  #view = { center: [0.5, 0.5], zoom: 1 };
  /** @type {Size} */
  #size = { width: 1, height: 1 };

  /**
   * @param {string} text the source
   * @param {number[]} transform from the unit square to its user units, row by row
   * @param {[number, number, number, number]} box its window: left, bottom, right and top in the unit square
   */
  constructor(text, transform, [left, bottom, right, top]) {
    this.transform = transform;
    const [x, y] = this.#user([left, top]);
    const [beyond, below] = this.#user([right, bottom]);
    this.content = nested(text, [x, y, beyond - x, below - y]);
    this.element = element('div', { class: 'browser-svg' });
    /** @type {HTMLImageElement | null} */
    this.image = null;
  }

  /** @param {[number, number]} point of the unit square */
  #user([u, v]) {
    const [a, b, c, d, e, f] = this.transform;
    return [a * u + b * v + c, d * u + e * v + f];
  }

  /** The whole document with the canvas's view. */
  #document() {
    const [x0, y0] = this.#user(toUnit(this.#view, this.#size, 0, 0));
    const [x1, y1] = this.#user(toUnit(this.#view, this.#size, this.#size.width, this.#size.height));
    const { width, height } = this.#size;
    return `<svg xmlns="${SVG}" width="${width}" height="${height}" preserveAspectRatio="none" `
      + `viewBox="${x0} ${y0} ${x1 - x0} ${y1 - y0}">${this.content}</svg>`;
  }

  /**
   * @param {View} view
   * @param {Size} size
   */
  show(view, size) {
    this.#view = view;
    this.#size = size;
    this.#place();
    if (this.#busy) this.#again = true;
    else void this.#draw();
  }

  /** Until the image of this view is ready, transform the last one. */
  #place() {
    if (!this.#shown || !this.image) return;
    const { view, size } = this.#shown;
    const [left, top] = toUnit(view, size, 0, 0);
    const [from, to] = [toUnit(this.#view, this.#size, 0, 0), toUnit(this.#view, this.#size, 1, 1)];
    const scale = (toUnit(view, size, 1, 1)[0] - left) / (to[0] - from[0]);
    const x = (left - from[0]) / (to[0] - from[0]);
    const y = (top - from[1]) / (to[1] - from[1]);
    this.image.style.transform = `matrix(${scale}, 0, 0, ${scale}, ${x}, ${y})`;
  }

  async #draw() {
    this.#busy = true;
    do {
      this.#again = false;
      const made = { view: this.#view, size: this.#size };
      const url = URL.createObjectURL(new Blob([this.#document()], { type: 'image/svg+xml' }));
      const image = new Image(made.size.width, made.size.height);
      image.alt = '';
      image.draggable = false;
      image.src = url;
      try {
        await image.decode();
        this.image = image;
        this.#shown = made;
        this.element.replaceChildren(image);
        this.#place();
      } catch {
        this.element.replaceChildren('The browser cannot draw this SVG.');
      } finally {
        URL.revokeObjectURL(url);
      }
    } while (this.#again);
    this.#busy = false;
    this.element.dispatchEvent(new Event('shown'));
  }
}
