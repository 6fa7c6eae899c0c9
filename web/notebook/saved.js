/** The page of `widget.save`: a widget without a kernel, whose state is in the page. */

/** @typedef {import('./widget.js').Model} Model */

/**
 * What a kernel would tell of the feature under the pointer.
 *
 * @param {Record<string, any>} state
 * @returns {[string, string][]}
 */
function tipOf({ _tips: tips, hovered, times, time }) {
  const values = tips?.values[hovered?.element];
  if (!values) return [];
  const facts = tips.names.map((/** @type {string} */ name, /** @type {number} */ k) => [name, values[k]]);
  const step = Math.round(time);
  return times.length ? [[times[step], values[facts.length + step]], ...facts] : facts;
}

/** @param {Record<string, unknown>} state @returns {Model} */
function modelOf(state) {
  const events = new EventTarget();
  return {
    get: (name) => state[name],
    set: (name, value) => {
      state[name] = value;
      events.dispatchEvent(new Event(`change:${name}`));
      if (name !== 'hovered' && name !== 'time') return;
      state.tip = tipOf(state);
      events.dispatchEvent(new Event('change:tip'));
    },
    save_changes: () => {},
    on: (event, act) => events.addEventListener(event, act),
    off: (event, act) => events.removeEventListener(event, act),
  };
}

/** Show the widget of the page, if it is such a page. @param {typeof import('./engine.js').attach} attach */
export function followSaved(attach) {
  const scene = document.getElementById('vexture-scene');
  const el = document.getElementById('app');
  if (!scene || !el) return;
  const { state, texture } = JSON.parse(scene.textContent ?? '', (_, value) => (value?.base64 ? bytesOf(value.base64) : value));
  void fetch(texture).then((answer) => answer.arrayBuffer())
    .then((content) => attach({ model: modelOf(state), el, source: () => Promise.resolve({ key: '', content }) }));
}

/** @param {string} text in base64 */
const bytesOf = (text) => new DataView(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
