// The table of labels, from which a shader reads where each is, and its colour.
import { Color, DataTexture, FloatType, RGBAFormat } from 'three';
import { LABEL_TEXELS, LABEL_WIDTH } from '../glyph-shader.js';
import { unfiltered } from '../upload.js';

/** @import { Label } from './label.js' */

/** Numbers of a label. */
const NUMBERS = 4 * LABEL_TEXELS;

/** Labels in a row. */
const PER_ROW = LABEL_WIDTH / LABEL_TEXELS;

const TINT = new Color();

/** Rows of labels as a texture of three.js. */
export class LabelTable {
  /** @type {true} */
  isLabels = true;
  /** @type {'labels' | 'sprites'} */
  kind;
  #rows = 0;
  #values = new Float32Array(0);
  /** Whether any label is turned; sprites never are. */
  hasTurns = false;
  /** @type {DataTexture} */
  texture;

  /**
   * @param {boolean} areSprites whether they face the camera
   * @param {boolean} arePixels whether their sizes are in pixels
   */
  constructor(areSprites, arePixels) {
    this.areSprites = areSprites;
    this.kind = areSprites ? 'sprites' : 'labels';
    this.arePixels = arePixels;
    this.texture = this.#grow(1);
  }

  /** What of them makes a program another one. */
  toJSON() {
    return this.kind;
  }

  /** @param {number} rows */
  #grow(rows) {
    const values = new Float32Array(4 * LABEL_WIDTH * rows);
    values.set(this.#values);
    this.#rows = rows;
    this.#values = values;
    return unfiltered(new DataTexture(values, LABEL_WIDTH, rows, RGBAFormat, FloatType), 'RGBA32F');
  }

  /**
   * Have room for labels.
   *
   * @param {number} count
   * @returns {boolean} whether the texture is another one now
   */
  makeRoom(count) {
    if (count <= PER_ROW * this.#rows) return false;
    const before = this.texture;
    this.texture = this.#grow(Math.max(Math.ceil(count / PER_ROW), 2 * this.#rows));
    before.dispose();
    return true;
  }

  /**
   * Take the places and colours of labels.
   *
   * @param {Iterable<Label>} labels
   */
  update(labels) {
    const values = this.#values;
    let isChanged = false,
      hasTurns = false;
    const put = (/** @type {number} */ at, /** @type {number} */ value) => {
      if (values[at] === Math.fround(value)) return;
      values[at] = value;
      isChanged = true;
    };
    for (const { row, position, quaternion, scale, color, opacity, visible } of labels) {
      const at = NUMBERS * row;
      put(at, position.x);
      put(at + 1, position.y);
      put(at + 2, position.z);
      put(at + 3, this.arePixels ? -scale : scale);
      put(at + 4, quaternion.x);
      put(at + 5, quaternion.y);
      put(at + 6, quaternion.z);
      put(at + 7, quaternion.w);
      hasTurns ||= quaternion.x !== 0 || quaternion.y !== 0 || quaternion.z !== 0;
      const { r, g, b } = color instanceof Color ? color : TINT.set(color);
      put(at + 8, r);
      put(at + 9, g);
      put(at + 10, b);
      put(at + 11, visible ? opacity : 0);
    }
    this.hasTurns = hasTurns && !this.areSprites;
    if (isChanged) this.texture.needsUpdate = true;
  }
}
