/** Depths of the water, from an image of them. */
import { decode } from 'fast-png';

export class Depths {
  #image;
  #deepest;

  /**
   * @param {Uint8Array} png 8-bit gray, over the box, northernmost row first
   * @param {number} deepest metres that 255 stands for
   */
  constructor(png, deepest) {
    this.#image = decode(png);
    if (this.#image.depth !== 8) throw new Error(`The picture of the depths has ${this.#image.depth} bits, not 8.`);
    this.#deepest = deepest;
  }

  /**
   * Metres at a place of the box.
   *
   * @param {number} s eastwards, 0..1
   * @param {number} t northwards, 0..1
   */
  at(s, t) {
    const { width, height, channels, data } = this.#image;
    const column = Math.min(Math.max(Math.floor(s * width), 0), width - 1);
    const row = Math.min(Math.max(Math.floor((1 - t) * height), 0), height - 1);
    return (data[(row * width + column) * channels] / 255) * this.#deepest;
  }
}
