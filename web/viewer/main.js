/** Entry of the page: makes and connects its elements, and starts. */
import { createCompare } from './compare.js';
import { copyPicture, copyText, pictureOf } from './copy.js';
import { create as createDifferences } from './differences.js';
import { element } from './dom.js';
import { acceptDrops, fileButton } from './drop.js';
import { Engine } from './engine.js';
import { EXTRAS } from './extras.js';
import { ZOOM_STEP, listen } from './gestures.js';
import { followLink, linkTo, linkedView } from './link.js';
import { Notes } from './notes.js';
import { createPanel, createTools } from './panel.js';
import { Library, readScene } from './library.js';
import { createSave } from './save.js';
import { HOME, START, State, THEMES } from './state.js';
import { createSheet } from './sheet.js';
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
/** The canvas and its overlays. */
const scene = element('main', { class: 'scene' });

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
    const { center, zoom, ...turned } = HOME;
    state.update(mode === 'flat' ? { center, zoom } : turned);
  };
  listen(stage, {
    drag: (dx, dy) => engine.drag(dx, dy), zoom: (px, py, factor) => engine.zoom(px, py, factor),
    zoomMiddle: (factor) => engine.zoomMiddle(factor), reset,
  });
  const compare = createCompare(engine, state, stage, (message) => notes.say(message));
  const given = (/** @type {File[]} */ files) => void openFiles(files, state, library);
  const panel = createPanel(engine, state, [
    { label: 'Copy link', act: () => void copyLink(state) },
    { label: 'Copy picture', ofOne: true, act: () => void copySeen(engine, compare.image()) },
    { label: 'Theme', act: () => nextTheme(state) },
  ]);
  panel.foot.append(fileButton(given));
  acceptDrops(given);
  panel.extras.append(createSave(engine, state, (message) => notes.say(message)));
  for (const { create, place } of EXTRAS) (place === 'stage' ? stage : panel.extras).append(create(engine, state));
  const showNames = () => panel.showShapes(library.names);
  library.addEventListener('names', showNames);
  showNames();
  const tools = createTools(engine, {
    zoom: (factor) => engine.zoomMiddle(factor), reset, folded: NARROW.matches, step: ZOOM_STEP,
    fold: () => app.classList.toggle('folded'),
  });
  app.classList.toggle('folded', NARROW.matches);
  if (bare) return panel;
  scene.append(createDifferences(engine, state), tools.zoom, tools.fold,
    ...createSheet(engine, state, app, (message) => notes.say(message)));
  app.append(panel.panel);
  return panel;
}

/** @param {State} state */
async function copyLink(state) {
  const link = linkTo(state);
  if (await copyText(link)) return notes.say('The link is copied.');
  history.replaceState(null, '', link);
  notes.say('This browser does not let the page copy; the link is in the address bar.');
}

/** @param {Engine} engine @param {HTMLImageElement | null} image */
async function copySeen(engine, image) {
  try {
    const done = await copyPicture(await pictureOf(engine, image), engine.document?.name ?? 'vexture');
    notes.say(done === 'copied' ? 'The picture is copied.' : 'The picture is saved: this browser does not copy it.');
  } catch (error) {
    notes.say(`No picture: ${/** @type {Error} */ (error).message}`);
  }
}

/** @param {File[]} files @param {State} state @param {Library} library */
async function openFiles(files, state, library) {
  for (const file of files) {
    try {
      notes.keep('file', `Opening ${file.name}…`);
      let name = file.name.replace(/\.ktx2$/i, '');
      if (name !== file.name) name = await library.add(await file.arrayBuffer(), name);
      else name = await library.convert(file);
      notes.keep('file', '');
      state.update({ shape: name, drawing: '', ...HOME });
    } catch (error) {
      notes.keep('file', '');
      const { message } = /** @type {Error} */ (error);
      notes.say(message.startsWith(file.name) ? message : `${file.name}: ${message}`);
    }
  }
}

/** Notes about a shape while it is shown. @param {import('./library.js').Document} document */
function noteOf({ name, manifest }) {
  return manifest.note ?? (manifest.facts?.segments === 0 ? `Nothing is drawn in ${name}.` : '');
}

/**
 * Opens the shape that the state names, and follows it where it is live.
 *
 * @param {Engine} engine @param {State} state @param {Library} library @param {(name: string) => void} opened
 */
function opener(engine, state, library, opened) {
  let turn = 0;
  /** @type {import('./library.js').Document | null} */
  let current = null;
  const again = () => {
    if (!current) return;
    notes.keep('shape', noteOf(current));
    void engine.show(current);
  };
  const say = (/** @type {{message: string}} */ event) => notes.keep('shape', event.message);
  const offline = () => notes.keep('server', 'Offline: the server does not answer. The last picture stays.');
  const online = () => notes.keep('server', '');
  return async () => {
    const mine = ++turn;
    const wanted = state.value.shape;
    const name = library.names.includes(wanted) ? wanted : library.names[0];
    if (wanted && name !== undefined && name !== wanted) {
      notes.say(`There is no shape ${wanted} here.`);
      return state.update({ shape: name, drawing: '' });
    }
    try {
      if (name === undefined) throw new Error('There is nothing to show yet. Drop an SVG here, or open a file.');
      const next = await library.open(name);
      if (mine !== turn) return;
      if (current !== next) {
        for (const [texture, follow] of /** @type {const} */ ([
          [current?.texture, 'removeEventListener'], [next.texture, 'addEventListener'],
        ])) {
          texture?.[follow]('change', again);
          texture?.[follow]('note', say);
          texture?.[follow]('offline', offline);
          texture?.[follow]('online', online);
        }
        current = next;
      }
      opened(name);
      await engine.show(next);
      notes.keep('shape', noteOf(next));
    } catch (error) {
      notes.say(/** @type {Error} */ (error).message);
    }
  };
}

/** @param {State} state */
async function start(state) {
  const library = new Library(readScene());
  let engine;
  try {
    engine = new Engine(canvas, state);
  } catch {
    stage.append(element('p', { class: 'fatal', role: 'alert' },
      'This page draws with WebGL 2, which this browser does not offer. Try a newer browser, or switch on hardware '
      + 'acceleration in its settings.'));
    return;
  }
  viewer.engine = engine;
  const panel = build(engine, state, library);
  followTheme(state, engine);
  engine.addEventListener('lost', () => notes.keep('driver', 'The graphics driver was reset; waiting for it…'));
  engine.addEventListener('restored', () => notes.keep('driver', ''));
  const open = opener(engine, state, library, panel.setTitle);
  followLink(state, (message) => notes.say(message));
  notes.keep('start', 'Preparing the picture…');
  await library.start().catch((error) => notes.say(`The server cannot be reached: ${error.message}`));
  state.addEventListener('change', (event) => {
    if (/** @type {CustomEvent} */ (event).detail.changed.has('shape')) void open();
  });
  await open();
  notes.keep('start', '');
  if (linked === undefined) notes.say('This link is damaged; the whole shape is shown.');
  engine.render();
}

const linked = linkedView();
const state = new State(linked ?? START);
applyTheme(state.value.theme);
app.classList.toggle('bare', bare);
scene.append(stage, notes.element);
app.append(scene);

/** For tests and for the console. */
const viewer = {
  state,
  /** @type {Engine | null} */
  engine: null,
  /** @type {Promise<void> | null} */
  ready: null,
};
Object.assign(window, { vexture: { viewer } });
viewer.ready = start(state);
