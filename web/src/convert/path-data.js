// Path data of SVG (SVG 2, 9.3), read command by command up to the first error.
import { arcCubics } from './arcs.js';

/** @typedef {import('./contours.js').Outline} Outline */
/** @typedef {import('./arcs.js').Point} Point */

const FIRST = /[ \t\n\r\f]*([+-]?(?:\d*\.\d+|\d+)(?:[eE][+-]?\d+)?)/y;
const NEXT = /[ \t\n\r\f]*,?[ \t\n\r\f]*([+-]?(?:\d*\.\d+|\d+)(?:[eE][+-]?\d+)?)/y;
const FLAG = /[ \t\n\r\f]*,?[ \t\n\r\f]*([01])/y;
const SPACES = /[ \t\n\r\f]*/y;

/**
 * Arguments after the letter of each command: n for a number, f for a flag.
 *
 * @type {Readonly<Record<string, string>>}
 */
const ARGUMENTS = { M: 'nn', L: 'nn', T: 'nn', H: 'n', V: 'n', C: 'nnnnnn', S: 'nnnn', Q: 'nnnn', A: 'nnnffnn', Z: '' };

/** Limit beyond which numbers, and inverse radii, overflow in the arithmetic of an arc, which becomes a line. */
const HUGE = 1e100;

/** @param {RegExp} pattern sticky @param {string} text @param {number} at @returns {RegExpExecArray | null} */
function matchAt(pattern, text, at) {
  pattern.lastIndex = at;
  return pattern.exec(text);
}

/** @param {string} text @param {number} at @returns {number} the place after white space */
const afterSpace = (text, at) => at + (matchAt(SPACES, text, at)?.[0].length ?? 0);

/**
 * Read sets of arguments as long as they are complete.
 *
 * @param {string} form as in `ARGUMENTS`
 * @param {string} text
 * @param {number} at
 * @returns {{ sets: number[][], end: number }}
 */
export function readSets(form, text, at) {
  const sets = [];
  let end = at;
  for (let isFirst = true; ; isFirst = false) {
    const values = [];
    let place = end;
    for (const kind of form) {
      const pattern = kind === 'f' ? FLAG : isFirst && !values.length ? FIRST : NEXT;
      const match = matchAt(pattern, text, place);
      if (!match) return { sets, end };
      values.push(Number(match[1]));
      place += match[0].length;
    }
    sets.push(values);
    end = place;
  }
}

/**
 * Outlines of path data up to the first error, and the number of valid characters.
 *
 * @param {string} data
 * @param {number} tolerance largest distance of a cubic from its arc
 */
export function pathOutlines(data, tolerance) {
  const pen = new PathPen(tolerance);
  const valid = pen.follow(data);
  return { outlines: pen.outlines, valid };
}

/** Pen that draws commands as cubics. */
export class PathPen {
  /** @param {number} tolerance */
  constructor(tolerance) {
    this.tolerance = tolerance;
    /** @type {Outline[]} */
    this.outlines = [];
    /** @type {number[]} */
    this.cubics = [];
    /** @type {Point} */
    this.at = [0, 0];
    /** @type {Point} */
    this.start = [0, 0];
    /** @type {Point} */
    this.control = [0, 0];
    /** Kind of the last segment, as S and T mirror its control point. */
    this.bend = '';
    this.down = false;
  }

  /** Draw path data up to the first error; return the number of valid characters. @param {string} data */
  follow(data) {
    let at = afterSpace(data, 0);
    let possible = 'Mm';
    while (at < data.length && possible.includes(data[at])) {
      const letter = data[at];
      const form = ARGUMENTS[letter.toUpperCase()];
      const { sets, end } = form ? readSets(form, data, at + 1) : { sets: [], end: at + 1 };
      if (form && !sets.length) break;
      this.draw(letter, sets);
      at = afterSpace(data, end);
      possible = 'MmLlTtHhVvCcSsQqAaZz';
    }
    this.finish(false);
    return at;
  }

  /** Draw a command with all its arguments. @param {string} letter @param {number[][]} sets */
  draw(letter, sets) {
    let command = letter.toUpperCase();
    if (command === 'Z') return this.close();
    if (command === 'M') this.finish(false);
    this.down = true;
    const isRelative = letter !== command;
    for (const values of sets) {
      const [dx, dy] = isRelative ? this.at : [0, 0];
      if (command === 'M') {
        this.at = this.start = [dx + values[0], dy + values[1]];
        [this.bend, command] = ['', 'L']; // further pairs are lines
      } else this.segment(command, values, dx, dy);
    }
  }

  /** @param {string} command @param {number[]} v @param {number} dx @param {number} dy */
  segment(command, v, dx, dy) {
    switch (command) {
      case 'L': return this.lineTo([dx + v[0], dy + v[1]]);
      case 'H': return this.lineTo([dx + v[0], this.at[1]]);
      case 'V': return this.lineTo([this.at[0], dy + v[0]]);
      case 'C': return this.cubicTo([dx + v[0], dy + v[1]], [dx + v[2], dy + v[3]], [dx + v[4], dy + v[5]]);
      case 'S': return this.cubicTo(this.mirrored('cubic'), [dx + v[0], dy + v[1]], [dx + v[2], dy + v[3]]);
      case 'Q': return this.quadraticTo([dx + v[0], dy + v[1]], [dx + v[2], dy + v[3]]);
      case 'T': return this.quadraticTo(this.mirrored('quadratic'), [dx + v[0], dy + v[1]]);
      default: return this.arcTo(v[0], v[1], v[2], v[3] === 1, v[4] === 1, [dx + v[5], dy + v[6]]);
    }
  }

  /** @param {Point} end */
  lineTo(end) {
    const [x0, y0] = this.at;
    const [x3, y3] = end;
    const [dx, dy] = [x3 - x0, y3 - y0];
    const [third, rest] = [1 / 3, 2 / 3];
    this.cubics.push(x0, y0, x0 + dx * third, y0 + dy * third, x0 + dx * rest, y0 + dy * rest, x3, y3);
    [this.at, this.bend] = [end, ''];
  }

  /** @param {string} bend @returns {Point} the last control point, mirrored, if that was of the same kind */
  mirrored(bend) {
    const [x, y] = this.at;
    return this.bend === bend ? [x + x - this.control[0], y + y - this.control[1]] : this.at;
  }

  /** @param {Point} first @param {Point} second @param {Point} end */
  cubicTo(first, second, end) {
    this.cubics.push(...this.at, ...first, ...second, ...end);
    [this.at, this.control, this.bend] = [end, second, 'cubic'];
  }

  /** @param {Point} control @param {Point} end */
  quadraticTo(control, end) {
    const [x0, y0] = this.at;
    const [x, y] = control;
    const [x3, y3] = end;
    const k = 2 / 3;
    this.cubics.push(x0, y0, x0 + (x - x0) * k, y0 + (y - y0) * k, x3 + (x - x3) * k, y3 + (y - y3) * k, x3, y3);
    [this.at, this.control, this.bend] = [end, control, 'quadratic'];
  }

  /**
   * @param {number} rx
   * @param {number} ry
   * @param {number} rotation
   * @param {boolean} large
   * @param {boolean} sweep
   * @param {Point} end
   */
  arcTo(rx, ry, rotation, large, sweep, end) {
    const larger = Math.max(Math.abs(rx), Math.abs(ry));
    let [a, b] = [rx, ry];
    if (larger > 0 && larger < 1 / HUGE) { // too small to join the points: only their ratio counts
      const small = Math.hypot(end[0] - this.at[0], end[1] - this.at[1]) / 8;
      [a, b] = [(rx / larger) * small, (ry / larger) * small];
    }
    const largest = Math.max(...[a, b, rotation, ...this.at, ...end].map(Math.abs));
    if (!(largest <= HUGE && Math.min(Math.abs(a), Math.abs(b)) >= 1 / HUGE)) return this.lineTo(end);
    for (const step of arcCubics(this.at, [a, b], rotation, large, sweep, end, this.tolerance)) {
      this.cubics.push(...this.at, ...step);
      this.at = [step[4], step[5]];
    }
    [this.at, this.bend] = [end, ''];
  }

  /** Whether the pen is back at the start, except for rounding. */
  get isBack() {
    const gap = Math.hypot(this.at[0] - this.start[0], this.at[1] - this.start[1]);
    return gap <= 1e-15 * Math.max(Math.hypot(...this.at), Math.hypot(...this.start), 1);
  }

  /** Close the outline, unless nothing has been drawn since the last close. */
  close() {
    if (!this.down) return;
    if (!this.isBack) this.lineTo(this.start);
    this.finish(true);
    [this.at, this.bend, this.down] = [this.start, '', false];
  }

  /** Store the outline; a closed point is a cubic of zero length. @param {boolean} closed */
  finish(closed) {
    if (closed && !this.cubics.length) this.cubics.push(...this.at, ...this.at, ...this.at, ...this.at);
    if (this.cubics.length) this.outlines.push({ cubics: Float64Array.from(this.cubics), closed });
    this.cubics = [];
  }
}
