// One of the labels of a `BatchedText`.
import { Color, Quaternion, Vector3 } from 'three';
import { VextureError, line } from '../errors.js';
import { LAYOUT, checkOption } from './text-options.js';

/** @import { LayoutOptions } from './text-options.js' */
/** @import { TextLayout } from './layout.js' */

/**
 * @typedef {object} LabelOptions Besides those of its layout.
 * @property {Vector3 | readonly [number, number, number]} [position] of its origin, in the space of the `BatchedText`
 * @property {Quaternion} [quaternion] without effect on sprites
 * @property {number} [scale] above 0; 1 by default
 * @property {import('three').ColorRepresentation} [color] white by default
 * @property {number} [opacity] 1 by default
 * @property {boolean} [visible] true by default
 */

/** Options of a label that change no layout. */
const OWN = Object.freeze(['position', 'quaternion', 'scale', 'color', 'opacity', 'visible']);

/**
 * A label. Its `position`, `quaternion`, `scale`, `color`, `opacity` and `visible` can be changed at any time, for the next
 * frame; `set` changes its text and the options of its layout.
 */
export class Label {
  /** @type {Partial<LayoutOptions>} */
  #options = {};
  #onChange;
  /** Measures of what is shown; null: nothing yet. @type {TextLayout | null} */
  layout = null;
  #position = new Vector3();
  /** Why its last change is not shown. @type {Error | null} */
  error = null;
  quaternion = new Quaternion();
  scale = 1;
  /** @type {import('three').ColorRepresentation} */
  color = new Color(0xffffff);
  opacity = 1;
  visible = true;

  /**
   * @internal
   * @param {number} row of the table
   * @param {(label: Label) => void} onChange called when its layout changes
   */
  constructor(row, onChange) {
    this.row = row;
    this.#onChange = onChange;
  }

  /** Options of the layout that are its own. */
  get options() {
    return this.#options;
  }

  /** Where it is; a vector or three numbers can be assigned. */
  get position() {
    return this.#position;
  }

  set position(position) {
    const given = /** @type {any} */ (position), parts = Array.isArray(given) ? given : [given?.x, given?.y, given?.z];
    if (parts.length !== 3 || !parts.every(Number.isFinite)) throw new VextureError(`the position of a label is ${line(given)}; give three numbers or a Vector3`, 'position');
    this.#position.fromArray(parts);
  }

  get text() {
    return this.#options.text ?? '';
  }

  set text(text) {
    this.set({ text });
  }

  /**
   * Change options.
   *
   * @param {Partial<LayoutOptions> & LabelOptions} changes
   * @throws {VextureError} if there is no such option, or a value is out of range
   */
  set(changes) {
    const given = Object.entries(changes).filter(([, value]) => value !== undefined);
    for (const [name, value] of given) {
      if (OWN.includes(name)) continue;
      if (!(name in LAYOUT)) throw new VextureError(`a label has no option ${line(name)}; correct its name`, name);
      checkOption(name, value);
    }
    let isStale = false;
    for (const [name, value] of given) {
      const self = /** @type {any} */ (this), options = /** @type {any} */ (this.#options);
      if (name === 'quaternion') self.quaternion.copy(value);
      else if (OWN.includes(name)) self[name] = value;
      else if (!Object.is(options[name], value)) {
        options[name] = value;
        isStale = true;
      }
    }
    if (isStale) this.#onChange(this);
  }
}
