// A text whose material follows the one that it was made of: React changes that one.
import { Text } from '../text/index.js';

/** Properties that say which material it is, or are the text's own. */
const OWN = Object.freeze([
  'uuid', 'name', 'type', 'userData', 'version', '_listeners', 'vertexColors', 'defines', 'uniforms', 'polygonOffset',
  'polygonOffsetFactor', 'polygonOffsetUnits',
]);

/** Whether it is a colour, a vector or the like. @param {any} value */
const isCopied = (value) => typeof value?.equals === 'function' && typeof value.copy === 'function';

/** Its members are those of each renderer's texts, which the language takes for fields. @type {any} */
const Base = Text;

/** A text with a material that somebody changes. */
export class FollowingText extends Base {
  /** @type {any} */
  #base = null;
  /** @type {Map<string, any>} values of the base that the text has */
  #known = new Map();
  isDisposed = false;

  get material() {
    return super.material;
  }

  /** One that a text has made is put back by React when an element is gone: it stands for none. @param {any} material */
  set material(material) {
    const base = material?.userData?.mask ? null : (material ?? null);
    super.material = base;
    if (#base in this) this.#remember(base);
  }

  /** @param {any} base */
  #remember(base) {
    this.#base = base;
    this.#known.clear();
    if (base) for (const name of this.#names()) this.#known.set(name, isCopied(base[name]) ? base[name].clone() : base[name]);
  }

  #names() {
    return Object.keys(this.#base).filter((name) => !OWN.includes(name) && typeof this.#base[name] !== 'function');
  }

  #follow() {
    const base = this.#base, shown = super.material;
    for (const name of this.#names()) {
      const value = base[name], known = this.#known.get(name);
      if (isCopied(value) && isCopied(known) ? value.equals(known) : value === known) continue;
      this.#known.set(name, isCopied(value) ? value.clone() : value);
      this.#take(name, value, shown);
    }
    if (this.#known.get('version') === base.version) return;
    if (this.#known.has('version')) shown.needsUpdate = true;
    this.#known.set('version', base.version);
  }

  /** @param {string} name @param {any} value @param {any} shown */
  #take(name, value, shown) {
    const { color, colorRanges, fillOpacity } = this;
    if (name === 'color' && (color !== null || colorRanges)) return;
    if (name === 'opacity') shown.opacity = fillOpacity * value;
    else if (isCopied(value) && isCopied(shown[name])) shown[name].copy(value);
    else shown[name] = value;
  }

  /** @param {any} renderer @param {any} scene @param {any} camera */
  onBeforeRender(renderer, scene, camera) {
    if (this.#base) this.#follow();
    super.onBeforeRender(renderer, scene, camera);
  }

  dispose() {
    this.isDisposed = true;
    super.dispose();
  }
}
