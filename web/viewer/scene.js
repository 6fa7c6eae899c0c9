/**
 * What the page shows: shapes of a server, or those embedded in the page itself.
 *
 * @typedef {object} Facts
 * @property {number | null} [segments]
 * @property {number | null} [layers]
 * @property {number | null} [quads]
 * @property {number | null} [curves]
 * @property {number | null} [bytes]
 * @property {number | null} [milliseconds]
 * @property {number | null} [distance]
 * @property {string[]} [warnings]
 *
 * @typedef {object} Manifest as the server and the exported page write it
 * @property {string} name
 * @property {string} [version]
 * @property {string} texture URL
 * @property {number} [bytes]
 * @property {string} [events] URL
 * @property {Facts} [facts]
 * @property {{svg?: string | Missing, thesis16?: [string, string] | Missing, thesis8?: [string, string] | Missing}} [views]
 * @property {string | null} [note]
 *
 * @typedef {{error: string}} Missing why a view is not there
 *
 * @typedef {object} Document
 * @property {string} name
 * @property {Manifest} manifest
 * @property {VectorTexture} texture
 * @property {string} base what the manifest's URLs are relative to
 */
import { readPacked } from '../src/packed.js';
import { VectorTexture } from '../src/vector-texture.js';

/**
 * Bytes behind a URL. A data: URL is decoded here: a page from disk may not be allowed to fetch it.
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

/** Shapes that were written into the page, and those that were dropped on it. */
export class Library extends EventTarget {
  /** @type {Map<string, Manifest>} */
  #embedded = new Map();
  /** @type {Map<string, Document>} */
  #open = new Map();

  /** @param {{server?: string, shapes?: Manifest[]}} scene */
  constructor(scene) {
    super();
    for (const manifest of scene.shapes ?? []) this.#embedded.set(manifest.name, manifest);
    /** URL of the server, if there is one. @type {string | null} */
    this.server = scene.server ? new URL(scene.server, document.baseURI).href : null;
  }

  /** Names of the shapes. */
  get names() {
    return [...new Set([...this.#embedded.keys(), ...this.#open.keys()])];
  }

  /**
   * @param {string} name
   * @returns {Promise<Document>}
   */
  async open(name) {
    const open = this.#open.get(name);
    if (open) return open;
    const manifest = this.#embedded.get(name);
    if (!manifest) throw new Error(`there is no shape ${name}; choose another one`);
    const base = document.baseURI;
    const data = await readPacked(await bytesOf(manifest.texture, base), name);
    const opened = { name, manifest, texture: new VectorTexture(data), base };
    this.#open.set(name, opened);
    return opened;
  }
}

/** The scene that the page was given. @returns {{server?: string, shapes?: Manifest[]}} */
export function readScene() {
  const text = document.getElementById('vexture-scene')?.textContent ?? '{}';
  return JSON.parse(text);
}
