/**
 * The module that each widget of a notebook has: small, since every widget sends its own. The engine and the contents of
 * textures are models of their own, which a kernel sends once for all widgets that use them.
 *
 * @typedef {object} Model as anywidget gives it
 * @property {(name: string) => any} get
 * @property {(name: string, value: unknown) => void} set
 * @property {() => void} save_changes
 * @property {(event: string, act: () => void) => void} on
 * @property {(event: string, act: () => void) => void} off
 *
 * @typedef {{ key: string, content: DataView | ArrayBuffer }} Shared bytes, and what tells them from others
 * @typedef {Model & { widget_manager: { get_model: (id: string) => Promise<Model> } }} ManagedModel
 */

/** Engines of this page, by their keys: kernels of several versions may show widgets on it. */
const ENGINES = Symbol.for('vexture.notebook');

const REFERENCE = /^IPY_MODEL_/;

/** @param {ManagedModel} model @param {string} name of a trait that refers to a model @returns {Promise<Shared>} */
async function shared(model, name) {
  const found = await model.widget_manager.get_model(model.get(name).replace(REFERENCE, ''));
  return { key: found.get('key'), content: found.get('content') };
}

/** @param {Shared} engine @returns {Promise<typeof import('./engine.js')>} */
function imported({ key, content }) {
  const page = /** @type {Record<symbol, Map<string, Promise<any>>>} */ (/** @type {unknown} */ (globalThis));
  const engines = (page[ENGINES] ??= new Map());
  const known = engines.get(key);
  if (known) return known;
  const address = URL.createObjectURL(new Blob([/** @type {ArrayBuffer} */ (content)], { type: 'text/javascript' }));
  const loading = import(address).finally(() => URL.revokeObjectURL(address));
  engines.set(key, loading);
  loading.catch(() => engines.delete(key));
  return loading;
}

/** @param {{ model: ManagedModel, el: HTMLElement }} widget */
async function render({ model, el }) {
  const source = () => (model.get('_source') ? shared(model, '_source') : null);
  const { attach } = await imported(await shared(model, '_engine'));
  return attach({ model, el, source });
}

export default { render };
