// A texture to which shapes are added while it is shown.
import { MOST_ROWS, ROW_BITS } from '../../generated/layout.js';
import { VextureError } from '../errors.js';
import { prepareRows, sendRows } from '../rows.js';
import { wordTexture } from '../upload.js';
import { VectorTexture } from '../vector-texture.js';

/** @import { PackedData, Root } from '../data.js' */
/** @import { TextureMap } from '../vector-texture.js' */

/**
 * @typedef {object} AddedShape A shape that the worker has made.
 * @property {string} key names the font, its variation and the glyph
 * @property {number} quad index of its root quad
 * @property {[number, number]} box part of the unit square, from its lower left corner, that the shape fills
 * @property {boolean} isMap whether it has colours of its own
 * @property {boolean} hasGradients
 *
 * @typedef {object} Added What a message of the worker adds.
 * @property {number} firstShape index of the first shape
 * @property {AddedShape[]} shapes
 * @property {number} first index of the first texel
 * @property {Uint32Array} words four for each texel
 */

/** Texels in a row. */
const WIDTH = 1 << ROW_BITS;

/** Rows and shapes for which there is room at first. */
const ROWS = 16,
  SHAPES = 256;

/** 1 as a fixed-point coordinate of bounds, as in `layers.js`. */
const FIXED_ONE = 65536;

/** Opaque black; a glyph without colours takes that of its material. */
const PAINT = 0xffff0000;

/** @typedef {PackedData & { room: number }} GrowingData `room` is the number of shapes that the layers texture can hold */

/** @returns {GrowingData} */
const emptyData = () => ({
  encoding: 'packed', name: 'glyphs', width: WIDTH, height: ROWS, texels: new Uint32Array(4 * WIDTH * ROWS), roots: [], room: SHAPES,
});

/**
 * The texture of glyphs. Only new rows are sent to the GPU; where the room ends, a larger texture takes its place before
 * the next frame.
 *
 * @extends {VectorTexture<GrowingData>}
 */
export class GrowingTexture extends VectorTexture {
  #end = 0;
  /** Of each shape the part of its unit square that it fills. @type {[number, number][]} */
  boxes = [];

  constructor() {
    super(emptyData());
  }

  /**
   * As a baked font has them.
   *
   * @returns {{ texture: import('../vector-texture.js').AnyVectorTexture, boxes: [number, number][] }}
   */
  get asShapes() {
    return { texture: this, boxes: this.boxes };
  }

  /** Number of texels in use. */
  get length() {
    return this.#end;
  }

  /**
   * Add shapes, whose indices follow those of the others.
   *
   * @param {Added} added
   * @throws {VextureError} if a texture cannot be as large
   */
  append({ shapes, first, words }) {
    if (!shapes.length) return;
    const { roots } = this.data,
      before = roots.length,
      end = first + words.length / 4;
    this.#makeRoom(Math.ceil(end / WIDTH), before + shapes.length);
    this.#end = end;
    const { texels, layers } = this.textures;
    this.data.texels.set(words, 4 * first);
    const rows = /** @type {Uint32Array} */ (layers.image.data);
    for (const shape of shapes) {
      writeRow(rows, roots.length, shape);
      roots.push(rootOf(shape));
      this.boxes.push(shape.box);
    }
    sendRows(texels, Math.floor(first / WIDTH), Math.ceil(end / WIDTH));
    sendRows(layers, before, roots.length);
  }

  /** Forget all shapes, and have others. @param {Added} added */
  restart(added) {
    this.#end = 0;
    this.boxes = [];
    this.replace(emptyData());
    this.append(added);
  }

  /**
   * @param {number} rows
   * @param {number} shapes
   */
  #makeRoom(rows, shapes) {
    if (rows > MOST_ROWS || shapes > MOST_ROWS) {
      throw new VextureError(
        `the texture of glyphs has ${shapes} shapes in ${rows} rows; the limit is ${MOST_ROWS} of both; show fewer characters at once`,
        'text',
      );
    }
    const { data } = this;
    if (rows <= data.height && shapes <= data.room) return;
    const [height, room] = [doubled(data.height, rows), doubled(data.room, shapes)];
    const texels = new Uint32Array(4 * WIDTH * height);
    texels.set(data.texels);
    this.replace({ ...data, height, texels, room });
  }

  /**
   * @param {GrowingData} data
   * @returns {TextureMap}
   */
  upload({ texels, width, height, roots, room }) {
    const rows = new Uint32Array(8 * room);
    if (roots.length) rows.set(/** @type {Uint32Array} */ (this.textures.layers.image.data));
    const layers = wordTexture(rows, 2, room);
    const textures = { texels: wordTexture(texels, width, height), layers };
    Object.values(textures).forEach(prepareRows);
    return textures;
  }
}

/** @param {number} room @param {number} least @returns {number} */
function doubled(room, least) {
  return least <= room ? room : doubled(Math.min(2 * room, MOST_ROWS), least);
}

/**
 * @param {Uint32Array} rows of the layers texture
 * @param {number} place
 * @param {AddedShape} shape
 */
function writeRow(rows, place, { quad, box: [width, height], isMap }) {
  const corner = [Math.ceil(width * FIXED_ONE), Math.ceil(height * FIXED_ONE)];
  rows.set([quad, 0, PAINT, Number(isMap), 0, 0, ...corner], 8 * place);
}

/** @param {AddedShape} shape @returns {Root} */
const rootOf = ({ key, quad, isMap, hasGradients }) => ({
  name: key, quad, transform: [1, 0, 0, 0, 1, 0], tolerance: 0, crs: null, paint: null, isMap, hasGradients, hasPictures: false, style: null,
});
