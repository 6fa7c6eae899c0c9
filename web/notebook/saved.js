/** The page of `widget.save`: a widget without a kernel, whose state is in the page. */

/** @typedef {import('./widget.js').Model} Model */

/** @param {Record<string, unknown>} state @returns {Model} */
function modelOf(state) {
  const events = new EventTarget();
  return {
    get: (name) => state[name],
    set: (name, value) => {
      state[name] = value;
      events.dispatchEvent(new Event(`change:${name}`));
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
