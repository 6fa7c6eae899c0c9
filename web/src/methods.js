// Methods of single objects of three.js, in which a mask takes part as long as it is on them.

/**
 * Take part in a method of an object, and in what replaces it later.
 *
 * @template {object} T
 * @param {T} object
 * @param {keyof T} name
 * @param {(own: any, ...parameters: any[]) => unknown} act does what the method does; `own` is the object's own method
 * @returns {() => void} takes it back; methods that were chained to it still call it, to no effect
 */
export function takePartIn(object, name, act) {
  /** @type {any} */
  let own;
  /** @type {any} */
  let wrapped;
  let taken = true;
  const set = (/** @type {any} */ method) => {
    own = method;
    const bound = method?.bind(object);
    wrapped = method && ((/** @type {any[]} */ ...parameters) => (taken ? act(bound, ...parameters) : bound(...parameters)));
    if (method) wrapped.toString = () => `${method}`; // of which three.js makes a program's key
  };
  set(object[name]);
  Object.defineProperty(object, name, { configurable: true, enumerable: true, get: () => wrapped, set });
  return () => {
    taken = false;
    delete (/** @type {Partial<T>} */ (object)[name]);
    if (object[name] !== own) object[name] = own;
  };
}

/**
 * JSON holds no mask.
 *
 * @param {import('three').Material} material
 */
export function warnOfJSON({ name, type }) {
  console.warn(`vexture: the JSON of ${name || type} is without its vector texture; mask it again when it is loaded`);
}
