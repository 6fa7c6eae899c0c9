// Texts of vexture and of troika-three-text in one page: times of frames and of words, and what they need.
import * as THREE from 'three';
import { BatchedText, Glyphs, Text } from 'vexture/text';
import { BatchedText as BatchedTroika, Text as Troika } from 'troika-three-text';

const SIDE = 1000;
const WORDS = 'the quick brown fox jumps over the lazy dog while many small harbours sleep and ships wait for the tide to turn'.split(' ');
const FONT = new URL('font.ttf', location.href).href;

const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setPixelRatio(1);
renderer.setSize(SIDE, SIDE);
renderer.debug.checkShaderErrors = false;
document.body.append(renderer.domElement);
const camera = new THREE.OrthographicCamera(0, SIDE, SIDE, 0, -1000, 1000);
const kernels = Object.fromEntries(['silhouettes', 'maps', 'strokes'].map((name) => [name, `kernels/${name}.wasm`]));
const makeGlyphs = () => new Glyphs({ kernels, worker: () => new Worker('worker.js', { type: 'module' }) });
let glyphs = makeGlyphs();

const own = { make: () => new Text({ glyphs, font: FONT }), sync: (text) => text.sync() };
const troika = {
  make: () => Object.assign(new Troika(), { font: FONT }),
  sync: (text) => new Promise((resolve) => text.sync(resolve)),
};
const KINDS = { vexture: own, troika };

const gl = renderer.getContext(), pixel = new Uint8Array(4);

// Milliseconds of a frame, until the driver has drawn it.
function frame(scene, seen = camera) {
  const start = performance.now();
  renderer.render(scene, seen);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return performance.now() - start;
}

function emptyScene() {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xffffff);
  return scene;
}

// Forty lines of 20 px, and the times of frames in turns.
async function lines(repeat) {
  const scenes = {};
  for (const [name, { make, sync }] of Object.entries(KINDS)) {
    scenes[name] = emptyScene();
    const texts = Array.from({ length: 40 }, (_, k) => Object.assign(make(), {
      text: Array.from({ length: 16 }, (__, n) => WORDS[(7 * k + 3 * n) % WORDS.length]).join(' '), fontSize: 20, color: 0x000000,
    }));
    texts.forEach((text, k) => text.position.set(10, SIDE - 10 - 24 * k, 0));
    scenes[name].add(...texts);
    await Promise.all(texts.map(sync));
  }
  const times = { vexture: [], troika: [] };
  for (let k = -3; k < repeat; k++) for (const [name, scene] of Object.entries(scenes)) {
    const taken = frame(scene);
    if (k >= 0) times[name].push(taken);
  }
  return times;
}

// A word after another: milliseconds until it is set, and of the frame that shows it.
async function words(repeat) {
  const times = { vexture: [], troika: [] }, frames = { vexture: [], troika: [] };
  for (const [name, { make, sync }] of Object.entries(KINDS)) {
    const scene = emptyScene(), text = Object.assign(make(), { fontSize: 40, color: 0x000000 });
    text.position.set(100, 500, 0);
    scene.add(text);
    for (let k = -20; k < repeat; k++) {
      text.text = `${WORDS[(k + 20) % WORDS.length]} ${10_000 + k}`;
      const start = performance.now();
      await sync(text);
      const taken = performance.now() - start, shown = frame(scene);
      if (k < 0) continue;
      times[name].push(taken);
      frames[name].push(shown);
    }
  }
  return { times, frames };
}

// Labels of twelve characters: milliseconds until all are ready, and of frames in which all move.
async function labels(count, repeat) {
  const seen = new THREE.PerspectiveCamera(50, 1, 0.1, 1000);
  seen.position.z = 150;
  const places = Array.from({ length: count }, (_, k) => [100 * Math.sin(k), 100 * Math.sin(1.7 * k + 1), 50 * Math.sin(2.3 * k + 2)]);
  const texts = places.map((_, k) => `Label ${100_000 + k}`);
  const found = {};
  {
    const scene = emptyScene(), batch = new BatchedText({ glyphs, font: FONT, fontSize: 1 }), start = performance.now();
    const all = texts.map((text, k) => batch.addLabel({ text, position: places[k], color: 0x000000 }));
    await batch.sync();
    scene.add(batch);
    const ready = performance.now() - start, frames = [];
    for (let k = -2; k < repeat; k++) {
      for (const label of all) label.position.x += 0.01;
      const taken = frame(scene, seen);
      if (k >= 0) frames.push(taken);
    }
    found.vexture = { ready, frames };
    batch.dispose();
  }
  {
    const scene = emptyScene(), batch = new BatchedTroika(), start = performance.now();
    const all = texts.map((text, k) => {
      const one = Object.assign(new Troika(), { text, font: FONT, fontSize: 1, color: 0x000000 });
      one.position.fromArray(places[k]);
      batch.addText(one);
      return one;
    });
    await new Promise((resolve) => batch.sync(resolve));
    scene.add(batch);
    const ready = performance.now() - start, frames = [];
    for (let k = -2; k < repeat; k++) {
      for (const one of all) one.position.x += 0.01;
      const taken = frame(scene, seen);
      if (k >= 0) frames.push(taken);
    }
    found.troika = { ready, frames };
    batch.dispose();
  }
  return found;
}

// From nothing to a frame with three sizes, in a page that was just opened.
async function first(name) {
  const { make, sync } = KINDS[name], scene = emptyScene(), start = performance.timeOrigin + performance.now();
  const texts = [14, 40, 200].map((fontSize, k) => Object.assign(make(), { text: 'Harbour ffi Ωλ', fontSize, color: 0x000000 }));
  texts.forEach((text, k) => text.position.set(20, [950, 880, 700][k], 0));
  scene.add(...texts);
  await Promise.all(texts.map(sync));
  frame(scene);
  return performance.timeOrigin + performance.now() - start;
}

// Milliseconds until some characters of a large font are set, in new glyphs; and bytes of each on the GPU.
async function characters(font, text) {
  const fresh = makeGlyphs(), shown = new Text({ glyphs: fresh, font: new URL(font, location.href).href, text, fontSize: 20, maxWidth: 900 });
  const scene = emptyScene(), start = performance.now();
  shown.position.set(10, 990, 0);
  scene.add(shown);
  await shown.sync();
  frame(scene);
  const taken = performance.now() - start, bytes = (16 * fresh.texture.length) / fresh.texture.roots.length;
  fresh.dispose();
  return { taken, bytes, shapes: fresh.texture.roots.length };
}

Object.assign(window, { lines, words, labels, first, characters, isReady: true });
