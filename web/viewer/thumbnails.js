/** Small pictures of many drawings of a texture, by the shader of the page, on the canvas that they cover. */
import { drawingOfRange } from './drawing.js';
import { Flat } from './flat.js';
import { FIT } from './view.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 *
 * @typedef {object} Thumbnail
 * @property {import('./drawing.js').Range} range
 * @property {HTMLCanvasElement} canvas square
 */

export class Thumbnails {
  #engine;
  #flat;

  /** @param {Engine} engine */
  constructor(engine) {
    this.#engine = engine;
    this.#flat = new Flat({ ...engine.overlayUniforms }, engine.backdrop);
  }

  /**
   * Draw some, of one size: as many as the canvas of the page holds at once, then the next.
   *
   * @param {import('../src/vector-texture.js').VectorTexture} texture
   * @param {Thumbnail[]} wanted
   * @param {number} side in device pixels
   * @param {() => boolean} isStillWanted
   */
  async draw(texture, wanted, side, isStillWanted) {
    const { canvas } = this.#engine;
    const columns = Math.max(1, Math.floor(canvas.width / side));
    const most = columns * Math.max(1, Math.floor(canvas.height / side));
    for (let first = 0; first < wanted.length; first += most) {
      const batch = wanted.slice(first, first + most).map((one) => ({ ...one, drawing: drawingOfRange(texture, one.range) }));
      for (const { drawing } of batch) {
        this.#flat.setDrawing(drawing);
        if (!this.#flat.plain.ready) await this.#flat.plain.compile(this.#engine.renderer);
      }
      if (!isStillWanted()) return;
      this.#drawBatch(batch, columns, side);
    }
  }

  /**
   * @param {(Thumbnail & {drawing: import('./drawing.js').ShownDrawing})[]} batch
   * @param {number} columns
   * @param {number} side
   */
  #drawBatch(batch, columns, side) {
    const { canvas, renderer, ratio, size } = this.#engine;
    const places = batch.map((_, i) => [side * (i % columns), side * Math.floor(i / columns)]);
    const step = 1 / (FIT * side);
    const { base, start, side: pixel } = this.#flat.uniforms;
    base.value = [0, 0];
    pixel.value = step;
    renderer.setScissorTest(false);
    batch.forEach(({ drawing }, i) => {
      const [x, y] = places[i];
      renderer.setViewport(x / ratio, y / ratio, side / ratio, side / ratio);
      start.value.set(0.5 - (x + side / 2) * step, 0.5 - (y + side / 2) * step);
      this.#flat.setDrawing(drawing);
      this.#flat.plain.draw(renderer);
    });
    renderer.setViewport(0, 0, size.width, size.height);
    batch.forEach(({ canvas: target }, i) => { // in the same task: later the canvas may be empty
      target.width = target.height = side;
      const [x, y] = places[i];
      target.getContext('2d')?.drawImage(canvas, x, canvas.height - y - side, side, side, 0, 0, side, side);
    });
  }
}
