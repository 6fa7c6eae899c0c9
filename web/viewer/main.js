/** The page: makes its elements, brings them together, and starts. */
import { element } from './dom.js';
import { Engine } from './engine.js';
import { EXTRAS } from './extras.js';
import { ZOOM_STEP, listen } from './gestures.js';
import { followLink, linkedView } from './link.js';
import { Notes } from './notes.js';
import { createPanel, createTools } from './panel.js';
import { Library, readScene } from './scene.js';
import { START, State, THEMES } from './state.js';
import { applyTheme, watchSystemTheme } from './theme.js';

const NARROW = matchMedia('(max-width: 720px)');

const bare = new URLSearchParams(location.search).has('bare');
const app = /** @type {HTMLElement} */ (document.getElementById('app'));
const notes = new Notes();
const canvas = element('canvas', {});
const stage = element('div', {
  class: 'stage', tabindex: 0, role: 'application', 'aria-label':
    'Picture. Drag or press the arrow keys to move, + and − to zoom, 0 to see all of it.',
}, canvas);

/** @param {State} state */
function nextTheme(state) {
  const theme = THEMES[(THEMES.indexOf(state.value.theme) + 1) % THEMES.length];
  state.update({ theme });
  notes.say(theme === 'system' ? 'Theme as the system has it' : `${theme === 'dark' ? 'Dark' : 'Light'} theme`);
}

/** @param {State} state @param {Engine} engine */
function followTheme(state, engine) {
  const dress = () => {
    applyTheme(state.value.theme);
    engine.recolor();
  };
  watchSystemTheme(dress);
  state.addEventListener('change', (event) => {
    if (/** @type {CustomEvent} */ (event).detail.changed.has('theme')) dress();
  });
}

/** @param {Engine} engine @param {State} state @param {Library} library */
function build(engine, state, library) {
  const reset = () => {
    const { mode } = state.value;
    state.update(mode === 'flat' ? { center: START.center, zoom: START.zoom }
      : { yaw: START.yaw, pitch: START.pitch, distance: START.distance });
  };
  listen(stage, {
    drag: (dx, dy) => engine.drag(dx, dy), zoom: (px, py, factor) => engine.zoom(px, py, factor),
    zoomMiddle: (factor) => engine.zoomMiddle(factor), reset,
  });
  const panel = createPanel(engine, state, [{ label: 'Theme', act: () => nextTheme(state) }]);
  for (const { create, place } of EXTRAS) (place === 'stage' ? stage : panel.extras).append(create(engine, state));
  panel.showShapes(library.names);
  const tools = createTools(engine, {
    zoom: (factor) => engine.zoomMiddle(factor), reset, folded: NARROW.matches, step: ZOOM_STEP,
    fold: () => app.classList.toggle('folded'),
  });
  app.classList.toggle('folded', NARROW.matches);
  if (!bare) app.append(tools.zoom, tools.fold, panel.panel);
  return panel;
}

/** @param {State} state */
async function start(state) {
  const library = new Library(readScene());
  const engine = new Engine(canvas, state);
  const panel = build(engine, state, library);
  followTheme(state, engine);
  const open = async () => {
    const name = state.value.shape || library.names[0];
    try {
      const opened = await library.open(name);
      panel.setTitle(name);
      await engine.show(opened);
    } catch (error) {
      notes.say(/** @type {Error} */ (error).message);
    }
  };
  state.addEventListener('change', (event) => {
    if (/** @type {CustomEvent} */ (event).detail.changed.has('shape')) void open();
  });
  followLink(state, (message) => notes.say(message));
  viewer.engine = engine;
  notes.keep('Preparing the picture…');
  await open();
  notes.keep('');
  engine.render();
}

const linked = linkedView();
const state = new State(linked ?? START);
applyTheme(state.value.theme);
app.classList.toggle('bare', bare);
app.append(stage, notes.element);
if (linked === undefined) notes.say('This link is damaged; the whole shape is shown.');

/** For tests and for the curious. */
const viewer = {
  state,
  /** @type {Engine | null} */
  engine: null,
  /** @type {Promise<void> | null} */
  ready: null,
};
Object.assign(window, { vexture: { viewer } });
viewer.ready = start(state);
