// Texts on each renderer, drawn one at a time as a test describes them.
import * as WEBGPU from 'three/webgpu';
import * as THREE from 'three';
import { VectorTexture, readPacked } from 'vexture';
import { AtlasFont, BatchedText, Glyphs, Text, bakeFont, getCaretAtPoint, getSelectionRects } from 'vexture/text';
import { BatchedText as BatchedNodes, Text as TextNodes } from 'vexture/webgpu';

const kernels = Object.fromEntries(['silhouettes', 'maps', 'strokes'].map((name) => [name, `${name}.wasm`]));
const makeGlyphs = (options = {}) => new Glyphs({ kernels, worker: () => new Worker('worker.js', { type: 'module' }), ...options });
const glyphs = makeGlyphs();
const renderers = {};

async function rendererOf(backend) {
  if (renderers[backend]) return renderers[backend];
  const isNodes = backend !== 'webgl';
  const renderer = isNodes ? new WEBGPU.WebGPURenderer({ forceWebGL: backend === 'fallback', antialias: false }) : new THREE.WebGLRenderer();
  renderer.setPixelRatio(1);
  renderer.setClearColor(0x000000, 0);
  if (isNodes) await renderer.init();
  if (isNodes && (renderer.backend.isWebGPUBackend === true) !== (backend === 'webgpu')) throw new Error(`no ${backend}`);
  renderers[backend] = renderer;
  return renderer;
}

function base64(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  let text = '';
  for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return btoa(text);
}

// The pixels of a picture as float32, its top row first.
async function pixelsOf(renderer, scene, camera, [width, height]) {
  const Target = renderer.isWebGLRenderer ? THREE.WebGLRenderTarget : THREE.RenderTarget;
  const target = new Target(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, camera);
  let pixels;
  if (renderer.isWebGLRenderer) {
    pixels = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  } else pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
  renderer.setRenderTarget(null);
  target.dispose();
  if (renderer.backend?.isWebGPUBackend) return base64(pixels);
  const rows = Array.from({ length: height }, (_, row) => pixels.subarray(4 * width * row, 4 * width * (row + 1)));
  return base64(Float32Array.from(rows.reverse().flatMap((row) => [...row])));
}

function cameraOf({ perspective, left, right, top, bottom, eye, at, fov, aspect }) {
  if (!perspective) return new THREE.OrthographicCamera(left, right, top, bottom, -100, 100);
  const camera = new THREE.PerspectiveCamera(fov, aspect, 0.01, 100);
  camera.position.fromArray(eye);
  camera.lookAt(...at);
  return camera;
}

// What a camera sees of a text in the plane: three columns of a matrix from x, y and 1 to clip space.
function planeToClip(object, camera) {
  const { elements: e } = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).multiply(object.matrixWorld);
  return [e.slice(0, 4), e.slice(4, 8), e.slice(12, 16)];
}

async function draw({ backend = 'webgl', options, matrix, camera: described, size, labels = null }) {
  const renderer = await rendererOf(backend);
  const scene = new THREE.Scene(), camera = cameraOf(described);
  const isNodes = backend !== 'webgl';
  const Class = labels ? (isNodes ? BatchedNodes : BatchedText) : isNodes ? TextNodes : Text;
  const text = new Class({ ...options, glyphs });
  for (const label of labels ?? []) text.addLabel({ ...label, ...(label.quaternion && { quaternion: new THREE.Quaternion(...label.quaternion) }) });
  if (matrix) {
    text.matrix.fromArray(matrix);
    text.matrix.decompose(text.position, text.quaternion, text.scale);
  }
  scene.add(text);
  await text.sync();
  scene.updateMatrixWorld();
  camera.updateMatrixWorld();
  const pixels = await pixelsOf(renderer, scene, camera, size);
  const { calls } = renderer.info.render;
  const seen = { pixels, calls, clip: planeToClip(text, camera), flat: text.material.userData.mask.options.flat, layout: text.layout && plain(text.layout) };
  text.dispose();
  return seen;
}

const plain = (layout) => Object.fromEntries(Object.entries(layout).map(([name, value]) => [name, ArrayBuffer.isView(value) ? [...value] : value]));

Object.assign(globalThis, { THREE, Text, BatchedText, Glyphs, glyphs, makeGlyphs, getCaretAtPoint, getSelectionRects, draw, drawn: true });

// A font baked in the page, and a text in it beside the same text set by the worker.
async function bake({ characters, options, camera: described, size, kept = null }) {
  const { texture, metrics } = await bakeFont({ characters, font: 'font.ttf', glyphs: glyphs.options });
  const font = new AtlasFont(new VectorTexture(await readPacked(texture)), metrics);
  const seen = [await draw({ options: { ...options, font }, camera: described, size }), await draw({ options: { ...options, font: 'font.ttf' }, camera: described, size })];
  return { pixels: seen.map(({ pixels }) => pixels), layouts: seen.map(({ layout }) => layout), metrics, bytes: kept && base64(texture) };
}

const request = {
  fontSize: 1, letterSpacing: 0, lineHeight: 'normal', maxWidth: Infinity, textIndent: 0, textAlign: 'start', whiteSpace: 'normal',
  overflowWrap: 'normal', anchorX: 0, anchorY: 'top-baseline',
};

const nodeTexts = { Text: TextNodes, BatchedText: BatchedNodes };
Object.assign(globalThis, { AtlasFont, WEBGPU, bake, nodeTexts, pixelsOf, rendererOf, request });
