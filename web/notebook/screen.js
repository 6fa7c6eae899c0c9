/**
 * One renderer for all stages of a page: browsers keep about 16 contexts of WebGL, and a notebook may hold more pictures.
 * Each stage has a canvas of its own, to which its picture is copied.
 */
import { WebGLRenderer } from 'three';
import { Backdrop } from '../viewer/backdrop.js';
import { Flat } from '../viewer/flat.js';

/**
 * @typedef {object} Drawn
 * @property {HTMLCanvasElement} canvas
 * @property {import('../viewer/drawing.js').ShownDrawing | null} shown
 * @property {import('../viewer/view.js').View} view on the canvas
 * @property {boolean} isSeen whether it is scrolled into the window, or nearly
 */

/** Nothing: what is behind a drawing shines through its canvas. */
function nothing() {
  const backdrop = new Backdrop();
  for (const { value } of [backdrop.uniforms.paper, backdrop.uniforms.checks]) value.set(0, 0, 0, 0);
  return backdrop;
}

export class Screen {
  /** @type {Set<Drawn>} */
  #stale = new Set();
  /** @type {Set<Drawn>} */
  #stages = new Set();
  #frame = 0;
  #lost = false;
  /** The programs of all stages. */
  #flat = new Flat({}, nothing());

  /** @throws {Error} without WebGL 2 */
  constructor() {
    const canvas = document.createElement('canvas');
    this.renderer = new WebGLRenderer({ canvas, alpha: true, antialias: false, depth: false, stencil: false });
    this.renderer.autoClear = false;
    canvas.addEventListener('webglcontextlost', () => {
      this.#lost = true;
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#lost = false;
      for (const stage of this.#stages) this.request(stage);
    });
  }

  /** @param {Drawn} stage */
  add(stage) {
    this.#stages.add(stage);
  }

  /** @param {Drawn} stage */
  remove(stage) {
    this.#stages.delete(stage);
    this.#stale.delete(stage);
  }

  /** Compile what draws a stage, if no other stage has needed it. @param {Drawn} stage */
  async prepare({ shown }) {
    if (!shown) return;
    this.#setDrawing(shown);
    await this.#flat.plain.compile(this.renderer);
  }

  /** @param {import('../viewer/drawing.js').ShownDrawing} shown a silhouette is black */
  #setDrawing(shown) {
    this.#flat.setDrawing(shown);
    this.#flat.uniforms.tint.value.set(0, 0, 0, 1);
    this.#flat.uniforms.tinted.value = shown.silhouette;
  }

  /** Draw a stage in the next frame, or once it is seen. @param {Drawn} stage */
  request(stage) {
    if (!this.#stages.has(stage)) return;
    this.#stale.add(stage);
    if (this.#frame !== 0 || !stage.isSeen) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      for (const one of [...this.#stale]) if (one.isSeen && this.#draw(one)) this.#stale.delete(one);
    });
  }

  /** @param {Drawn} stage @returns {boolean} whether its canvas shows it now */
  #draw({ canvas, shown, view }) {
    const { width, height } = canvas;
    const { renderer } = this;
    const whole = renderer.domElement;
    if (this.#lost || !shown || width === 0 || height === 0) return false;
    this.#setDrawing(shown);
    if (!this.#flat.plain.ready) return false;
    if (whole.width < width || whole.height < height) {
      renderer.setSize(Math.max(whole.width, width), Math.max(whole.height, height), false);
    }
    renderer.setViewport(0, 0, width, height);
    this.#flat.setView(view, canvas, 1);
    this.#flat.plain.draw(renderer);
    const picture = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    picture.globalCompositeOperation = 'copy';
    picture.drawImage(whole, 0, whole.height - height, width, height, 0, 0, width, height);
    return true;
  }
}

/** @type {Screen | null} */
let screen = null;

/** The page's own. @throws {Error} without WebGL 2 */
export function screenOfPage() {
  screen ??= new Screen();
  return screen;
}
