/** The canvas: its contents, and when to draw them. */
import { SRGBColorSpace, WebGLRenderer } from 'three';
import { Backdrop } from './backdrop.js';
import { shownDrawing } from './drawing.js';
import { Flat } from './flat.js';
import { FrameClock } from './frame-clock.js';
import { setRivalView } from './rivals.js';
import { Solid } from './solid.js';
import { panned, toScreen, toUnit, zoomed } from './view.js';

/**
 * @typedef {import('./state.js').State} State
 * @typedef {import('./view.js').Size} Size
 */

const TURN_RATE = 0.008; // radians to a CSS pixel

/**
 * Draws the state when it changes. Events: `view` when the view or the size changes, `shape` when another texture or
 * drawing is shown, `frame` after each frame, with `detail.milliseconds`; `lost` and `restored` for the context.
 */
export class Engine extends EventTarget {
  /** Uniforms of overlay.glsl, to be set before the first frame. @type {Record<string, {value: any}>} */
  overlayUniforms = {};
  /** @type {import('./drawing.js').ShownDrawing | null} */
  drawing = null;
  /** @type {import('./library.js').Document | null} */
  document = null;
  /** @type {Size} */
  size = { width: 1, height: 1 };
  /** Device pixels of a CSS pixel. */
  ratio = 1;
  #clock = new FrameClock();
  backdrop = new Backdrop();
  /** What is drawn right of the divider. @type {import('./rivals.js').Rival | null} */
  rival = null;
  /** @type {Solid | null} */
  #solid = null;
  #frame = 0;
  #lost = false;
  /** Whether something else covers the picture, and may use its canvas. */
  covered = false;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {State} state
   * @throws {Error} without WebGL 2
   */
  constructor(canvas, state) {
    super();
    this.canvas = canvas;
    this.state = state;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = true;
    this.recolor();
    this.flat = new Flat(this.overlayUniforms, this.backdrop);
    state.addEventListener('change', (event) => this.#stateChanged(/** @type {CustomEvent} */ (event).detail.changed));
    canvas.addEventListener('webglcontextlost', () => {
      this.#lost = true;
      this.dispatchEvent(new CustomEvent('lost'));
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#lost = false;
      this.dispatchEvent(new CustomEvent('restored'));
      this.requestFrame();
    });
    const box = /** @type {HTMLElement} */ (canvas.parentElement);
    new ResizeObserver(() => this.resize(box.clientWidth, box.clientHeight)).observe(box);
    this.resize(box.clientWidth, box.clientHeight);
  }

  /** The shown texture. */
  get texture() {
    return this.drawing?.texture ?? null;
  }

  /**
   * Show a shape. The canvas keeps its contents until the shape can be drawn.
   *
   * @param {import('./library.js').Document} document
   */
  async show(document) {
    this.document = document;
    this.drawing = shownDrawing(document.texture, this.state.value.drawing);
    this.flat.setDrawing(this.drawing);
    await this.flat.plain.compile(this.renderer);
    await this.#raise();
    this.dispatchEvent(new CustomEvent('shape'));
    this.requestFrame();
  }

  /** @param {import('./rivals.js').Rival | null} rival whose program is compiled */
  setRival(rival) {
    this.rival?.dispose();
    this.rival = rival;
  }

  /** Switch to the state's surface. The canvas keeps its contents until the surface can be drawn. */
  async #raise() {
    const { mode } = this.state.value;
    if (mode === 'flat' || !this.drawing) return;
    if (this.#solid?.surface === mode && this.#solid.drawing === this.drawing) return;
    const solid = new Solid(mode, this.drawing);
    await solid.compile(this.renderer);
    if (solid.surface !== this.state.value.mode || solid.drawing !== this.drawing) {
      solid.dispose(); // the state has changed meanwhile
      return;
    }
    this.#solid?.dispose();
    this.#solid = solid;
    this.requestFrame();
  }

  /** @param {number} width @param {number} height of the stage, in CSS pixels */
  resize(width, height) {
    this.ratio = window.devicePixelRatio;
    this.size = { width: Math.max(1, width), height: Math.max(1, height) };
    this.renderer.setPixelRatio(this.ratio);
    this.backdrop.scale(this.ratio);
    this.renderer.setSize(this.size.width, this.size.height);
    this.dispatchEvent(new CustomEvent('view'));
    if (this.drawing && this.flat.plain.ready) this.render(); // a resized canvas is blank until it is drawn
  }

  /** Set the background again, which may be the theme's. */
  recolor() {
    this.backdrop.set(this.state.value.background);
    const { parentElement } = this.canvas;
    if (parentElement) parentElement.dataset.theme = this.backdrop.isDark ? 'dark' : 'light'; // of the marks on it
    this.requestFrame();
  }

  requestFrame() {
    if (this.#frame !== 0) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      this.render();
    });
  }

  /** Draw now. */
  render() {
    const { drawing, flat, state } = this;
    if (!drawing || this.#lost || this.covered || !flat.plain.ready) return;
    const begin = performance.now();
    if (state.value.mode === 'flat') this.#drawFlat();
    else if (!this.#drawSolid(state.value.mode)) return;
    this.#clock.measure(this.renderer, begin, (milliseconds) => {
      this.dispatchEvent(new CustomEvent('frame', { detail: { milliseconds } }));
    });
  }

  #drawFlat() {
    const { flat, renderer, rival, size, state } = this;
    const { overlays, split, compare } = state.value;
    const wanted = overlays.cells || overlays.coverage || overlays.depth || overlays.cutoff > 0;
    if (wanted && !flat.overlaid.ready) void flat.overlaid.compile(renderer).then(() => this.requestFrame());
    const halves = compare !== null && rival !== null;
    const shown = halves && !wanted && rival.left ? rival.left : flat;
    const pass = wanted && flat.overlaid.ready ? flat.overlaid : shown.plain;
    shown.setView(state.value, size, this.ratio);
    const at = Math.round(split * size.width * this.ratio) / this.ratio;
    renderer.setScissorTest(halves);
    if (halves) renderer.setScissor(0, 0, at, size.height);
    pass.draw(renderer);
    if (!halves) return;
    setRivalView(rival, state.value, size, this.ratio);
    renderer.setScissor(at, 0, size.width - at, size.height);
    rival.pass.draw(renderer);
    renderer.setScissorTest(false);
  }

  /** @param {string} mode @returns {boolean} whether it could be drawn */
  #drawSolid(mode) {
    const solid = this.#solid;
    if (!solid?.ready || solid.surface !== mode || solid.drawing !== this.drawing) return false;
    solid.place(this.state.value, this.size);
    solid.draw(this.renderer, this.backdrop);
    return true;
  }

  /**
   * Point of the unit square at a place on the canvas; null beside the surface.
   *
   * @param {number} px @param {number} py
   * @returns {[number, number] | null}
   */
  toUnit(px, py) {
    const { mode } = this.state.value;
    if (mode === 'flat') return toUnit(this.state.value, this.size, px, py);
    return this.#solid?.toUnit(px, py, this.size) ?? null;
  }

  /**
   * Place on the canvas of a point of the unit square, in the flat view.
   *
   * @param {number} u @param {number} v
   */
  toScreen(u, v) {
    return toScreen(this.state.value, this.size, u, v);
  }

  /** @param {number} dx @param {number} dy CSS pixels */
  drag(dx, dy) {
    const { value } = this.state;
    if (value.mode === 'flat') this.state.update(panned(value, this.size, dx, dy));
    else this.state.update({ yaw: value.yaw + dx * TURN_RATE, pitch: value.pitch + dy * TURN_RATE });
  }

  /** @param {number} px @param {number} py @param {number} factor */
  zoom(px, py, factor) {
    const { value } = this.state;
    if (value.mode === 'flat') this.state.update(zoomed(value, this.size, px, py, factor));
    else this.state.update({ distance: value.distance * factor });
  }

  /** @param {number} factor */
  zoomMiddle(factor) {
    this.zoom(this.size.width / 2, this.size.height / 2, factor);
  }

  /** @param {Set<string>} changed */
  #stateChanged(changed) {
    if (changed.has('mode')) void this.#raise();
    if (changed.has('background')) this.recolor();
    if (changed.has('drawing') && this.document) void this.show(this.document);
    if (['center', 'zoom', 'mode', 'yaw', 'pitch', 'distance'].some((key) => changed.has(key))) {
      this.dispatchEvent(new CustomEvent('view'));
    }
    this.requestFrame();
  }
}
