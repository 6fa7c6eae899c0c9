/** The side panel: choice of shape, surface and comparison; and the page's buttons. */
import { element, section, select } from './dom.js';
import { drawingsIn } from './drawing.js';
import { BACKGROUND_NAMES, HOME, RIVAL_NAMES } from './state.js';

/**
 * @typedef {import('./state.js').State} State
 * @typedef {import('./engine.js').Engine} Engine
 */

/** @type {[import('./state.js').Mode, string][]} */
const SURFACES = [['flat', 'Flat'], ['plane', 'Plane'], ['sphere', 'Sphere'], ['cube', 'Cube']];

/** @type {[import('./state.js').Rival | '', string][]} */
const RIVALS = [['', 'Nothing'], .../** @type {[import('./state.js').Rival, string][]} */ (Object.entries(RIVAL_NAMES))];

/**
 * The list of shapes; hidden while there is only one.
 *
 * @param {State} state
 */
function shapesSection(state) {
  const list = element('ul', { 'aria-label': 'Shapes', role: 'list', class: 'shapes' });
  const box = section('Shapes', list);
  /** @type {string[]} */
  let names = [];
  const mark = () => {
    for (const button of list.querySelectorAll('button')) {
      const isShown = button.textContent === (state.value.shape || names[0]);
      const isNews = isShown && button.getAttribute('aria-current') !== 'true';
      button.setAttribute('aria-current', String(isShown));
      if (isNews) button.scrollIntoView({ block: 'nearest' });
    }
  };
  state.addEventListener('change', mark);
  const show = (/** @type {string[]} */ shown) => {
    names = shown;
    box.hidden = names.length < 2;
    list.replaceChildren(...names.map((name) => element('li', {}, element('button', {
      type: 'button', onclick: () => state.update({ shape: name, drawing: '', ...HOME }),
    }, name))));
    mark();
  };
  return { box, show };
}

/** Whether a rival is made from the drawing, which not every texture comes with. @param {string} rival */
const needsSource = (rival) => rival !== '' && rival !== 'raster';

/** What the choice of a colour of one's own is called among the backgrounds. */
const OWN = 'own';

/**
 * The choice of what lies below the picture.
 *
 * @param {State} state
 */
function backgroundRows(state) {
  const choices = /** @type {[string, string][]} */ ([...Object.entries(BACKGROUND_NAMES), [OWN, 'A colour…']]);
  const set = (/** @type {string} */ value) => {
    state.update({ background: /** @type {import('./state.js').Background} */ (value) });
  };
  const color = element('input', {
    type: 'color', 'aria-label': 'Colour of the background', value: '#7fb2e5', oninput: () => set(color.value),
  });
  const choice = select('Background', choices, (value) => set(value === OWN ? color.value : value));
  const own = element('div', { class: 'row', hidden: true }, element('span', {}, 'Its colour'), color);
  const follow = () => {
    const { background } = state.value;
    const isOwn = background.startsWith('#');
    choice.list.value = isOwn ? OWN : background;
    if (isOwn) color.value = background;
    own.hidden = !isOwn;
  };
  state.addEventListener('change', follow);
  follow();
  return [choice.row, own];
}

/**
 * @param {Engine} engine
 * @param {State} state
 */
function viewSection(engine, state) {
  const surface = select('Surface', SURFACES, (value) => {
    state.update({ mode: /** @type {import('./state.js').Mode} */ (value) });
  });
  const rival = select('Compare with', RIVALS, (value) => {
    state.update({ compare: /** @type {import('./state.js').Rival | null} */ (value || null) });
  });
  const why = element('p', { class: 'why', id: 'why-flat', hidden: true }, 'Comparisons are made on the flat surface.');
  rival.list.setAttribute('aria-describedby', 'why-flat');
  const drawing = select('Drawing', [], (value) => state.update({ drawing: value, ...HOME }));
  const follow = () => {
    surface.list.value = state.value.mode;
    rival.list.value = state.value.compare ?? '';
    rival.list.disabled = state.value.mode !== 'flat';
    why.hidden = !rival.list.disabled;
    drawing.list.value = state.value.drawing;
  };
  engine.addEventListener('shape', () => {
    const names = engine.texture ? drawingsIn(engine.texture).map(({ name }) => name) : [];
    drawing.list.replaceChildren(element('option', { value: '' }, `All ${names.length.toLocaleString('en')}`),
      ...names.map((name) => element('option', { value: name }, name)));
    drawing.row.hidden = names.length < 2;
    for (const option of rival.list.options) {
      option.disabled = needsSource(option.value) && !(option.value in (engine.document?.manifest.views ?? {}));
    }
    follow();
  });
  drawing.row.hidden = true;
  for (const row of [surface.row, rival.row, why]) row.classList.add('of-one');
  state.addEventListener('change', follow);
  follow();
  return { box: section('View', drawing.row, surface.row, ...backgroundRows(state), rival.row, why), rival: rival.list };
}

/**
 * @typedef {object} Action
 * @property {string} label
 * @property {() => void} act
 * @property {boolean} [ofOne] whether it needs a drawing that is shown
 */

/**
 * @param {Engine} engine
 * @param {State} state
 * @param {Action[]} actions buttons at its foot
 */
export function createPanel(engine, state, actions) {
  const title = element('h1', {}, 'vexture');
  const shapes = shapesSection(state);
  const view = viewSection(engine, state);
  const extras = element('div', { class: 'extras' });
  const buttons = actions.map(({ label, act, ofOne }) =>
    element('button', { type: 'button', class: ofOne ? 'of-one' : null, onclick: act }, label));
  const foot = element('div', { class: 'actions' }, ...buttons);
  const panel = element(
    'aside', { id: 'panel', class: 'panel', 'aria-label': 'Controls' }, title, shapes.box, view.box, extras, foot,
  );
  return { panel, extras, foot, rival: view.rival, showShapes: shapes.show, setTitle: (/** @type {string} */ name) => {
    title.textContent = name;
    document.title = `${name} · vexture`;
  } };
}

/**
 * Buttons over the picture: zoom, and the fold of the panel.
 *
 * @param {Engine} engine
 * @param {{zoom: (factor: number) => void, reset: () => void, fold: () => boolean, folded: boolean, step: number}} how
 */
export function createTools(engine, how) {
  const shown = element('span', { class: 'zoom' });
  const follow = () => {
    const { mode, zoom, distance } = engine.state.value;
    const value = mode === 'flat' ? zoom : distance;
    shown.textContent = `${value < 10 ? value.toFixed(1).replace(/\.0$/, '') : Math.round(value).toLocaleString('en')}×`;
  };
  engine.addEventListener('view', follow);
  follow();
  const tool = (/** @type {string} */ label, /** @type {string} */ sign, /** @type {() => void} */ act) =>
    element('button', { type: 'button', 'aria-label': label, title: label, onclick: act }, sign);
  const zoom = element(
    'div', { class: 'tools', role: 'group', 'aria-label': 'Zoom' },
    tool('Zoom out', '−', () => how.zoom(1 / how.step)), shown, tool('Zoom in', '+', () => how.zoom(how.step)),
    tool('Reset view', '⌂', how.reset),
  );
  const fold = element('button', {
    type: 'button', class: 'fold', 'aria-controls': 'panel', 'aria-expanded': !how.folded ? 'true' : 'false',
    onclick: () => fold.setAttribute('aria-expanded', String(!how.fold())),
  }, 'Controls');
  return { zoom, fold };
}
