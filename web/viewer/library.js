/**
 * The shapes that the page can show: those of a server, or those embedded in the page.
 *
 * @typedef {object} Facts
 * @property {number | null} [segments]
 * @property {number | null} [layers]
 * @property {number | null} [quads]
 * @property {number | null} [curves]
 * @property {number | null} [bytes]
 * @property {number | null} [milliseconds]
 * @property {number | null} [distance]
 * @property {[number, number, number, number] | null} [box] window of the SVG in the unit square
 * @property {string | null} [select] CSS selector of what of the source is shown; null: all
 * @property {Note[]} [notes] what the reader left out, simplified or found invalid, and its remarks
 *
 * @typedef {object} Note
 * @property {'left out' | 'simplified' | 'invalid' | 'remark'} kind
 * @property {string} message
 * @property {number} count
 * @property {Subject[]} elements the first that it is about
 *
 * @typedef {object} Subject
 * @property {string} name
 * @property {[number, number, number, number] | null} box what is drawn of it, in the unit square
 *
 * @typedef {object} Manifest as the server and the exported page write it
 * @property {string} name
 * @property {string} [version]
 * @property {string} texture URL
 * @property {number} [bytes]
 * @property {string} [events] URL
 * @property {Facts} [facts]
 * @property {{svg?: string, converted?: string, thesis16?: [string, string] | Missing, thesis8?: [string, string] | Missing}} [views]
 * @property {string | null} [note]
 *
 * @typedef {{error: string}} Missing why a view is missing
 *
 * @typedef {object} Document
 * @property {string} name
 * @property {Manifest} manifest
 * @property {VectorTexture} texture
 * @property {string} base what the manifest's URLs are relative to
 */
import { listen } from '../src/event-stream.js';
import { LiveVectorTexture } from '../src/live-vector-texture.js';
import { readPacked } from '../src/packed.js';
import { backOff } from '../src/patience.js';
import { VectorTexture } from '../src/vector-texture.js';

/**
 * Bytes of a URL. A data: URL is decoded here, since browsers may refuse to fetch it for a page from disk.
 *
 * @param {string} url
 * @param {string} base
 * @returns {Promise<ArrayBuffer>}
 */
export async function bytesOf(url, base) {
  const embedded = /^data:[^,]*;base64,/.exec(url);
  if (embedded) return Uint8Array.from(atob(url.slice(embedded[0].length)), (letter) => letter.charCodeAt(0)).buffer;
  const response = await fetch(new URL(url, base));
  if (!response.ok) {
    const answer = await response.json().catch(() => ({}));
    throw new Error(answer.error ?? `the server answers ${response.status}`);
  }
  return response.arrayBuffer();
}

/** Shapes by name. Dispatches `names` when the names change; open documents of a server follow it. */
export class Library extends EventTarget {
  /** @type {Map<string, Manifest>} */
  #embedded = new Map();
  /** Opened here: embedded ones and dropped textures. @type {Map<string, Document>} */
  #own = new Map();
  /** @type {string[]} */
  #served = [];
  /** The one that follows the server: browsers allow few connections to one. @type {LiveVectorTexture | null} */
  #live = null;

  /** @param {{server?: string, shapes?: Manifest[]}} scene */
  constructor(scene) {
    super();
    for (const manifest of scene.shapes ?? []) this.#embedded.set(manifest.name, manifest);
    /** URL of the server, if there is one. @type {string | null} */
    this.server = scene.server ? new URL(scene.server, document.baseURI).href : null;
  }

  /** Names of the shapes. */
  get names() {
    return [...new Set([...this.#served, ...this.#embedded.keys(), ...this.#own.keys()])];
  }

  /** Request the server's list of shapes, and listen for changes. */
  async start() {
    if (!this.server) return;
    await this.#ask(this.server);
    this.#listen(this.server);
  }

  /** @param {string} server */
  async #ask(server) {
    this.#setServed(JSON.parse(new TextDecoder().decode(await bytesOf('shapes', server))).shapes);
  }

  /** Listen for new shapes, on the stream shared with the shown one. @param {string} server */
  #listen(server, failures = 0) {
    let failed = failures;
    const leave = listen(new URL('events', server), false, {
      opened: (wasOpen) => {
        failed = 0;
        if (wasOpen) this.#ask(server).catch(() => {}); // the shown shape reports the lost connection
      },
      heard: (kind, data) => {
        const names = this.#served;
        if (kind === 'hello') this.#setServed([...names.filter((name) => name in data.versions), ...Object.keys(data.versions)]);
        else if (kind === 'shape') this.#setServed([...names, data.name]);
        else if (kind === 'gone') this.#setServed(names.filter((name) => name !== data.name));
      },
      failed: () => {
        leave();
        setTimeout(() => this.#listen(server, failed + 1), backOff(failed + 1));
      },
    });
  }

  /** @param {string[]} names */
  #setServed(names) {
    const before = this.#served.join('\n');
    this.#served = [...new Set(names)];
    if (this.#served.join('\n') !== before) this.dispatchEvent(new CustomEvent('names'));
  }

  /**
   * @param {string} name
   * @returns {Promise<Document>}
   */
  async open(name) {
    const own = this.#own.get(name);
    if (own) return own;
    const manifest = this.#embedded.get(name);
    if (!manifest && this.server) return this.#connect(name, this.server);
    if (!manifest) throw new Error(`There is no shape ${name}.`);
    return this.#keep(manifest, await readPacked(await bytesOf(manifest.texture, document.baseURI), name));
  }

  /**
   * Add a texture's file to the shapes.
   *
   * @param {ArrayBuffer} file KTX2
   * @param {string} name
   * @returns {Promise<string>} the name that it got
   */
  async add(file, name) {
    while (this.names.includes(name)) name += ' (dropped)';
    const data = await readPacked(file, name);
    const manifest = { name, texture: '', bytes: file.byteLength, facts: { bytes: file.byteLength }, views: {} };
    this.#keep(manifest, data);
    this.dispatchEvent(new CustomEvent('names'));
    return name;
  }

  /** @param {Manifest} manifest @param {import('../src/data.js').PackedData} data @returns {Document} */
  #keep(manifest, data) {
    const { name } = manifest;
    const opened = { name, manifest, texture: new VectorTexture(data), base: document.baseURI };
    this.#own.set(name, opened);
    return opened;
  }

  /** @param {string} name @param {string} server @returns {Promise<Document>} */
  async #connect(name, server) {
    const base = new URL(`shapes/${encodeURIComponent(name)}`, server).href;
    const texture = await LiveVectorTexture.connect(base);
    this.#live?.close();
    this.#live = texture;
    const manifest = () => /** @type {Manifest} */ (/** @type {unknown} */ (texture.manifest));
    return { name, texture, base, get manifest() { return manifest(); } };
  }

  /**
   * Let the server convert a drawing.
   *
   * @param {File} file
   * @returns {Promise<string>} name of the shape
   */
  async convert(file) {
    if (!this.server) throw new Error('This page has no server: open the file with `vexture view`.');
    const url = new URL('convert', this.server);
    url.searchParams.set('name', file.name);
    const response = await fetch(url, { method: 'POST', body: file });
    const answer = await response.json().catch(() => ({}));
    if (!response.ok) throw new Error(answer.error ?? `the server answers ${response.status}`);
    this.#setServed([...this.#served, answer.name]);
    return answer.name;
  }
}

/** The scene that the page was given. @returns {{server?: string, shapes?: Manifest[]}} */
export function readScene() {
  const text = document.getElementById('vexture-scene')?.textContent ?? '{}';
  return JSON.parse(text);
}
