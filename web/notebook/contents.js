/** Textures of the page's stages: each content is read once, and those whose colours are its own share one texture. */
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';

/**
 * @typedef {import('../src/data.js').PackedData} PackedData
 * @typedef {[number, number, number, number]} Color sRGB and opacity, 0..1
 * @typedef {Record<string, Color>} Colors of elements, or of shapes that are no maps, by their names
 * @typedef {{ data: PackedData, texture: VectorTexture }} Content
 * @typedef {{ users: number, content: Promise<Content> }} Entry
 */

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
  /** Names of what is coloured as a shape. @type {Set<string>} */
  #shapes = new Set();

  /**
   * @param {PackedData} data
   * @param {{ first: number, count: number }} range of the drawing's roots
   * @param {Colors} colors
   * @param {import('../src/select-root.js').RootChoice} root that chooses the drawing
   */
  constructor(data, { first, count }, colors, root) {
    this.#root = root;
    this.#colors = colors;
    const roots = structuredClone(data.roots); // those of one style share it again
    for (const one of roots.slice(first, first + count)) {
      const color = one.isMap ? undefined : colors[one.name];
      if (!color) continue;
      const [red, green, blue, opacity] = color;
      one.paint = { color: [red, green, blue], opacity };
      this.#shapes.add(one.name);
    }
    this.texture = new VectorTexture({ ...data, texels: data.texels.slice(), roots });
    this.#paint(Object.entries(colors));
  }

  /** @param {[string, Color][]} colors */
  #paint(colors) {
    const elements = new Map(colors.filter(([name]) => !this.#shapes.has(name)));
    if (elements.size) this.texture.setPaints(elements, this.#root);
  }

  /**
   * Change the colours, if that costs less than another texture: nothing has its first colour again, and no shape another.
   *
   * @param {Colors} colors
   * @param {import('../src/select-root.js').RootChoice} root
   * @returns {boolean} whether it is done
   */
  recolor(colors, root) {
    const before = this.#colors;
    const isMore = Object.keys(before).every((name) => name in colors);
    if (root !== this.#root || this.#shapes.size || !isMore) return false;
    this.#paint(Object.entries(colors).filter(([name, color]) => String(color) !== String(before[name])));
    this.#colors = colors;
    return true;
  }
}
