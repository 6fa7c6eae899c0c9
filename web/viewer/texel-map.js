/**
 * What each texel of a packed texture is, and where in the picture; plain data.
 *
 * @typedef {import('../src/data.js').PackedData} PackedData
 *
 * @typedef {object} Place a cell of the unit square
 * @property {number} depth
 * @property {number} x of its lower left corner
 * @property {number} y
 * @property {number} size
 *
 * @typedef {object} Texel
 * @property {number} index
 * @property {'quad' | 'curve' | 'other' | 'unused'} kind `other`: of a shape that is not chosen
 * @property {Place | null} place of a quad, or of the leaf that a curve is in
 * @property {string[]} words what its four words say
 */
import {
  CELL_BITS,
  CONTROL_OFFSET,
  COORDINATE_BITS,
  COUNT_SHIFT,
  COVERAGE_ONE,
  LATTICE,
  MOST_CURVES,
  QUAD_FLAG,
  WINDING_OFFSET,
} from '../generated/layout.js';

export const UNUSED = 0;
export const OTHER = 1;
export const QUAD = 2;
export const CURVE = 3;
const KINDS = /** @type {const} */ (['unused', 'other', 'quad', 'curve']);

const BYTE = (1 << CELL_BITS) - 1;
const WINDING = (1 << COUNT_SHIFT) - 1;
const COORDINATE = (1 << COORDINATE_BITS) - 1;
const CELL_NAMES = ['bottom left', 'bottom right', 'top left', 'top right'];

/** @param {number} word @param {number} cell */
const byteOf = (word, cell) => (word >>> (CELL_BITS * cell)) & BYTE;

/** The texels of one shape of a texture, or a row of them; the others are told apart from those that are not used. */
export class TexelMap {
  /**
   * @param {PackedData} data
   * @param {number} root quad of the shape
   * @param {number} [most] texels that are looked at, from the root on if there are more
   */
  constructor(data, root, most = Infinity) {
    const { texels } = data;
    const length = texels.length / 4;
    this.data = data;
    this.root = root;
    this.count = Math.min(length, most);
    this.first = Math.min(root, length - this.count);
    /** What each texel is: UNUSED, OTHER, QUAD or CURVE. Only those that are looked at are told apart. */
    this.kinds = new Uint8Array(length);
    for (let i = this.first; i < this.first + this.count; i++) {
      const used = texels[4 * i] | texels[4 * i + 1] | texels[4 * i + 2] | texels[4 * i + 3];
      this.kinds[i] = used ? OTHER : UNUSED;
    }
    /** @type {Map<number, Place>} */
    this.places = new Map();
    this.#walk(root);
  }

  /** @param {number} root */
  #walk(root) {
    const { texels } = this.data;
    /** @type {[number, Place][]} */
    const quads = [[root, { depth: 0, x: 0, y: 0, size: 1 }]];
    for (let next = quads.pop(); next; next = quads.pop()) {
      const [quad, at] = next;
      this.#set(quad, QUAD, at);
      let [below, curve] = [texels[4 * quad], texels[4 * quad + 1]];
      const size = at.size / 2;
      for (let cell = 0; cell < 4; cell++) {
        const place = { depth: at.depth + 1, x: at.x + size * (cell & 1), y: at.y + size * (cell >> 1), size };
        const byte = byteOf(texels[4 * quad + 2], cell);
        if (byte === QUAD_FLAG) quads.push([below++, place]);
        else for (let count = byte >> COUNT_SHIFT; count > 0; count--) this.#set(curve++, CURVE, place);
      }
    }
  }

  /** @param {number} index @param {number} kind @param {Place} place */
  #set(index, kind, place) {
    if (index < this.first || index >= this.first + this.count) return;
    this.kinds[index] = kind;
    this.places.set(index, place);
  }

  /**
   * @param {number} index
   * @returns {Texel}
   */
  texel(index) {
    const kind = KINDS[this.kinds[index]];
    const four = [...this.data.texels.subarray(4 * index, 4 * index + 4)];
    const words = kind === 'quad' ? quadWords(four) : kind === 'curve' ? curveWords(four) : rawWords(four);
    return { index, kind, place: this.places.get(index) ?? null, words };
  }
}

/** @param {number[]} words */
function rawWords(words) {
  return words.map((word) => word.toString(16).padStart(8, '0'));
}

/** @param {number[]} words of a quad */
function quadWords([below, first, cells, coverages]) {
  const bytes = [0, 1, 2, 3].map((cell) => byteOf(cells, cell));
  const shares = [0, 1, 2, 3].map((cell) => byteOf(coverages, cell));
  const what = bytes.map((byte, cell) => {
    if (byte === QUAD_FLAG) return `${CELL_NAMES[cell]} a quad`;
    const count = (byte >> COUNT_SHIFT) & MOST_CURVES;
    if (count) return `${CELL_NAMES[cell]} ${count} curve${count > 1 ? 's' : ''}, winding ${(byte & WINDING) - WINDING_OFFSET}`;
    return `${CELL_NAMES[cell]} ${shares[cell] === COVERAGE_ONE ? 'full' : shares[cell] === 0 ? 'empty' : 'constant'}`;
  });
  return [
    bytes.includes(QUAD_FLAG) ? `first quad below: ${below}` : 'no quads below',
    bytes.some((byte) => byte !== QUAD_FLAG && byte >> COUNT_SHIFT) ? `first curve: ${first}` : 'no curves',
    what.join('; '),
    `coverage ${shares.map((share) => (share / COVERAGE_ONE).toFixed(3)).join(', ')}`,
  ];
}

/** @param {number[]} words of a curve */
function curveWords(words) {
  return words.map((word, k) => {
    const offset = k === 1 || k === 2 ? CONTROL_OFFSET : 0;
    const [x, y] = [(word & COORDINATE) - offset, (word >>> COORDINATE_BITS) - offset];
    return `P${k} (${(x / LATTICE).toFixed(4)}, ${(y / LATTICE).toFixed(4)}) of the cell`;
  });
}

/**
 * How rows of texels that are wider than a panel stand in it: each is cut to pieces of `columns`, one below another.
 *
 * @param {number} length number of texels
 * @param {number} columns
 * @returns {{columns: number, rows: number}}
 */
export function folded(length, columns) {
  const width = Math.min(length, columns);
  return { columns: width, rows: Math.ceil(length / width) };
}
