// Kernels of the conversion, compiled to WebAssembly by tools/build_wasm.py, and calls of them. Works in pages, workers
// and Node.js.
//
// Numba's calling convention: f(result, exception, ...words). A tuple is passed as its parts, an array as words: two of
// memory that the caller owns (0), the number of items, the bytes of one, the address, the shape and the strides. Each
// address takes 8 bytes in memory, of which the lower 4 count.
import { VextureError, line } from '../errors.js';
import { fetchResponse } from '../fetching.js';

/** Name of the section of the module that describes it. */
const SECTION = 'vexture';

/** Bytes of memory that are kept from one call to the next; after a call that took more, memory is given back. */
const KEPT = 1 << 25;

/** Places of an array's words. */
const COUNT = 2,
  DATA = 4,
  SHAPE = 5;

const WORD = 8;

/** Room for the address of an exception, which kernels do not raise. */
const EXCEPTION = 16;

/** Arrays of numbers by the types of NumPy. */
export const ARRAYS = Object.freeze({
  '<f8': Float64Array,
  '<f4': Float32Array,
  '<i8': BigInt64Array,
  '<u8': BigUint64Array,
  '<i4': Int32Array,
  '<u4': Uint32Array,
  '<i2': Int16Array,
  '<u2': Uint16Array,
  '|i1': Int8Array,
  '|u1': Uint8Array,
  '|b1': Uint8Array,
});

/** @typedef {Float64Array | Float32Array | BigInt64Array | BigUint64Array | Int32Array | Uint32Array | Int16Array | Uint16Array | Int8Array | Uint8Array} Numbers */

/**
 * @typedef {object} Value An argument, or a part of a result.
 * @property {string} name
 * @property {'int' | 'float' | 'bool' | [keyof typeof ARRAYS, number, boolean] | null} [type] of a number, or of an
 *   array: type of its items, dimensions, whether it can be written
 * @property {(number | null)[]} [shape] of an array; null where it may have any length
 * @property {Value[]} [parts] of a tuple
 */

/**
 * @typedef {object} Entry
 * @property {Value[]} arguments
 * @property {Value[]} result
 */

/**
 * @typedef {object} Description
 * @property {string} digest of the kernels' text, as the compiled kernels of Python have it
 * @property {Record<string, number>} constants
 * @property {Record<string, Entry>} entries
 */

/**
 * @typedef {object} Shaped An array of several dimensions, of which more than the first may vary.
 * @property {ArrayLike<number | bigint>} values
 * @property {number[]} shape
 */

/** @typedef {BufferSource | Response | URL | string} Source */

export class Kernels {
  /** @type {WebAssembly.Module} */
  #module;

  /** @type {any} */
  #exports;

  /** @param {WebAssembly.Module} module */
  constructor(module) {
    const [section] = WebAssembly.Module.customSections(module, SECTION);
    if (!section)
      throw new VextureError(
        'the WebAssembly holds no kernels of vexture; give a module of the package',
        'kernels',
      );
    /** @type {Description} */
    const { digest, constants, entries } = JSON.parse(new TextDecoder().decode(section));
    /** Digest of the text of the kernels. */
    this.digest = digest;
    /** Numbers that callers need, such as the default tolerance. */
    this.constants = Object.freeze(constants);
    /** What can be called. */
    this.entries = entries;
    this.#module = module;
    this.#exports = new WebAssembly.Instance(module).exports;
  }

  /**
   * Load a module of kernels from bytes, a response or an address.
   *
   * @param {Source | Promise<Source>} source
   * @param {{ signal?: AbortSignal }} [options]
   * @returns {Promise<Kernels>}
   */
  static async load(source, { signal = new AbortController().signal } = {}) {
    if (typeof WebAssembly !== 'object') {
      throw new VextureError('this browser has no WebAssembly; convert the drawing with the Python program', 'kernels');
    }
    const given = await source;
    const bytes = typeof given === 'string' || given instanceof URL ? await read(given, signal) : given;
    try {
      return new Kernels(await compile(bytes));
    } catch (error) {
      throw error instanceof VextureError ? error : refused(error);
    }
  }

  /** Bytes of memory that the kernels hold between calls. */
  get bytes() {
    return /** @type {number} */ (this.#exports.memory.buffer.byteLength);
  }

  /**
   * Call a kernel. The results are copies, arrays without their shape.
   *
   * @param {string} name of an entry
   * @param {readonly unknown[]} given values of its arguments: numbers, booleans, arrays of numbers, objects or lists for
   *   tuples; `Shaped` where an array has more than one length that may vary
   * @returns {any} parts of the result by name
   * @throws {VextureError} if an argument has another type, or memory is exhausted
   */
  call(name, given) {
    const entry = this.entries[name];
    if (!entry)
      throw new VextureError(
        `no kernel is named ${line(name)}; there are ${Object.keys(this.entries).join(', ')}`,
        name,
      );
    if (given.length !== entry.arguments.length) {
      throw new VextureError(`${name} has ${entry.arguments.length} arguments, not ${given.length}`, name);
    }
    const { reset, malloc, memory } = this.#exports;
    reset();
    const room = (/** @type {number} */ bytes) => {
      const address = malloc(BigInt(bytes)) >>> 0;
      if (address === 0) throw exhausted(name);
      return address;
    };
    const size = sizeOf(entry.result),
      result = room(size + EXCEPTION);
    new Uint8Array(memory.buffer, result, size + EXCEPTION).fill(0);
    /** @type {(number | bigint)[]} */
    const words = [];
    entry.arguments.forEach((value, place) =>
      pass(value, given[place], { words, room, memory, path: `${name}: ${value.name}` }),
    );
    const status = this.#run(name, result, result + size, words);
    if (status !== 0) throw exhausted(name);
    const found = readParts(entry.result, new DataView(memory.buffer), result);
    if (memory.buffer.byteLength > KEPT) this.#giveBack();
    return found;
  }

  /**
   * @param {string} name
   * @param {number} result
   * @param {number} exception
   * @param {(number | bigint)[]} words
   * @returns {number}
   */
  #run(name, result, exception, words) {
    try {
      return this.#exports[name](result, exception, ...words);
    } catch (error) {
      this.#giveBack();
      throw new VextureError(`${name} stopped (${line(error)}); please report the drawing`, name, { cause: error });
    }
  }

  /** Replace the instance by a new one, whose memory is small; memory of WebAssembly never shrinks. */
  #giveBack() {
    try {
      this.#exports = new WebAssembly.Instance(this.#module).exports;
    } catch {
      // some browsers make no instance at once in a page, only in a worker; the old one still works
    }
  }
}

/** @param {string} name */
const exhausted = (name) =>
  new VextureError(`${name} found no memory; convert a simpler drawing, or close other pages`, name);

/**
 * @param {URL | string} address
 * @param {AbortSignal} signal
 * @returns {Promise<BufferSource | Response>}
 */
async function read(address, signal) {
  const url = String(address);
  if (!url.startsWith('file:') || !('process' in globalThis)) return fetchResponse(url, { signal });
  const files = 'node:fs/promises'; // a name that bundlers of pages leave alone
  const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ files);
  try {
    return await readFile(new URL(url), { signal });
  } catch (error) {
    throw new VextureError(
      `${url}: ${line(error)}; build it with tools/build_wasm.py, or give its address`,
      'kernels',
      { cause: error },
    );
  }
}

/**
 * @param {BufferSource | Response} source
 * @returns {Promise<WebAssembly.Module>}
 */
async function compile(source) {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  const streams = source.headers.get('Content-Type')?.startsWith('application/wasm'); // other types are refused
  return streams ? WebAssembly.compileStreaming(source) : WebAssembly.compile(await source.arrayBuffer());
}

/** @param {unknown} error */
function refused(error) {
  const about = line(error),
    remedy = /unsafe-eval|CSP|Content.Security/i.test(String(error))
      ? "allow it by the policy script-src 'wasm-unsafe-eval'"
      : 'give a module of the package';
  return new VextureError(`kernels cannot be compiled (${about}); ${remedy}`, 'kernels', { cause: error });
}

/**
 * @typedef {object} Call
 * @property {(number | bigint)[]} words
 * @property {(bytes: number) => number} room
 * @property {WebAssembly.Memory} memory
 * @property {string} path names the argument in messages
 */

/**
 * Append the words of an argument.
 *
 * @param {Value} value
 * @param {any} given
 * @param {Call} call
 */
function pass(value, given, call) {
  const { words, path } = call;
  const wrong = (/** @type {string} */ wanted) =>
    new VextureError(`${path} is ${line(given)}; it must be ${wanted}`, value.name);
  if (value.parts) {
    if (given === null || typeof given !== 'object')
      throw wrong(`an object of ${value.parts.map((part) => part.name).join(', ')}`);
    value.parts.forEach((part, place) => {
      pass(part, Array.isArray(given) ? given[place] : given[part.name], { ...call, path: `${path}.${part.name}` });
    });
  } else if (value.type === 'int') {
    if (typeof given !== 'bigint' && !Number.isInteger(given)) throw wrong('a whole number');
    words.push(BigInt(given));
  } else if (value.type === 'float') {
    if (typeof given !== 'number') throw wrong('a number');
    words.push(given);
  } else if (value.type === 'bool') {
    words.push(given ? 1 : 0);
  } else if (value.type) {
    passArray(value, given, call, wrong);
  }
}

/**
 * @param {Value} value
 * @param {any} given
 * @param {Call} call
 * @param {(wanted: string) => VextureError} wrong
 */
function passArray(value, given, { words, room, memory }, wrong) {
  const [dtype, dimensions] = /** @type {[keyof typeof ARRAYS, number, boolean]} */ (value.type);
  const values = Array.isArray(given) || ArrayBuffer.isView(given) ? /** @type {any} */ (given) : given?.values;
  if (!(values?.length >= 0)) throw wrong(`an array of ${dtype}`);
  const Numbers = ARRAYS[dtype],
    bytes = Numbers.BYTES_PER_ELEMENT;
  const inner = (value.shape ?? []).slice(1).reduce((/** @type {number} */ a, b) => a * (b ?? 1), 1);
  const shape = given.shape ?? [values.length / inner, ...(value.shape ?? []).slice(1)];
  const isWhole =
    shape.length === dimensions && shape.every((/** @type {unknown} */ length) => Number.isInteger(length));
  if (!isWhole || shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, 1) !== values.length) {
    throw wrong(`an array of the shape ${value.shape?.map((length) => length ?? 'any').join(' x ')}`);
  }
  const address = room(values.length * bytes);
  const buffer = /** @type {ArrayBuffer} */ (memory.buffer);
  const target = new Numbers(buffer, address, values.length);
  if (typeof values[0] === 'number' && (target instanceof BigInt64Array || target instanceof BigUint64Array)) {
    for (let place = 0; place < values.length; place++) target[place] = BigInt(values[place]);
  } else {
    target.set(values);
  }
  const strides = shape.map((/** @type {number} */ _, /** @type {number} */ place) =>
    shape.slice(place + 1).reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, bytes),
  );
  words.push(0, 0, BigInt(values.length), BigInt(bytes), address, ...shape.map(BigInt), ...strides.map(BigInt));
}

/**
 * Bytes of a value in memory; all but booleans begin at multiples of a word.
 *
 * @param {Value[]} parts
 * @returns {number}
 */
function sizeOf(parts) {
  const end = parts.reduce((at, part) => placeOf(part, at) + lengthOf(part), 0);
  return aligned(end);
}

/** @param {number} at */
const aligned = (at) => Math.ceil(at / WORD) * WORD;

/** @param {Value} part @param {number} at */
const placeOf = (part, at) => (part.type === 'bool' ? at : aligned(at));

/** @param {Value} part */
const lengthOf = (part) =>
  part.parts
    ? sizeOf(part.parts)
    : part.type === 'bool'
      ? 1
      : Array.isArray(part.type)
        ? WORD * (SHAPE + 2 * part.type[1])
        : WORD;

/**
 * @param {Value[]} parts
 * @param {DataView} view
 * @param {number} start
 * @returns {Record<string, any>}
 */
function readParts(parts, view, start) {
  let at = start;
  return Object.fromEntries(
    parts.map((part) => {
      at = placeOf(part, at);
      const found = readValue(part, view, at);
      at += lengthOf(part);
      return [part.name, found];
    }),
  );
}

/**
 * @param {Value} part
 * @param {DataView} view
 * @param {number} at
 */
function readValue(part, view, at) {
  if (part.parts) return readParts(part.parts, view, at);
  if (part.type === 'int') return Number(view.getBigInt64(at, true));
  if (part.type === 'float') return view.getFloat64(at, true);
  if (part.type === 'bool') return view.getUint8(at) !== 0;
  if (!part.type) return null;
  const count = Number(view.getBigInt64(at + WORD * COUNT, true)),
    address = view.getUint32(at + WORD * DATA, true);
  return new ARRAYS[part.type[0]](/** @type {ArrayBuffer} */ (view.buffer), address, count).slice();
}
