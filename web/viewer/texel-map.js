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
 * @property {typeof KINDS[number]} kind `other`: of a shape that is not chosen; the last seven are parts of a planar map
 * @property {Place | null} place of a quad, of the leaf that a curve is in, or of the quad that means or bases belong to
 * @property {string[]} words what its four words say
 */
import {
  CELL_BITS,
  CONTROL_OFFSET,
  COORDINATE_BITS,
  COUNT_SHIFT,
  COVERAGE_ONE,
  IS_MEAN,
  KIND_FOLLOWS,
  KIND_SHIFT,
  LATTICE,
  MAP_HEAD,
  MOST_CURVES,
  PAINT_ONE,
  QUAD_FLAG,
  STRAIGHT,
  WINDING_OFFSET,
} from '../generated/layout.js';
import { texelsIn } from '../src/leaf.js';
import { basePaint, headOf, meansAt, paintSteps, quadsInBlock, sidesInTexel, sidesOf } from '../src/planar-map.js';
import { programOf } from '../src/programs.js';
import { counts, isMap } from '../src/walk.js';
import { paintCss } from './overlay-palette.js';

export const UNUSED = 0;
export const OTHER = 1;
export const QUAD = 2;
export const CURVE = 3;
export const HEAD = 4;
export const MEANS = 5;
export const BASES = 6;
export const SIDES = 7;
export const PAINTS = 8;
export const OPERATIONS = 9;
export const STOPS = 10;
const KINDS = /** @type {const} */ (['unused', 'other', 'quad', 'curve', 'head', 'means', 'bases', 'sides', 'paints', 'operations', 'stops']);

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
    /** @type {import('../src/planar-map.js').Head | null} */
    this.head = isMap(data, root) ? headOf(texels, root) : null;
    this.count = Math.min(length, most);
    this.first = Math.min(this.head ? root - MAP_HEAD : root, length - this.count);
    /** What each texel is: UNUSED, OTHER, QUAD, ... Only those that are looked at are told apart. */
    this.kinds = new Uint8Array(length);
    for (let i = this.first; i < this.first + this.count; i++) {
      const used = texels[4 * i] | texels[4 * i + 1] | texels[4 * i + 2] | texels[4 * i + 3];
      this.kinds[i] = used ? OTHER : UNUSED;
    }
    /** @type {Map<number, Place>} */
    this.places = new Map();
    /** Texels of two curves. @type {Set<number>} */
    this.pairs = new Set();
    /** Numbers of curves and quads of a planar map. */
    this.curves = 0;
    this.quads = 0;
    this.#walk(root);
    if (this.head) this.#parts(this.head);
  }

  /** @param {import('../src/planar-map.js').Head} head */
  #parts({ quad: root, used, cells, sides, paints, programs, operations, stops }) {
    const { quads, curves } = counts(this.data, root);
    this.curves = curves;
    this.quads = quads;
    for (let i = 1; i <= MAP_HEAD; i++) this.#set(root - i, HEAD, null);
    for (let i = 0; i < quads; i++) {
      const at = meansAt(/** @type {import('../src/planar-map.js').Head} */ (this.head), root + i);
      this.#set(at, MEANS, this.places.get(root + i) ?? null);
      if (i % quadsInBlock(used) === 0) this.#set(at - 1, BASES, null);
    }
    for (let i = 0; sidesInTexel(used) * i < curves; i++) this.#set(sides + i, SIDES, null);
    for (let i = 0; 2 * i < used; i++) this.#set(paints + i, PAINTS, null);
    for (let i = 0; i < operations + stops; i++) this.#set(programs + i, i < operations ? OPERATIONS : STOPS, null);
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
        else for (let count = texelsIn(byte, this.head !== null); count > 0; count--) {
          this.#set(curve, CURVE, place);
          if (this.head && byte & STRAIGHT && this.kinds[curve] === CURVE) this.pairs.add(curve);
          curve++;
        }
      }
    }
  }

  /** @param {number} index @param {number} kind @param {Place | null} place */
  #set(index, kind, place) {
    if (index < this.first || index >= this.first + this.count) return;
    this.kinds[index] = kind;
    if (place) this.places.set(index, place);
  }

  /**
   * @param {number} index
   * @returns {Texel}
   */
  texel(index) {
    const kind = KINDS[this.kinds[index]];
    const four = [...this.data.texels.subarray(4 * index, 4 * index + 4)];
    return { index, kind, place: this.places.get(index) ?? null, words: this.#words(kind, index, four) };
  }

  /** Words of base paints, all or half of those of a quad. @param {number} index @returns {string[]} */
  #baseWords(index) {
    const { data: { texels }, head, quads } = this;
    if (!head) return [];
    const inBlock = quadsInBlock(head.used);
    const first = inBlock * Math.floor((index - head.cells) / (1 + inBlock));
    return CELL_NAMES.map((_, word) => {
      const place = first + ((word * inBlock) >> 2);
      const cells = Array.from({ length: inBlock }, (_, i) => (word * inBlock + i) & 3);
      const base = (/** @type {number} */ cell) => basePaint(texels, head, head.quad + place, cell);
      return place < quads ? `quad ${head.quad + place}: base paints ${cells.map(base).join(', ')}` : 'of no quad';
    });
  }

  /** @param {Texel['kind']} kind @param {number} index @param {number[]} four @returns {string[]} */
  #words(kind, index, four) {
    const { data: { texels }, head, curves, pairs } = this;
    if (kind === 'quad') return head ? mapQuadWords(four) : quadWords(four);
    if (kind === 'curve') return pairs.has(index) ? pairWords(four) : curveWords(four);
    if (kind === 'means') return four.map((word, k) => `${CELL_NAMES[k]}: mean ${paintCss([0, 1, 2, 3].map((i) => byteOf(word, i) / COVERAGE_ONE))}`);
    if (kind === 'bases') return this.#baseWords(index);
    if (kind === 'head' && head && index < head.quad - 1) {
      return [`programs from texel ${four[0]}`, `${four[1]} texels of operations`, `${four[2]} texels of stops`, '0'];
    }
    if (kind === 'head') {
      const [used, cells, sides, paints] = four;
      return [`${used} paints`, `cells from texel ${cells}`, `sides of curves from texel ${sides}`, `paints from texel ${paints}`];
    }
    if (kind === 'sides' && head) {
      const inWord = sidesInTexel(head.used) / four.length;
      return four.map((_, k) => {
        const first = inWord * (four.length * (index - head.sides) + k);
        const said = Array.from({ length: Math.max(Math.min(inWord, curves - first), 0) }, (_, i) => {
          const [left, right] = sidesOf(texels, head, first + i);
          return `curve ${first + i}: paint ${left} | ${right}`;
        });
        return said.join('; ') || 'of no curve';
      });
    }
    if (kind === 'paints' && head) {
      return [0, 1].flatMap((half) => {
        const number = 2 * (index - head.paints) + half;
        if (number >= head.used) return ['of no paint', 'of no paint'];
        const program = programOf(texels, head, number);
        if (program) return [`paint ${number}, a program from texel ${program.first}`, `paint ${number}: ${program.count} texels`];
        const color = paintCss(paintSteps(texels, head, number).map((part) => part / PAINT_ONE));
        return [`paint ${number}, ${color}: red and green`, `paint ${number}: blue and opacity`];
      });
    }
    if (kind === 'operations') return operationWords(four);
    if (kind === 'stops') return [`stop at ${floatOf(four[0])}`, 'red and green', 'blue and opacity', '0'];
    return rawWords(four);
  }
}

/** @param {number[]} words of a quad of a planar map */
function mapQuadWords([below, first, cells, number]) {
  const what = CELL_NAMES.map((name, cell) => {
    const byte = byteOf(cells, cell);
    const count = byte >> COUNT_SHIFT;
    if (byte === QUAD_FLAG) return `${name} a quad`;
    if (byte === IS_MEAN) return `${name} only its mean`;
    if (!count) return `${name} one paint`;
    return `${name} ${count} ${byte & STRAIGHT ? 'straight ' : ''}curve${count > 1 ? 's' : ''}`;
  });
  return [`first quad below: ${below}`, `first curve: texel ${first}`, what.join('; '), `number of the first curve: ${number}`];
}

/** What the kinds of operations are, from 1 on. */
const OPERATION_NAMES = ['a colour', 'a linear gradient', 'a radial gradient', 'a gradient with a focal circle',
  'begin a group', 'end a group', 'more of a gradient'];

/** @param {number} word that is a 32-bit float */
const floatOf = (word) => String(Number(new Float32Array(Uint32Array.of(word).buffer)[0].toPrecision(5)));

/** @param {number[]} words of a texel of a program */
function operationWords(words) {
  const kind = words[3] >>> KIND_SHIFT;
  const isGradient = (kind > 1 && kind < 5) || kind === KIND_FOLLOWS;
  const numbers = words.slice(0, 3);
  return [...(isGradient ? numbers.map(floatOf) : rawWords(numbers)), OPERATION_NAMES[kind - 1]];
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

/** @param {number[]} words of two straight curves; of the second one 0, if there is none */
function pairWords(words) {
  return words.map((word, k) => {
    if (k > 1 && !words[2] && !words[3]) return 'of no curve';
    return `curve ${k < 2 ? 1 : 2}: P${k % 2 ? 3 : 0} ${pointOf(word & COORDINATE, word >>> COORDINATE_BITS)}`;
  });
}

/** @param {number} x @param {number} y in lattice units */
function pointOf(x, y) {
  return `(${(x / LATTICE).toFixed(4)}, ${(y / LATTICE).toFixed(4)}) of the cell`;
}

/** @param {number[]} words of a curve */
function curveWords(words) {
  return words.map((word, k) => {
    const offset = k === 1 || k === 2 ? CONTROL_OFFSET : 0;
    return `P${k} ${pointOf((word & COORDINATE) - offset, (word >>> COORDINATE_BITS) - offset)}`;
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
