/** The texture's contents: its texels as a picture, the meaning of each, and its place in the drawing. */
import { chosenLayer } from './chosen-layer.js';
import { element, section } from './dom.js';
import { RIVAL_NAMES } from './state.js';
import { paintTexels } from './texel-image.js';
import { TexelMap, folded } from './texel-map.js';
import { cellRect, svgLayer } from './svg.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 */

/** Largest number of texels shown, from the root of the chosen shape on. */
const MOST_SHOWN = 1 << 16;
const MOST_COLUMNS = 256;
/** Least and largest size of a texel in CSS pixels. */
const LEAST_TEXEL = 4;
const MOST_TEXEL = 16;

/** @type {Record<string, [dx: number, dy: number]>} */
const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/**
 * @param {Engine} engine
 * @param {State} state
 */
export function create(engine, state) {
  const chosen = chosenLayer(engine);
  const layer = svgLayer(engine, 'contents-layer');
  const button = element('button', {
    type: 'button', title: 'The texels of the texture as a picture',
    onclick: () => state.updateOverlays({ contents: !state.overlays.contents }),
  }, 'Texture contents');
  const image = element('canvas', { class: 'texels', tabindex: 0, role: 'application',
    'aria-label': 'Texels. Arrow keys go from one to the next.' });
  const mark = element('span', { class: 'texel-mark' });
  const scroll = element('div', { class: 'texel-scroll' }, element('div', { class: 'texel-box' }, image, mark));
  const summary = element('p', { class: 'hint' });
  const text = element('div', { class: 'texel', 'aria-live': 'polite' });
  const pair = element('div', { class: 'thesis-images' });
  const box = element('div', {}, summary, scroll, text, pair);
  /** @type {TexelMap | null} */
  let map = null;
  let first = 0;
  let shown = 0;
  let columns = 1;
  let texelSize = LEAST_TEXEL;
  let selected = -1;

  function paint() {
    const { data, root } = chosen;
    const isOpen = state.overlays.contents;
    button.setAttribute('aria-pressed', String(isOpen));
    box.hidden = !isOpen;
    if (!isOpen || !data || !root) {
      map = null;
      select(-1);
      return;
    }
    if (map?.data === data && map.root === root.quad) {
      highlight();
      return;
    }
    map = new TexelMap(data, root.quad, MOST_SHOWN);
    ({ first, count: shown } = map);
    const wanted = 2 ** Math.ceil(Math.log2(Math.sqrt(shown)) + 0.5);
    columns = folded(shown, Math.min(wanted, MOST_COLUMNS)).columns;
    texelSize = Math.min(Math.max(Math.floor(264 / columns), LEAST_TEXEL), MOST_TEXEL);
    paintTexels(image, map, first, shown, columns);
    image.style.width = `${columns * texelSize}px`;
    summary.textContent = `${data.width} × ${data.height} texels`
      + (shown < data.texels.length / 4 ? `, of which ${first} to ${first + shown - 1} are shown` : '')
      + (columns < data.width ? `, in rows of ${columns} here` : '')
      + `. Blue: quads; orange: curves${map.head ? '; green: means and base paints of cells; violet: sides of curves; red: paints' : ''}`
      + `${data.roots.length > 1 ? ' of the layer; grey: other layers' : ''}.`;
    select(-1);
  }

  /** @param {number} index of a texel; -1: none */
  function select(index) {
    selected = index;
    const texel = map && index >= 0 ? map.texel(index) : null;
    mark.hidden = !texel;
    text.replaceChildren(...(texel ? describe(texel) : []));
    if (texel) {
      const at = index - first;
      mark.style.cssText = `left: ${(at % columns) * texelSize}px; top: ${Math.floor(at / columns) * texelSize}px; `
        + `width: ${texelSize}px; height: ${texelSize}px`;
    }
    highlight();
  }

  function highlight() {
    const place = map && selected >= 0 && state.value.mode === 'flat' ? map.texel(selected).place : null;
    layer.replaceChildren(...(place ? [cellRect((u, v) => engine.toScreen(u, v), place, 'texel-cell')] : []));
  }

  function showPair() {
    const { compare } = state.value;
    const which = compare === 'thesis16' || compare === 'thesis8' ? compare : null;
    const urls = which ? engine.document?.manifest.views?.[which] : null;
    const images = Array.isArray(urls) && which ? urls.map((url, i) => element('figure', {},
      element('img', { src: new URL(url, engine.document?.base ?? document.baseURI).href, alt:
        `${i ? 'Curves' : 'Quads'} of the ${RIVAL_NAMES[which]}` }),
      element('figcaption', {}, `${RIVAL_NAMES[which]}: ${i ? 'curves' : 'quads'}`))) : [];
    pair.replaceChildren(...images);
  }

  image.addEventListener('pointermove', ({ offsetX, offsetY }) => {
    const column = Math.floor(offsetX / texelSize);
    const at = column + columns * Math.floor(offsetY / texelSize);
    if (column >= 0 && column < columns && at >= 0 && at < shown) select(first + at);
  });
  image.addEventListener('keydown', (event) => {
    const step = KEYS[event.key];
    if (!step) return;
    event.preventDefault();
    const at = selected < 0 ? 0 : selected - first + step[0] + columns * step[1];
    if (at >= 0 && at < shown) select(first + at);
  });
  image.addEventListener('pointerleave', () => select(-1));
  image.addEventListener('blur', () => select(-1));
  state.addEventListener('change', (event) => {
    const { changed } = /** @type {CustomEvent} */ (event).detail;
    if (changed.has('overlays')) paint();
    if (changed.has('compare')) showPair();
  });
  chosen.addEventListener('change', paint);
  engine.addEventListener('view', highlight);
  engine.addEventListener('shape', showPair);
  paint();
  showPair();
  return section('Texture', element('div', { class: 'buttons' }, button), box);
}

/** @param {import('./texel-map.js').Texel} texel */
function describe({ index, kind, place, words }) {
  const what = {
    quad: 'a quad', curve: 'a curve', other: 'of another layer', unused: 'not used', head: 'head of the map',
    means: 'mean colours of cells', bases: 'base paints of cells', sides: 'paints beside curves', paints: 'colours of paints',
    operations: 'operations of a program', stops: 'stops of gradients',
  }[kind];
  const where = place ? `, depth ${place.depth}, at ${place.x}, ${place.y}` : '';
  return [
    element('p', {}, `Texel ${index}: ${what}${where}`),
    element('ol', { start: 0 }, ...words.map((word) => element('li', {}, word))),
  ];
}
