/** Entry of the page: reads what is dropped, pasted or typed, converts it, and shows it with its sizes. */
import fontBytes from '@fontsource/pacifico/files/pacifico-latin-400-normal.woff';
import maps from 'playground-maps';
import silhouettes from 'playground-silhouettes';
import strokes from 'playground-strokes';
import workerText from 'playground-worker';
import samples from './samples/index.js';
import { VectorTexture } from '../src/index.js';
import { Converter, convertData, readGeojson, readSvg, writePacked } from '../src/convert/index.js';
import { drawEqualPng } from './png.js';
import { SNIPPETS } from './snippets.js';
import { Words, givenOf, svgOf } from './sources.js';
import { Stage } from './stage.js';

/** @import { Drawing, ConvertedData } from '../src/convert/index.js' */
/** @import { Given } from './sources.js' */

/** @template {HTMLElement} T @param {string} id @returns {T} */
const byId = (id) => /** @type {T} */ (document.getElementById(id));

const [input, word, text, samplesRow, canvas, status, error, split, facts, download, copy, tabs, code] = [
  'file', 'word', 'text', 'samples', 'canvas', 'status', 'error', 'split', 'facts', 'download', 'copy', 'tabs', 'code',
].map((id) => /** @type {any} */ (byId(id)));

/** Luminance of the paint from which a drawing gets a dark paper. */
const LIGHT = 0.75;

const stage = new Stage(canvas);
const words = new Words(fontBytes.buffer);
const kernels = { silhouettes, maps, strokes };
const converter = new Converter({ kernels, worker: () => new Worker(URL.createObjectURL(new Blob([workerText], { type: 'text/javascript' }))) });

let latest = new AbortController();
let file = new Uint8Array(0);
let name = 'drawing';
let snippet = SNIPPETS[0];
/** @type {VectorTexture | null} */
let texture = null;

/** @param {Given | Promise<Given>} given */
async function show(given) {
  latest.abort();
  latest = new AbortController();
  const { signal } = latest;
  say('Converting ...');
  try {
    const source = await given;
    const start = performance.now();
    const drawing = await readDrawing(source);
    const read = performance.now();
    const data = await convertData(drawing, { signal, converter });
    const converted = performance.now();
    const packed = await writePacked(data);
    signal.throwIfAborted();
    say('Drawing a PNG of equal bytes ...');
    const isSvg = source.text.trimStart().startsWith('<');
    const png = await drawEqualPng(isSvg ? source.text : svgOf(drawing), packed.length);
    signal.throwIfAborted();
    const before = texture;
    texture = new VectorTexture(data);
    stage.show(texture, png.canvas, isLight(drawing) ? 'dark' : 'light', subjectOf(png.canvas));
    before?.dispose();
    [file, name] = [packed, source.name];
    showFacts(source, data, png, { read: read - start, convert: converted - read });
    showCode();
    download.disabled = copy.disabled = false;
    say('');
  } catch (wrong) {
    if (!signal.aborted) say('', wrong instanceof Error ? wrong.message : String(wrong));
  }
}

/** @param {Given} given @returns {Promise<Drawing>} */
function readDrawing({ text, name }) {
  return text.trimStart().startsWith('{') ? readGeojson(text, { name }) : readSvg(text, { name, converter });
}

/**
 * Show what is going on, or what went wrong.
 *
 * @param {string} message
 * @param {string} [wrong]
 */
function say(message, wrong = '') {
  Object.assign(status, { textContent: message, hidden: !message });
  Object.assign(error, { textContent: wrong, hidden: !wrong });
  document.documentElement.dataset.state = wrong ? 'error' : message ? 'busy' : 'shown';
}

/** @param {number} bytes */
const inBytes = (bytes) => (bytes < 1000 ? `${bytes} B` : bytes < 1e6 ? `${(bytes / 1000).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(2)} MB`);

/**
 * @param {Given} source
 * @param {ConvertedData} data
 * @param {import('./png.js').EqualPng} png
 * @param {{ read: number, convert: number }} times in ms
 */
function showFacts(source, data, png, times) {
  const rows = [
    [inBytes(new TextEncoder().encode(source.text).length), 'the source'],
    [inBytes(file.length), 'the vector texture, .ktx2'],
    [inBytes(data.texels.byteLength), 'on the graphics card'],
    [`${png.size} x ${png.size} px`, `the PNG, ${inBytes(png.bytes)}`],
    [`${Math.round(times.read)} + ${Math.round(times.convert)} ms`, 'to read and to convert it'],
  ];
  facts.replaceChildren(...rows.map(([value, label]) => {
    const fact = Object.assign(document.createElement('div'), { className: 'fact' });
    fact.append(Object.assign(document.createElement('b'), { textContent: value }), Object.assign(document.createElement('span'), { textContent: label }));
    return fact;
  }));
  if (!data.notes.length) return;
  const list = Object.assign(document.createElement('ul'), { className: 'notes' });
  for (const { kind, message, count } of data.notes) {
    const line = kind === 'remark' ? message : `${kind}: ${message}${count > 1 ? ` (${count})` : ''}`;
    list.append(Object.assign(document.createElement('li'), { textContent: line }));
  }
  facts.append(list);
}

/** @param {Drawing} drawing */
function isLight({ paths }) {
  const luminances = paths.map(({ paint: { color: [red, green, blue] } }) => 0.21 * red + 0.72 * green + 0.07 * blue);
  return luminances.length > 0 && luminances.every((one) => one > LIGHT);
}

/**
 * Where the colours of a picture change most, weighted towards its middle: something to see under the magnifier.
 *
 * @param {HTMLCanvasElement} picture
 * @returns {{ x: number, y: number }} in the unit square
 */
function subjectOf(picture) {
  const { width, height } = picture;
  const { data } = /** @type {CanvasRenderingContext2D} */ (picture.getContext('2d')).getImageData(0, 0, width, height);
  let best = { x: 0.5, y: 0.5, change: 0 };
  for (let row = 1; row < height; row++) {
    for (let column = 1; column < width; column++) {
      const at = 4 * (row * width + column);
      let change = 0;
      for (let c = at; c < at + 4; c++) change += Math.abs(data[c] - data[c - 4]) + Math.abs(data[c] - data[c - 4 * width]);
      const [x, y] = [column / width, 1 - row / height];
      change *= 1 - Math.hypot(x - 0.5, y - 0.5);
      if (change > best.change) best = { x, y, change };
    }
  }
  return best;
}

function showCode() {
  tabs.replaceChildren(...SNIPPETS.map((one) => {
    const tab = Object.assign(document.createElement('button'), { type: 'button', textContent: one.name });
    tab.setAttribute('role', 'tab');
    tab.setAttribute('aria-selected', String(one === snippet));
    tab.addEventListener('click', () => {
      snippet = one;
      showCode();
    });
    return tab;
  }));
  code.textContent = snippet.code(fileName());
}

const fileName = () => `${name.replace(/[^\p{L}\p{N} ._-]/gu, '_')}.ktx2`;

/** @param {File} dropped */
async function open(dropped) {
  if (!Words.isFont(dropped)) return show(givenOf(dropped));
  return show(words.use(dropped).then(() => outlined(word.value || 'Harbour')));
}

/** The SVG of a word; a font without its letters is an error of the page, not of the event. @param {string} letters */
const outlined = async (letters) => words.svgOf(letters);

byId('open').addEventListener('click', () => input.click());
input.addEventListener('change', () => {
  if (input.files[0]) open(input.files[0]);
  input.value = '';
});
word.addEventListener('input', () => word.value.trim() && show(outlined(word.value)));
text.addEventListener('input', () => text.value.trim() && show({ name: 'pasted', text: text.value }));
byId('input').addEventListener('submit', (event) => event.preventDefault());
split.addEventListener('input', () => {
  stage.split = split.value / 100;
  stage.draw();
});
download.addEventListener('click', () => {
  const url = URL.createObjectURL(new Blob([file], { type: 'image/ktx2' }));
  Object.assign(document.createElement('a'), { href: url, download: fileName() }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
});
copy.addEventListener('click', async () => {
  try {
    await navigator.clipboard.writeText(code.textContent);
  } catch { // where there is no clipboard, as on pages from the disk
    getSelection()?.selectAllChildren(code);
    document.execCommand('copy');
  }
  copy.textContent = 'Copied';
  setTimeout(() => (copy.textContent = 'Copy the code'), 1500);
});

addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('dropping');
});
addEventListener('dragleave', () => document.body.classList.remove('dropping'));
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  const [dropped] = event.dataTransfer?.files ?? [];
  const dragged = event.dataTransfer?.getData('text/plain') ?? '';
  if (dropped) open(dropped);
  else if (dragged.trim()) show({ name: 'dropped', text: dragged });
});
addEventListener('paste', (event) => {
  if (event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
  const [pasted] = event.clipboardData?.files ?? [];
  const copied = event.clipboardData?.getData('text/plain') ?? '';
  if (pasted) open(pasted);
  else if (copied.trim()) show({ name: 'pasted', text: copied });
});

listenToGestures();
for (const sample of samples) {
  const button = Object.assign(document.createElement('button'), { type: 'button', textContent: sample.name });
  button.addEventListener('click', () => show(sample));
  samplesRow.append(button);
}
download.disabled = copy.disabled = true;
showCode();
show(samples[0]);

/** The magnifier moves with a finger or the mouse, zooms with two fingers, the wheel or keys. */
function listenToGestures() {
  /** @type {Map<number, { x: number, y: number }>} */
  const pointers = new Map();
  const placeOf = (/** @type {MouseEvent} */ { clientX, clientY }) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { x: clientX - left, y: clientY - top };
  };
  canvas.addEventListener('pointerdown', (/** @type {PointerEvent} */ event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, placeOf(event));
  });
  for (const type of ['pointerup', 'pointercancel']) canvas.addEventListener(type, (/** @type {PointerEvent} */ { pointerId }) => pointers.delete(pointerId));
  canvas.addEventListener('pointermove', (/** @type {PointerEvent} */ event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = placeOf(event);
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) stage.zoom(distance(now, other) / Math.max(distance(before, other), 1), other);
    else stage.move(now.x - before.x, now.y - before.y);
    pointers.set(event.pointerId, now);
  });
  canvas.addEventListener('wheel', (/** @type {WheelEvent} */ event) => {
    const { x, y } = placeOf(event);
    const { left, top, width, height } = stage.lens;
    if (x < left || x > left + width || y < top || y > top + height) return; // beside the magnifier the page scrolls
    event.preventDefault();
    stage.zoom(2 ** (-event.deltaY / 300), { x, y });
  }, { passive: false });
  const step = 40;
  /** @type {Record<string, () => void>} */
  const keys = {
    '+': () => stage.zoom(1.5), '=': () => stage.zoom(1.5), '-': () => stage.zoom(1 / 1.5),
    ArrowLeft: () => stage.move(step, 0), ArrowRight: () => stage.move(-step, 0),
    ArrowUp: () => stage.move(0, step), ArrowDown: () => stage.move(0, -step),
  };
  canvas.addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
    if (!(event.key in keys) || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
  });
}

/** @param {{ x: number, y: number }} one @param {{ x: number, y: number }} other */
function distance(one, other) {
  return Math.hypot(one.x - other.x, one.y - other.y);
}
