/** Pictures that a kernel draws of what is not there yet: each is shown where it belongs, and a sharper one asked for. */
import { pixelSide } from '../viewer/view.js';
import { viewOf } from './rect.js';

/**
 * @typedef {import('./rect.js').Rect} Rect
 * @typedef {{ view: Rect, size: [number, number] }} Frame
 * @typedef {Frame & { content: DataView }} Picture
 */

export class Sketch {
  /** @type {{ frame: Frame, image: ImageBitmap } | null} */
  #shown = null;
  #isWaiting = true;

  /**
   * @param {import('./widget.js').Model} model
   * @param {HTMLCanvasElement} canvas
   * @param {() => void} redraw
   * @param {AbortSignal} ended
   */
  constructor(model, canvas, redraw, ended) {
    this.model = model;
    this.canvas = canvas;
    const come = async () => {
      const picture = /** @type {Picture | null} */ (model.get('_picture'));
      if (!picture) return;
      const { view, size, content } = picture;
      const image = await createImageBitmap(new Blob([/** @type {DataView<ArrayBuffer>} */ (content)], { type: 'image/png' }));
      this.#shown = { frame: { view, size }, image };
      this.#isWaiting = false;
      if (!ended.aborted) redraw();
    };
    model.on('change:_picture', come);
    ended.addEventListener('abort', () => model.off('change:_picture', come));
    void come();
  }

  /** @param {Rect} rect */
  draw(rect) {
    const { width, height } = this.canvas;
    if (!this.#shown || width === 0 || height === 0) return;
    const { frame: { view, size: [across, down] }, image } = this.#shown;
    const before = viewOf(view, { width: across, height: down });
    const now = viewOf(rect, this.canvas);
    const [side, own] = [pixelSide(now.zoom, this.canvas), pixelSide(before.zoom, { width: across, height: down })];
    const scale = own / side;
    const left = width / 2 + (before.center[0] - now.center[0]) / side - scale * across / 2;
    const top = height / 2 - (before.center[1] - now.center[1]) / side - scale * down / 2;
    const drawing = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext('2d'));
    drawing.globalCompositeOperation = 'copy';
    drawing.drawImage(image, left, top, scale * across, scale * down);
    if (!this.#isWaiting && String([...view, across, down]) !== String([...rect, width, height])) this.#ask(rect);
  }

  /** One picture at a time: what was asked for while the kernel was busy is no longer looked at. @param {Rect} view */
  #ask(view) {
    this.#isWaiting = true;
    this.model.set('_wanted', { view, size: [this.canvas.width, this.canvas.height] });
    this.model.save_changes();
  }
}
