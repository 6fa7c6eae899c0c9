// The geometry of the glyphs of many labels, of which each has a range.
import { Box3 } from 'three';
import { GLYPH } from '../glyph-shader.js';
import { GlyphGeometry } from './glyph-geometry.js';

/** @import { Glyphs } from './glyph-geometry.js' */

/** @typedef {{ first: number, room: number, count: number }} Range */

/** Share of places without a glyph above which all labels are moved together. */
const WASTE = 0.5;

const BOUNDS = new Box3();

/** Places of glyphs, in ranges by label. */
export class LabelGeometry extends GlyphGeometry {
  /** @type {Map<number, Range & Glyphs>} by row of the label */
  #ranges = new Map();
  #used = 0;

  constructor() {
    super({ [GLYPH.label]: 1 });
  }

  /**
   * Show other glyphs of a label.
   *
   * @param {number} row of the label
   * @param {Glyphs} glyphs
   * @param {(shape: number) => [number, number]} boxOf part of its unit square that a shape fills
   */
  setLabel(row, { shapes, places }, boxOf) {
    const count = shapes.length, before = this.#ranges.get(row);
    /** @type {Range | undefined} */
    let range = before;
    if (!before || before.room < count) {
      if (before) this.#hide(before, 0);
      range = count ? this.#allocate(count) : undefined;
    }
    this.#used += count - (before?.count ?? 0);
    if (!range) {
      this.#ranges.delete(row);
      return;
    }
    this.#ranges.set(row, { ...range, count, shapes, places });
    this.#write(row, boxOf);
    this.#hide(range, count);
  }

  /** Move all labels together if many places are without a glyph. @param {(shape: number) => [number, number]} boxOf */
  compact(boxOf) {
    if (this.instanceCount < 1024 || this.#used > (1 - WASTE) * this.instanceCount) return;
    const ranges = [...this.#ranges];
    this.instanceCount = 0;
    for (const [row, { count, shapes, places }] of ranges) {
      this.#ranges.set(row, { ...this.#allocate(count), count, shapes, places });
      this.#write(row, boxOf);
    }
  }

  /** @param {number} count @returns {Range} */
  #allocate(count) {
    const first = this.instanceCount;
    this.makeRoom(first + count, false);
    this.instanceCount = first + count;
    return { first, room: count, count };
  }

  /** @param {number} row @param {(shape: number) => [number, number]} boxOf */
  #write(row, boxOf) {
    const { first, shapes, places } = /** @type {Range & Glyphs} */ (this.#ranges.get(row));
    const count = this.write(first, { shapes, places }, { boxOf, clip: null, colors: null, bend: null, z: 0 }, BOUNDS);
    this.arrayOf(GLYPH.label).fill(row, first, first + count);
    for (const name of [GLYPH.root, GLYPH.place, GLYPH.box, GLYPH.turn, GLYPH.label]) this.send(name, first, count);
  }

  /** Show nothing at places of a range: a box without extent is no rectangle. @param {Range} range @param {number} from */
  #hide({ first, room }, from) {
    if (from >= room) return;
    this.arrayOf(GLYPH.place).fill(0, 4 * (first + from), 4 * (first + room));
    this.send(GLYPH.place, first + from, room - from);
  }
}
