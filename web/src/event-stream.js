// Streams of a server's events, one for all textures of a page: browsers open few connections to one server.
import { parsed } from './json.js';

/**
 * @typedef {object} Listener
 * @property {(wasOpen: boolean) => void} opened the stream has come; if it was open before, what it said then is missed
 * @property {(kind: string, data: any) => void} heard
 * @property {() => void} failed it has ended
 */

/** Kinds of events that servers send. */
const KINDS = Object.freeze(['hello', 'shape', 'gone', 'note']);

/** @type {Map<string, Stream>} */
const STREAMS = new Map();

class Stream {
  /** @type {Set<Listener>} */
  listeners = new Set();
  isOpen = false;
  #source;
  #key;

  /**
   * @param {string} key
   * @param {URL} url
   * @param {boolean} withCredentials
   */
  constructor(key, url, withCredentials) {
    this.#key = key;
    this.#source = new EventSource(url, { withCredentials });
    this.#source.onopen = () => {
      this.isOpen = true;
      for (const listener of this.listeners) listener.opened(false);
    };
    this.#source.onerror = () => {
      this.end(); // its own retries know neither bounds nor that it is polled meanwhile
      for (const listener of this.listeners) listener.failed();
    };
    for (const kind of KINDS) {
      this.#source.addEventListener(kind, (event) => {
        const data = parsed(event.data);
        if (data) for (const listener of this.listeners) listener.heard(kind, data);
      });
    }
  }

  end() {
    this.#source.close();
    if (STREAMS.get(this.#key) === this) STREAMS.delete(this.#key);
  }
}

/** Whether the platform has such streams. */
export const hasStreams = () => typeof EventSource === 'function';

/**
 * Listen to a server.
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
