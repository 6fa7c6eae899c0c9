/** The shown step, and playback. */
import { labelOf } from './steps.js';

/** @typedef {import('./steps.js').Step} Step */

/** Milliseconds that a step is shown at speed 1. */
const PACE = 1000;

/**
 * Events: `step` when another step is shown or its water has changed, `steps` when the list of steps changes or the water
 * of any, `play` when playback starts or stops, `newer` when there is a newer step that is not shown, `failed` with the
 * error in `detail`.
 */
export class Player extends EventTarget {
  #show;
  #prepare;
  #turn = 0;
  #timer = 0;
  /** @type {Map<string, string>} */
  #labels = new Map();
  /** @type {Step | null} */
  step = null;
  index = 0;
  playing = false;
  speed = 1;
  fading = false;

  /**
   * @param {import('./steps.js').Steps} steps
   * @param {{show: (step: Step, fading: boolean) => void, prepare: (step: Step) => Promise<void>}} how shows a step;
   *   prepares one for showing, also when its water has changed
   */
  constructor(steps, { show, prepare }) {
    super();
    this.steps = steps;
    this.#show = show;
    this.#prepare = prepare;
    steps.addEventListener('names', () => this.#renamed());
    steps.addEventListener('changed', () => this.dispatchEvent(new Event('steps')));
  }

  get names() {
    return this.steps.names;
  }

  get count() {
    return this.names.length;
  }

  /** Time of a step, or its name while the time is unknown. @param {number} index */
  label(index) {
    const name = this.names[index];
    return this.#labels.get(name) ?? name;
  }

  /** After a change of the list: show the newest step, or stay at an older one that the user chose. */
  #renamed() {
    const name = this.step?.name ?? '';
    const at = this.names.indexOf(name);
    const newest = this.names[this.count - 1];
    const isNewer = newest !== this.#newest;
    this.#newest = newest;
    this.dispatchEvent(new Event('steps'));
    if (this.follows && !this.playing) return void this.#go(this.count - 1);
    if (at < 0) return void this.#go(Math.min(this.index, this.count - 1));
    this.index = at;
    this.dispatchEvent(new Event('step'));
    if (isNewer) this.dispatchEvent(new Event('newer'));
  }

  /** Whether newer steps are shown as they arrive; ends when the user chooses another than the last. */
  follows = true;

  /** @type {string | undefined} */
  #newest;

  /**
   * Show a step once it is loaded; until then, or after an error, the shown one stays.
   *
   * @param {number} index
   */
  async go(index) {
    this.follows = Math.round(index) >= this.count - 1;
    await this.#go(index);
  }

  /** Show a step, the first unless another is wanted, and newer ones as they arrive. */
  async start(index = 0) {
    this.#newest = this.names[this.count - 1];
    if (index > 0) await this.go(index);
    else await this.#go(0);
  }

  /** @param {number} index */
  async #go(index) {
    const mine = ++this.#turn;
    const wanted = Math.min(Math.max(Math.round(index), 0), this.count - 1);
    const name = this.names[wanted];
    try {
      const step = await this.#ready(name);
      if (mine !== this.#turn) return;
      this.step?.texture.removeEventListener('change', this.#changed);
      const isFirst = this.step === null;
      this.step = step;
      this.index = Math.max(this.names.indexOf(name), 0);
      step.texture.addEventListener('change', this.#changed);
      this.#show(step, this.fading && !isFirst);
      this.dispatchEvent(new Event('step'));
    } catch (error) {
      if (mine !== this.#turn) return;
      this.pause();
      this.dispatchEvent(new CustomEvent('failed', { detail: error }));
      return;
    }
    const next = this.names[this.index + 1];
    if (next !== undefined) this.#ready(next).catch(() => {}); // reported when it is to be shown
  }

  #changed = async () => {
    const { step } = this;
    if (!step) return;
    this.#labels.set(step.name, labelOf(step.manifest, step.name));
    try {
      await this.#prepare(step);
    } catch (error) {
      this.dispatchEvent(new CustomEvent('failed', { detail: error }));
    }
    if (this.step !== step) return;
    this.#show(step, false);
    this.dispatchEvent(new Event('step'));
  };

  /** @param {string} name */
  async #ready(name) {
    const step = await this.steps.open(name);
    let manifest;
    do { // its water may change meanwhile
      ({ manifest } = step);
      this.#labels.set(name, labelOf(manifest, name));
      await this.#prepare(step);
    } while (manifest !== step.manifest);
    return step;
  }

  /** Start playback, from the first step if the last one is shown. */
  play() {
    if (this.playing || this.count < 2) return;
    this.playing = true;
    this.dispatchEvent(new Event('play'));
    void (this.index >= this.count - 1 ? this.go(0) : Promise.resolve()).then(() => this.#wait());
  }

  #wait() {
    clearTimeout(this.#timer);
    if (!this.playing) return;
    this.#timer = window.setTimeout(async () => {
      await this.go(this.index + 1);
      if (this.index >= this.count - 1) this.pause();
      else this.#wait();
    }, PACE / this.speed);
  }

  pause() {
    clearTimeout(this.#timer);
    if (!this.playing) return;
    this.playing = false;
    this.dispatchEvent(new Event('play'));
  }
}
