/** A drawing in an element: it follows a model, and tells it how it is moved and what is pointed at. */
import { element } from '../viewer/dom.js';
import { panned, toUnit, zoomed } from '../viewer/view.js';
import { Colored, Steps, coloringOf, inflatedView, open, release } from './contents.js';
import { drawnOf, foundAt } from './drawn.js';
import { listenTo } from './input.js';
import { Tip, legendOf, openIfSmall } from './legend.js';
import { followPixels } from './pixels.js';
import { rectOf, viewOf } from './rect.js';
import { followRoom } from './room.js';
import { screenOfPage } from './screen.js';
import { Sketch } from './sketch.js';
import { STYLE } from './style.js';
import { TimeBar } from './time.js';

/**
 * @typedef {import('./widget.js').Model} Model
 * @typedef {import('./rect.js').Rect} Rect
 * @typedef {() => Promise<import('./widget.js').Shared> | null} Source null before it is there
 */

const HINT = 'Drag or press the arrow keys to move, + and − to zoom, Home to see all of it.';
const NO_WEBGL = 'This picture is drawn with WebGL 2, which this browser does not offer; try a newer browser.';

export class Stage {
  canvas = element('canvas', {});
  isSeen = true;
  /** What is drawn; null before it is there. @type {import('../viewer/drawing.js').ShownDrawing | null} */
  shown = null;
  #message = element('p', { role: 'alert', hidden: true });
  #legend = legendOf(null, false);
  #tip = new Tip();
  #time = new TimeBar((time) => {
    this.model.set('time', time);
    this.model.save_changes();
  });
  /** Of the pointer, in pixels. @type {[number, number] | null} */
  #pointer = null;
  /** @type {import('./screen.js').Screen | null} */
  #screen = null;
  /** @type {import('./widget.js').Shared | null} */
  #source = null;
  /** @type {import('./contents.js').Content | null} */
  #content = null;
  /** With colours of its own. @type {Colored | null} */
  #own = null;
  #range = { first: 0, count: 1 };
  /** @type {Rect} */
  #rect;
  /** A moving picture is its own master: what comes back from a kernel, late, would make it jump. */
  #held = false;
  #sending = 0;
  #ended = new AbortController();

  /** In place of a texture that is still made. @type {Sketch | null} */
  #sketch = null;
  /** Of all elements. @type {{ sent: unknown, coloring: import('./contents.js').Coloring | null }} */
  #coloring = { sent: null, coloring: null };
  /** @type {{ sent: unknown, steps: Promise<Steps> | null }} */
  #steps = { sent: null, steps: null };

  /** @param {Model} model @param {Source} source */
  constructor(model, source) {
    this.model = model;
    this.#rect = model.get('view');
    const style = element('style', {}, STYLE);
    this.element = element('div', {
      class: 'vexture-stage', tabindex: 0, role: 'application', 'aria-label': `${model.get('_name')}. ${HINT}`,
      'data-lm-suppress-shortcuts': 'true', // else JupyterLab acts on the keys, too
    }, style, this.canvas, this.#legend, this.#time.element, this.#tip.element, this.#message);
    this.#explain();
    this.#showTime();
    this.#sized();
    this.#watchSight();
    followRoom(this.element, (isWide) => openIfSmall(this.#legend, this.element, isWide), this.#ended.signal);
    followPixels(this.canvas, () => this.#redraw(), this.#ended.signal);
    this.#follow();
    listenTo(this.element, this, this.#ended.signal);
    this.#await(source);
  }

  /** Show pictures until the texture is there. @param {Source} source */
  #await(source) {
    const found = source();
    if (!found) this.element.ariaBusy = 'true';
    if (found) return void this.#start(found);
    this.#sketch = new Sketch(this.model, this.canvas, () => this.#redraw(), this.#ended.signal);
    const come = () => {
      if (!source()) return;
      this.model.off('change:_source', come);
      if (!this.#ended.signal.aborted) this.#await(source);
    };
    const fail = () => this.#say(this.model.get('_failure'));
    this.#on({ 'change:_source': come, 'change:_failure': fail });
    if (this.model.get('_failure')) fail();
  }

  /** @param {Record<string, () => void>} acts */
  #on(acts) {
    for (const [event, act] of Object.entries(acts)) {
      this.model.on(event, act);
      this.#ended.signal.addEventListener('abort', () => this.model.off(event, act));
    }
  }

  /** Take it out of the page, and free its memory. */
  dispose() {
    this.#ended.abort();
    this.#time.stop();
    this.#screen?.remove(this);
    this.#own?.texture.dispose();
    if (this.#source && this.#content) release(this.#source);
    this.element.remove();
  }

  /** @param {Promise<import('./widget.js').Shared>} source */
  async #start(source) {
    try {
      this.#screen = screenOfPage();
    } catch {
      return this.#say(NO_WEBGL);
    }
    this.#screen.add(this);
    try {
      const shared = this.#source = await source;
      const content = await open(shared);
      if (this.#ended.signal.aborted) return release(shared);
      this.#content = content;
      await this.#color();
    } catch (error) {
      this.#say(/** @type {Error} */ (error).message);
    }
  }

  /** @param {string} message */
  #say(message) {
    this.#message.textContent = message;
    this.#message.hidden = !message;
  }

  #follow() {
    /** @type {Record<string, () => void>} */
    const acts = {
      'change:view': () => {
        if (this.#held) return;
        this.#rect = this.model.get('view');
        this.#redraw();
      },
    };
    for (const name of ['width', 'height', 'background']) acts[`change:${name}`] = () => this.#sized();
    acts['change:legend'] = () => this.#explain();
    acts['change:tip'] = () => this.#tell();
    acts['change:times'] = () => this.#showTime();
    for (const name of ['colors', '_marked', '_coloring', '_steps', 'root', 'mode']) {
      acts[`change:${name}`] = () => void this.#color().catch((error) => this.#say(error.message));
    }
    acts['change:time'] = () => {
      this.#showTime();
      void this.#color().catch((error) => this.#say(error.message));
    };
    this.#on(acts);
  }

  #showTime() {
    this.#time.show(this.model.get('times') ?? [], this.model.get('time') ?? 0);
  }

  #sized() {
    const width = this.model.get('width');
    this.element.style.width = width === null ? '100%' : `${width}px`;
    const height = this.model.get('height');
    this.element.style.height = height === null ? '100%' : `${height}px`;
    this.element.style.background = this.model.get('background');
  }

  /** Choose what is drawn, in its colours. */
  async #color() {
    if (!this.#content || !this.#screen) return;
    const { data, texture } = this.#content;
    const root = this.model.get('root');
    const colors = { ...this.model.get('colors'), ...this.model.get('_marked') };
    const range = texture.layersOf(root);
    const coloring = await this.#coloringOf(data.roots[range.first], this.model.get('_coloring'), this.model.get('_steps'));
    if (!this.#own?.recolor(colors, coloring, root)) {
      this.#own?.texture.dispose();
      const isOwn = coloring !== null || Object.keys(colors).length > 0;
      this.#own = isOwn ? new Colored(data, range, colors, coloring, root) : null;
    }
    this.#range = range;
    this.shown = drawnOf(this.texture, range, this.model.get('mode'));
    this.#say('');
    await this.#screen.prepare(this);
    this.#sketch = null; // the canvas keeps its picture until the next one
    this.element.ariaBusy = 'false';
    this.#redraw();
  }

  /**
   * @param {import('../src/data.js').Root} root
   * @param {any} sent of one column
   * @param {any} steps of time
   * @returns {Promise<import('./contents.js').Coloring | null>}
   */
  async #coloringOf({ style }, sent, steps) {
    if (style && steps) return (await this.#stepsOf(style, steps)).at(this.model.get('time'));
    if (sent !== this.#coloring.sent) this.#coloring = { sent, coloring: style && sent ? coloringOf(style, sent) : null };
    return this.#coloring.coloring;
  }

  /** @param {import('../src/style.js').Style} style @param {{ colors: DataView, places: DataView }} sent */
  async #stepsOf(style, sent) {
    if (sent !== this.#steps.sent || !this.#steps.steps) {
      const count = this.model.get('times').length;
      const steps = inflatedView(sent.places).then((places) => new Steps(style, { colors: sent.colors, places }, count));
      this.#steps = { sent, steps };
    }
    return /** @type {Promise<Steps>} */ (this.#steps.steps);
  }

  /** @returns {import('../src/vector-texture.js').VectorTexture} */
  get texture() {
    return this.#own?.texture ?? /** @type {import('./contents.js').Content} */ (this.#content).texture;
  }

  #redraw() {
    if (this.#sketch) this.#sketch.draw(this.#rect);
    else this.#screen?.request(this);
  }

  /** What is far from the window is drawn when it comes near. */
  #watchSight() {
    const watcher = new IntersectionObserver((entries) => {
      this.isSeen = entries[entries.length - 1].isIntersecting;
      if (this.isSeen) this.#redraw();
    }, { rootMargin: '200px' });
    watcher.observe(this.element);
    this.#ended.signal.addEventListener('abort', () => watcher.disconnect());
  }

  /** The view on the canvas, whose pixels it is drawn in. */
  get view() {
    return viewOf(this.#rect, this.canvas);
  }

  get #size() {
    return { width: Math.max(1, this.canvas.clientWidth), height: Math.max(1, this.canvas.clientHeight) };
  }

  /** @param {boolean} held */
  hold(held) {
    this.#held = held;
    if (!held) this.#send();
  }

  /** @param {number} dx @param {number} dy CSS pixels */
  drag(dx, dy) {
    this.#move(rectOf(panned(viewOf(this.#rect, this.#size), this.#size, dx, dy), this.#rect, this.#size));
  }

  /** @param {number} px @param {number} py @param {number} factor */
  zoom(px, py, factor) {
    this.#move(rectOf(zoomed(viewOf(this.#rect, this.#size), this.#size, px, py, factor), this.#rect, this.#size));
  }

  home() {
    this.#move(this.model.get('_home'));
  }

  /** @param {Rect} rect */
  #move(rect) {
    this.#rect = rect;
    this.#redraw();
    if (this.#sending !== 0) return;
    this.#sending = requestAnimationFrame(() => {
      this.#sending = 0;
      this.#send();
    });
  }

  #send() {
    if (this.#ended.signal.aborted) return;
    this.model.set('view', this.#rect);
    this.model.save_changes();
  }

  /** @param {number} px @param {number} py @returns {{ found: import('./drawn.js').Found | null, u: number, v: number } | null} */
  #at(px, py) {
    if (!this.#content) return null;
    const [u, v] = toUnit(viewOf(this.#rect, this.#size), this.#size, px, py);
    return { found: foundAt(this.texture, this.#range, u, v), u, v };
  }

  /** @param {number} px @param {number} py */
  pick(px, py) {
    const at = this.#at(px, py);
    if (!at) return;
    const { found, u, v } = at;
    const { first, count } = this.#range;
    const roots = this.texture.roots.slice(first, first + count);
    const [a, b, c, d, e, f] = (roots.find(({ name }) => name === found?.root) ?? roots[0]).transform;
    this.model.set('picked', {
      root: found?.root ?? null, element: found?.element ?? null,
      position: [u, v], source: [a * u + b * v + c, d * u + e * v + f],
    });
    this.model.save_changes();
  }

  #explain() {
    const legend = legendOf(this.model.get('legend'), this.#legend.open);
    this.#legend.replaceWith(legend);
    this.#legend = legend;
  }

  #tell() {
    const shown = this.model.get('hovered') ? this.model.get('tip') : null;
    this.#tip.show(shown, this.#pointer, this.element);
  }

  /** @param {[number, number] | null} place under the pointer */
  hover(place) {
    this.#pointer = place;
    this.#tell();
    const found = place && (this.#at(...place)?.found ?? null);
    const { root, element: named } = this.model.get('hovered') ?? {};
    if (root === found?.root && named === found?.element) return;
    this.canvas.style.cursor = found ? 'pointer' : '';
    this.model.set('hovered', found);
    this.model.save_changes();
  }
}
