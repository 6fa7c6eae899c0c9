/** Switches of the overlays, and their legend. */
import { Color } from 'three';
import { MOST_DEPTH } from '../generated/layout.js';
import { headOf, meansAt, quadsInBlock } from '../src/planar-map.js';
import { counts } from '../src/walk.js';
import { chosenLayer } from './chosen-layer.js';
import { element, section, select } from './dom.js';
import { OPACITY, RAMPS, css, depthRamp } from './overlay-palette.js';
import { watchPointer } from './pointer.js';
import { MOST_CUTOFF } from './state.js';

/**
 * @typedef {import('./engine.js').Engine} Engine
 * @typedef {import('./state.js').State} State
 * @typedef {'cells' | 'coverage' | 'depth'} Switch
 */

/** @type {readonly (readonly [Switch, string, string])[]} */
const SWITCHES = [
  ['cells', 'Cells', 'Borders of the quads and leaves'],
  ['coverage', 'Coverage', 'The coverage that is stored for each cell'],
  ['depth', 'Depth', 'How deep in the tree each leaf is'],
];

const FOLLOW = 'follow';
/** Keys of the state that the switches depend on. */
const SHOWN = ['overlays', 'mode', 'background'];

const ONLY_FLAT = 'Cells and what is in them are shown in the flat view.';

/**
 * @param {Engine} engine
 * @param {State} state
 */
export function create(engine, state) {
  const uniforms = makeUniforms(engine);
  const chosen = chosenLayer(engine);
  const buttons = SWITCHES.map(([key, label, title]) =>
    element('button', { type: 'button', title, onclick: () => state.updateOverlays({ [key]: !state.overlays[key] }) },
      label));
  const cutoff = element('input', {
    type: 'range', min: 0, max: MOST_CUTOFF, step: 0.5, value: 0, 'aria-label': 'MIP cut-off',
    title: 'As if pixels were larger: quads smaller than those show what is stored for them',
    oninput: () => state.updateOverlays({ cutoff: Number(cutoff.value) }),
  });
  const cutoffText = element('output', { class: 'value' });
  const layer = select('Layer', [[FOLLOW, 'Under the pointer']], (value) => {
    chosen.choose(value === FOLLOW ? null : Number(value));
    update();
  });
  const layerText = element('p', { class: 'hint' });
  const legend = element('div', { class: 'legend' });
  const reason = element('p', { class: 'hint' }, ONLY_FLAT);
  const all = element('fieldset', { class: 'plain' },
    element('div', { class: 'buttons' }, ...buttons),
    element('label', { class: 'row' }, element('span', {}, 'MIP cut-off'), cutoff, cutoffText),
    layer.row, layerText, legend);

  let deepest = 1;

  function update() {
    const { overlays, mode } = state.value;
    const root = chosen.root;
    all.disabled = mode !== 'flat';
    reason.hidden = mode === 'flat';
    SWITCHES.forEach(([key], i) => buttons[i].setAttribute('aria-pressed', String(overlays[key])));
    cutoff.value = String(overlays.cutoff);
    const times = Math.round(10 * 2 ** overlays.cutoff) / 10;
    cutoffText.value = overlays.cutoff > 0 ? `${times} px` : 'off';
    cutoff.setAttribute('aria-valuetext', overlays.cutoff > 0 ? `pixels ${times} times as large` : 'off');
    layer.list.value = chosen.follows ? FOLLOW : String(chosen.index);
    layerText.textContent = root && chosen.layers.length > 1 ? `Shown: ${root.name}` : '';
    const theme = engine.backdrop.isDark ? 'dark' : 'light';
    setUniforms(uniforms, overlays, theme, deepest);
    setShape(uniforms, chosen.data, root);
    legend.replaceChildren(...legendRows(overlays, theme, deepest, root?.isMap ?? false));
    engine.requestFrame();
  }

  function descend() {
    const { data, root } = chosen;
    deepest = data && root ? counts(data, root.quad).depth + 1 : 1;
    update();
  }

  function listLayers() {
    const { layers, data } = chosen;
    const rows = layers.map((index) => element('option', { value: index }, data?.roots[index].name ?? ''));
    layer.list.replaceChildren(element('option', { value: FOLLOW }, 'Under the pointer'), ...rows.reverse());
    layer.row.hidden = layers.length < 2;
    layerText.hidden = layer.row.hidden;
    descend();
  }

  watchPointer(engine, (px, py) => {
    const { cells, coverage, depth, cutoff: levels, inspect, contents } = state.overlays;
    const at = cells || coverage || depth || levels > 0 || inspect || contents ? engine.toUnit(px, py) : null;
    if (at) chosen.point(...at);
  });
  state.addEventListener('change', (event) => {
    const { changed } = /** @type {CustomEvent<{changed: Set<string>}>} */ (event).detail;
    if (SHOWN.some((key) => changed.has(key))) update();
  });
  chosen.addEventListener('change', descend);
  engine.addEventListener('shape', listLayers);
  const stage = /** @type {HTMLElement} */ (engine.canvas.parentElement);
  new MutationObserver(update).observe(stage, { attributeFilter: ['data-theme'] });
  listLayers();
  return section('Overlays', all, reason);
}

/** @param {Engine} engine */
function makeUniforms(engine) {
  const uniforms = {
    vextureOverlayRoot: { value: 0 },
    vextureOverlayOfMap: { value: false },
    vextureOverlayMeans: { value: [0, 0] },
    vextureOverlayShow: { value: [0, 0, 0] },
    vextureOverlayCutoff: { value: 0 },
    vextureOverlayCoverage: { value: [new Color(), new Color()] },
    vextureOverlayStored: { value: [new Color(), new Color()] },
    vextureOverlayDepth: { value: Array.from({ length: MOST_DEPTH + 1 }, () => new Color()) },
  };
  Object.assign(engine.overlayUniforms, uniforms);
  return uniforms;
}

/**
 * @param {ReturnType<typeof makeUniforms>} uniforms
 * @param {import('./state.js').Overlays} overlays
 * @param {'light' | 'dark'} theme
 * @param {number} deepest
 */
function setUniforms(uniforms, overlays, theme, deepest) {
  uniforms.vextureOverlayShow.value = SWITCHES.map(([key]) => (overlays[key] ? OPACITY[key] : 0));
  uniforms.vextureOverlayCutoff.value = overlays.cutoff;
  RAMPS[theme].coverage.forEach((color, i) => uniforms.vextureOverlayCoverage.value[i].fromArray(color));
  RAMPS[theme].stored.forEach((color, i) => uniforms.vextureOverlayStored.value[i].fromArray(color));
  const ramp = depthRamp(deepest);
  uniforms.vextureOverlayDepth.value.forEach((color, depth) => color.fromArray(ramp[Math.min(depth, deepest)]));
}

/**
 * @param {ReturnType<typeof makeUniforms>} uniforms
 * @param {import('../src/data.js').PackedData | null} data
 * @param {import('../src/data.js').Root | null} root
 */
function setShape(uniforms, data, root) {
  const quad = root?.quad ?? 0;
  uniforms.vextureOverlayRoot.value = quad;
  uniforms.vextureOverlayOfMap.value = root?.isMap ?? false;
  if (data && root?.isMap) {
    const head = headOf(data.texels, quad);
    uniforms.vextureOverlayMeans.value = [meansAt(head, quad), Math.log2(quadsInBlock(head.used))];
  }
}

/**
 * @param {import('./state.js').Overlays} overlays
 * @param {'light' | 'dark'} theme
 * @param {number} deepest
 * @param {boolean} isMap whether mean colours are shown instead of coverages
 */
function legendRows(overlays, theme, deepest, isMap) {
  const rows = [];
  const means = (overlays.coverage || overlays.cutoff > 0) && isMap;
  if (means) rows.push(element('p', { class: 'hint' }, 'Mean colours of cells, as they are stored'));
  if (overlays.coverage && !isMap) rows.push(gradient('Coverage of a cell', RAMPS[theme].coverage));
  if (overlays.cutoff > 0 && !isMap) rows.push(gradient('Stored for a quad', RAMPS[theme].stored));
  if (overlays.depth) {
    const swatches = depthRamp(deepest).slice(1).map((color, i) =>
      element('li', {}, element('span', { class: 'swatch', style: `background: ${css(color)}` }), String(i + 1)));
    rows.push(element('div', { class: 'legend-row' }, element('span', {}, 'Depth of a leaf'),
      element('ol', { class: 'swatches', 'aria-label': 'Colours of depths' }, ...swatches)));
  }
  return rows;
}

/** @param {string} label @param {[import('./overlay-palette.js').Rgb, import('./overlay-palette.js').Rgb]} ramp */
function gradient(label, [low, high]) {
  const bar = element('span', { class: 'ramp', style: `background: linear-gradient(to right, ${css(low)}, ${css(high)})` });
  return element('div', { class: 'legend-row' }, element('span', {}, label),
    element('span', { class: 'ramp-row' }, '0 ', bar, ' 1'));
}
