// A server's event stream (EventSource). Browsers open only six connections to an HTTP/1.1 server, so all textures of a
// page share one stream. A hidden page closes it, and catches up when it is shown again.
import { parsed } from './json.js';

/**
 * @typedef {object} Listener
 * @property {(wasOpen: boolean) => void} opened the stream is open; if it was open before, events may have been missed
 * @property {(kind: string, data: any) => void} heard
 * @property {() => void} failed the stream has ended
 */

/** Event types that a server sends. */
const KINDS = Object.freeze(['hello', 'shape', 'gone', 'note']);

/** @type {Map<string, Stream>} */
const STREAMS = new Map();

class Stream {
  /** @type {Set<Listener>} */
  listeners = new Set();
  isOpen = false;
  #key;
  #url;
  #withCredentials;
  /** @type {EventSource | null} */
  #source = null;
  #look = () => (document.hidden ? this.#close() : this.#open());

  /**
   * @param {string} key
   * @param {URL} url
   * @param {boolean} withCredentials
   */
  constructor(key, url, withCredentials) {
    this.#key = key;
    this.#url = url;
    this.#withCredentials = withCredentials;
    globalThis.document?.addEventListener('visibilitychange', this.#look);
    if (!globalThis.document?.hidden) this.#open();
  }

  #open() {
    if (this.#source) return;
    const source = new EventSource(this.#url, { withCredentials: this.#withCredentials });
    this.#source = source;
    source.onopen = () => {
      this.isOpen = true;
      for (const listener of this.listeners) listener.opened(false);
    };
    source.onerror = () => {
      this.end(); // EventSource itself would retry without limit, although the caller polls meanwhile
      for (const listener of this.listeners) listener.failed();
    };
    for (const kind of KINDS) {
      source.addEventListener(kind, (event) => {
        const data = parsed(event.data);
        if (data) for (const listener of this.listeners) listener.heard(kind, data);
      });
    }
  }

  #close() {
    this.#source?.close();
    this.#source = null;
    this.isOpen = false;
  }

  end() {
    this.#close();
    globalThis.document?.removeEventListener('visibilitychange', this.#look);
    if (STREAMS.get(this.#key) === this) STREAMS.delete(this.#key);
  }
}

/** Whether the platform has EventSource. */
export const hasStreams = () => typeof EventSource === 'function';

/**
 * Listen to the events of a server.
 *
 * @param {URL} url
 * @param {boolean} withCredentials
 * @param {Listener} listener
 * @returns {() => void} ends it
 */
export function listen(url, withCredentials, listener) {
  const key = `${withCredentials} ${url}`;
  const stream = STREAMS.get(key) ?? new Stream(key, url, withCredentials);
  STREAMS.set(key, stream);
  stream.listeners.add(listener);
  if (stream.isOpen) queueMicrotask(() => stream.listeners.has(listener) && listener.opened(true));
  return () => {
    stream.listeners.delete(listener);
    if (stream.listeners.size === 0) stream.end();
  };
}
