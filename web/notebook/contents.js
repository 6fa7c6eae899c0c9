/** Textures of the page's stages: each content is read once, and those whose colours are its own share one texture. */
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';

/**
 * @typedef {import('../src/data.js').PackedData} PackedData
 * @typedef {[number, number, number, number]} Color sRGB and opacity, 0..1
 * @typedef {Record<string, Color>} Colors of elements, or of shapes that are no maps, by their names
 * @typedef {Map<string, Color>} Coloring of all elements, by their names
 * @typedef {{ data: PackedData, texture: VectorTexture }} Content
 * @typedef {{ users: number, content: Promise<Content> }} Entry
 */

/** What 1 of a colour is, as it is sent. */
const COLOR_ONE = 10_000;

/** @type {Map<string, Entry>} */
const ENTRIES = new Map();

/** @param {import('./widget.js').Shared} source @returns {Promise<Content>} */
export function open({ key, content }) {
  const entry = ENTRIES.get(key) ?? { users: 0, content: read(content) };
  entry.users++;
  ENTRIES.set(key, entry);
  return entry.content;
}

/** @param {DataView | ArrayBuffer} content @returns {Promise<Content>} */
async function read(content) {
  const view = content instanceof ArrayBuffer ? new DataView(content) : content;
  const data = await readPacked(new Uint8Array(view.buffer, view.byteOffset, view.byteLength));
  return { data, texture: new VectorTexture(data) };
}

/** Forget a content that was opened, with its last user. @param {import('./widget.js').Shared} source */
export function release({ key }) {
  const entry = ENTRIES.get(key);
  if (!entry || --entry.users > 0) return;
  ENTRIES.delete(key);
  void entry.content.then(({ texture }) => texture.dispose(), () => {});
}

/** A texture with other colours of some elements and shapes. */
export class Colored {
  #root;
  #colors;
  #coloring;
  /** Names of what is coloured as a shape. @type {Set<string>} */
  #shapes = new Set();

  /**
   * @param {PackedData} data
   * @param {{ first: number, count: number }} range of the drawing's roots
   * @param {Colors} colors
   * @param {Coloring | null} coloring of all elements, below those colours
   * @param {import('../src/select-root.js').RootChoice} root that chooses the drawing
   */
  constructor(data, { first, count }, colors, coloring, root) {
    this.#root = root;
    this.#colors = colors;
    this.#coloring = coloring;
    const roots = structuredClone(data.roots); // those of one style share it again
    for (const one of roots.slice(first, first + count)) {
      const color = one.isMap ? undefined : colors[one.name];
      if (!color) continue;
      const [red, green, blue, opacity] = color;
      one.paint = { color: [red, green, blue], opacity };
      this.#shapes.add(one.name);
    }
    this.texture = new VectorTexture({ ...data, texels: data.texels.slice(), roots });
    const named = Object.entries(colors).filter(([name]) => !this.#shapes.has(name));
    this.#paint(new Map([...(coloring ?? []), ...named]));
  }

  /** @param {Map<string, Color | 'own'>} paints */
  #paint(paints) {
    if (paints.size) this.texture.setPaints(paints, this.#root);
  }

  /**
   * Change the colours, if that costs less than another texture: no shape has one.
   *
   * @param {Colors} colors
   * @param {Coloring | null} coloring
   * @param {import('../src/select-root.js').RootChoice} root
   * @returns {boolean} whether it is done
   */
  recolor(colors, coloring, root) {
    const before = this.#colors;
    if (root !== this.#root || this.#shapes.size) return false;
    const isNew = coloring !== this.#coloring;
    /** @type {Map<string, Color | 'own'>} */
    const paints = new Map();
    if (isNew) {
      const known = this.#coloring;
      for (const [name, color] of coloring ?? []) if (color !== known?.get(name)) paints.set(name, color);
    }
    for (const name of Object.keys(before)) if (!(name in colors)) paints.set(name, coloring?.get(name) ?? 'own');
    for (const [name, color] of Object.entries(colors)) {
      if (paints.has(name) || String(color) !== String(before[name])) paints.set(name, color);
    }
    this.#paint(paints);
    this.#colors = colors;
    this.#coloring = coloring;
    return true;
  }
}

/**
 * Colours of all elements, as a kernel sends them.
 *
 * @param {import('../src/style.js').Style} style
 * @param {{ colors: DataView, places: DataView }} sent the colours, and for each element the place of its own
 * @returns {Coloring}
 */
export function coloringOf(style, sent) {
  return new Steps(style, sent, 1).at(0);
}

/** Colours of all elements at each step of time. */
export class Steps {
  #elements;
  #count;
  /** @type {(place: number) => Color} of all elements, step after step */
  #color;

  /**
   * @param {import('../src/style.js').Style} style
   * @param {{ colors: DataView, places: DataView }} sent the colours, and for each step and element the place of its own
   * @param {number} count of the steps
   */
  constructor({ elements }, { colors, places }, count) {
    const bytes = places.byteLength / (elements.length * count);
    const read = bytes === 1 ? places.getUint8 : bytes === 2 ? places.getUint16 : places.getUint32;
    const parts = [0, 1, 2, 3];
    const known = Array.from({ length: colors.byteLength / 8 }, (_, place) =>
      /** @type {Color} */ (parts.map((part) => colors.getUint16(8 * place + 2 * part, true) / COLOR_ONE)));
    this.#elements = elements;
    this.#count = count;
    this.#color = (place) => known[read.call(places, bytes * place, true)];
  }

  /** @param {number} time in steps; between two of them colours are mixed @returns {Coloring} */
  at(time) {
    const held = Math.min(Math.max(time, 0), this.#count - 1);
    const first = Math.floor(held);
    const share = held - first;
    const size = this.#elements.length;
    /** @type {(number: number) => Color} */
    const color = (number) => {
      const one = this.#color(first * size + number);
      if (share === 0) return one;
      const other = this.#color((first + 1) * size + number);
      return one === other ? one : /** @type {Color} */ (one.map((part, k) => part + share * (other[k] - part)));
    };
    return new Map(this.#elements.map(({ name }, number) => [name, color(number)]));
  }
}

/** @param {DataView} content a stream of zlib @returns {Promise<DataView>} */
export async function inflatedView(content) {
  const bytes = /** @type {Uint8Array<ArrayBuffer>} */ (new Uint8Array(content.buffer, content.byteOffset, content.byteLength));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new DataView(await new Response(stream).arrayBuffer());
}
