import { givenOptions } from './errors.js';
import { isTransport } from './fetching.js';
import { Source } from './live-source.js';
import { backOff, sleep } from './patience.js';
import { VectorTextureLoader } from './vector-texture-loader.js';
import { VectorTexture } from './vector-texture.js';

/**
 * @typedef {object} LiveOptions How a texture follows a server.
 * @property {VectorTextureLoader} [loader] a custom loader, for headers and credentials
 * @property {boolean} [events] whether to use the server's event stream, by default `true`; without it the server is polled
 * @property {number} [interval] milliseconds between two polls, by default 2000
 */

const INTERVAL = 2000;
/** Time limit for opening the event stream, in milliseconds; some proxies hold a response back until it ends. */
const OPENING = 10000;

/**
 * A texture that follows a server. An update replaces all data at once. After an error the last valid data remain.
 *
 * Events: `change` (new data, or a new manifest of the same data), `note` (reason why an update is not shown), `offline`,
 * `online`.
 */
export class LiveVectorTexture extends VectorTexture {
  #source;
  #manifest;
  #closing = new AbortController();
  #online = true;
  /** @type {string | null} */
  #note = null;
  /** Whether the note came by the event stream; a later manifest may lack it. */
  #heard = false;
  /** @type {Promise<void> | null} */
  #refreshing = null;
  #again = false;

  /**
   * Connect to a server; resolves once the first data are loaded.
   *
   * @param {string} manifestUrl such as `https://example.org/shapes/duck`
   * @param {LiveOptions} [options]
   * @returns {Promise<LiveVectorTexture>}
   * @throws {VextureError} if the server cannot be reached, or has no such shape
   */
  static async connect(manifestUrl, options) {
    const { loader = new VectorTextureLoader(), events = true, interval = INTERVAL } = givenOptions(options);
    const source = new Source(manifestUrl, loader);
    const signal = new AbortController().signal;
    await source.look(signal);
    const texture = new LiveVectorTexture(await source.load(signal), source);
    texture.#follow(events, Math.max(1, interval));
    return texture;
  }

  /**
   * Use `LiveVectorTexture.connect`.
   *
   * @internal
   * @param {import('./data.js').PackedData} data
   * @param {Source} source
   */
  constructor(data, source) {
    super(data);
    this.#source = source;
    this.#manifest = source.manifest;
    this.#note = source.manifest.note ?? null;
  }

  /** Manifest of the current data: facts, views and more. */
  get manifest() {
    return this.#manifest;
  }

  /** Reason why the last update is not shown; null if it is shown. */
  get note() {
    return this.#note;
  }

  /** Whether the last request reached the server. */
  get online() {
    return this.#online;
  }

  /** Whether it has been closed. */
  get closed() {
    return this.#closing.signal.aborted;
  }

  /** Stop following the server; the last data remain. */
  close() {
    this.#closing.abort();
  }

  /** Stop following the server, and free the GPU memory. */
  dispose() {
    this.close();
    super.dispose();
  }

  /**
   * Until closed: refresh, listen to the event stream while it is open, poll otherwise.
   *
   * @param {boolean} events
   * @param {number} interval
   */
  async #follow(events, interval) {
    const { signal } = this.#closing;
    let failures = 0;
    let refusals = 0; // of the event stream
    let listenAt = 0;
    while (!signal.aborted) {
      try {
        if (events && this.#source.hasEvents && performance.now() >= listenAt) {
          const opened = await this.#listen(signal);
          if (opened) failures = refusals = 0;
          else listenAt = performance.now() + backOff(++refusals);
        }
        await this.#refresh();
        this.#setOnline(true);
        failures = 0;
        await sleep(interval, signal);
      } catch (error) {
        if (signal.aborted) return;
        this.#setOnline(false, error);
        listenAt = 0; // prefer events when the server is back
        await sleep(backOff(++failures), signal);
      }
    }
  }

  /**
   * Listen to the event stream until it ends or an update cannot be fetched.
   *
   * @param {AbortSignal} signal
   * @returns {Promise<boolean>} whether they came at all
   */
  #listen(signal) {
    return new Promise((resolve) => {
      let opened = false;
      const end = () => {
        leave();
        clearTimeout(timer);
        signal.removeEventListener('abort', end);
        resolve(opened);
      };
      const refresh = () => this.#refresh().then(() => this.#setOnline(true), end);
      const leave = this.#source.listen({
        opened: (wasOpen) => {
          opened = true;
          if (wasOpen) refresh();
        },
        heard: (kind, data) => this.#hear(kind, data, refresh),
        failed: end,
      });
      const timer = setTimeout(() => opened || end(), OPENING);
      signal.addEventListener('abort', end);
    });
  }

  /**
   * @param {string} kind of an event
   * @param {any} data
   * @param {() => void} refresh
   */
  #hear(kind, data, refresh) {
    const { name } = this.#manifest;
    const version = kind === 'hello' ? data.versions?.[name] : data.name === name ? data.version : undefined;
    const mayBeNews = kind === 'shape' || !this.#source.has(version); // the same version clears a note
    if (version !== undefined && mayBeNews) refresh();
    else if (kind === 'hello') this.#setOnline(true);
    else if (kind === 'note' && data.name === name) {
      this.#heard = true;
      this.#tell(String(data.message));
    }
  }

  /** Fetch the server's current data. One refresh runs at a time; a call meanwhile runs another afterwards. */
  #refresh() {
    this.#again = true;
    this.#refreshing ??= this.#refreshWhileAsked().finally(() => {
      this.#refreshing = null;
    });
    return this.#refreshing;
  }

  async #refreshWhileAsked() {
    while (this.#again) {
      this.#again = false;
      await this.#refreshOnce();
    }
  }

  async #refreshOnce() {
    const { signal } = this.#closing;
    const source = this.#source;
    if (!(await source.look(signal))) {
      if (this.#heard) this.#tell(source.manifest.note ?? null);
      this.#heard = false;
      return;
    }
    if (!source.isLoaded) {
      let data;
      try {
        data = await source.load(signal);
      } catch (error) {
        if (signal.aborted || isTransport(error)) throw error;
        this.#tell(/** @type {Error} */ (error).message);
        return;
      }
      signal.throwIfAborted();
      this.#manifest = source.manifest;
      this.#note = null;
      guarded(() => this.replace(data));
    } else if (source.manifest.version !== this.#manifest.version) {
      this.#manifest = source.manifest;
      guarded(() => this.dispatchEvent({ type: 'change' }));
    }
    this.#manifest = source.manifest;
    this.#tell(source.manifest.note ?? null);
  }

  /**
   * @param {string | null} message
   */
  #tell(message) {
    const isNews = message !== this.#note;
    this.#note = message;
    if (isNews && !this.closed) guarded(() => this.dispatchEvent({ type: 'note', message: message ?? '' }));
  }

  /**
   * @param {boolean} online
   * @param {unknown} [error]
   */
  #setOnline(online, error) {
    if (online === this.#online || this.closed) return;
    this.#online = online;
    const message = error instanceof Error ? error.message : String(error);
    guarded(() => this.dispatchEvent(online ? { type: 'online' } : { type: 'offline', message }));
  }
}

/**
 * Dispatch an event. An error in a listener must not be taken for an unreachable server.
 *
 * @param {() => void} call
 */
function guarded(call) {
  try {
    call();
  } catch (error) {
    console.error(error);
  }
}
