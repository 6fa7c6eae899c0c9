/** Files of what is shown: a PNG with opacity, of any size, and an SVG. */
import { saveFile } from './copy.js';
import { element, section, select } from './dom.js';
import { bytesOf } from './library.js';
import { LEAST_SIDE, mostSide, partOf, pictureFile } from './picture.js';
import { svgText } from './svg-text.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 */

const START_SIZE = 1024;
const WHOLE = 'whole';
const VIEW = 'view';
const SVG_TITLE = 'The outlines as curves, for any drawing program';
const NO_OUTLINES = 'The colours of this drawing are in one map, which has no outlines, and its source is not here: '
  + 'open the source, or a texture made with --split paint';

/**
 * Where the source of the drawing is, if all of it is what is shown.
 *
 * @param {Engine} engine
 * @returns {string | null}
 */
function sourceOf({ document: opened }) {
  const svg = opened?.manifest.views?.svg;
  return typeof svg === 'string' && !opened?.manifest.facts?.select ? svg : null;
}

/** The roots of what is shown. @param {import('./drawing.js').ShownDrawing} drawing */
const layersOf = ({ texture, first, count }) => texture.roots.slice(first, first + count);

/**
 * The source, if it is known, else the outlines in the texture.
 *
 * @param {Engine} engine
 * @param {import('./drawing.js').ShownDrawing} drawing
 */
async function svgFile(engine, drawing) {
  const source = sourceOf(engine);
  const content = source ? await bytesOf(source, engine.document?.base ?? document.baseURI)
    : svgText(drawing.texture.data, layersOf(drawing), drawing.name);
  return new Blob([content], { type: 'image/svg+xml' });
}

/** What is shown, as a part of the unit square. @param {Engine} engine @param {string} choice */
function partShown(engine, choice) {
  if (choice === VIEW) return { view: engine.state.value, size: engine.size };
  return partOf(engine.document?.manifest.facts?.box ?? [0, 0, 1, 1]);
}

/**
 * @param {Engine} engine
 * @param {State} state
 * @param {(message: string) => void} note
 */
export function createSave(engine, state, note) {
  const size = element('input', {
    type: 'number', min: LEAST_SIDE, max: mostSide(engine), step: 1, value: START_SIZE, inputmode: 'numeric',
    title: `Longer side of the picture, ${LEAST_SIDE} to ${mostSide(engine).toLocaleString('en')} pixels`,
  });
  const what = select('Part', [[WHOLE, 'Whole drawing'], [VIEW, 'This view']], () => {});
  /** @param {string} suffix @param {(drawing: import('./drawing.js').ShownDrawing) => Promise<Blob>} make */
  const save = async (suffix, make) => {
    const { drawing, document: opened } = engine;
    if (!drawing || !opened) return;
    const name = drawing.texture.roots.length === drawing.count ? opened.name : drawing.name;
    try {
      saveFile(await make(drawing), name, suffix);
    } catch (error) {
      note(`No ${suffix.toUpperCase()}: ${/** @type {Error} */ (error).message}`);
    }
  };
  const png = element('button', {
    type: 'button', title: 'A picture with nothing below it, with its opacity', onclick: async () => {
      png.disabled = true;
      await save('png', () => pictureFile(engine, partShown(engine, what.list.value), Number(size.value)));
      png.disabled = false;
    },
  }, 'Save PNG');
  const svg = element('button', {
    type: 'button', onclick: () => void save('svg', (drawing) => svgFile(engine, drawing)),
  }, 'Save SVG');
  const follow = () => {
    const isFlat = state.value.mode === 'flat';
    what.list.options[1].disabled = !isFlat;
    if (!isFlat) what.list.value = WHOLE;
    svg.disabled = !engine.drawing || (!sourceOf(engine) && layersOf(engine.drawing).some(({ isMap }) => isMap));
    svg.title = svg.disabled ? NO_OUTLINES : SVG_TITLE;
  };
  state.addEventListener('change', follow);
  engine.addEventListener('shape', follow);
  follow();
  return section('Save', element('label', { class: 'row' }, element('span', {}, 'PNG, pixels'), size), what.row,
    element('div', { class: 'buttons' }, png, svg));
}
