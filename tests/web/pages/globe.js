// A globe with the tiles of the tests.
import * as THREE from 'three';
import { PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { VectorGlobe, textureSource } from 'vexture/globe';

let renderer;
const replaceRenderer = (other) => {
  renderer?.domElement.remove();
  window.renderer = renderer = other;
  renderer.setSize(innerWidth, innerHeight);
  renderer.setClearColor(0xffffff);
  document.body.append(renderer.domElement);
};
replaceRenderer(new WebGLRenderer({ preserveDrawingBuffer: true }));
const scene = new Scene();
const camera = new PerspectiveCamera(40, innerWidth / innerHeight, 1e-8, 100);
let globe = new VectorGlobe({ source: location.search.slice(1) || 'map.pmtiles', pause: 10 });
scene.add(globe);

const draw = () => {
  globe.update(camera, innerHeight);
  renderer.render(scene, camera);
};

// Another globe instead.
const replace = (options) => {
  scene.remove(globe);
  window.globe = globe = new VectorGlobe(options);
  scene.add(globe);
};

// Look at a place from a height, in radii.
const aim = (lng, lat, height) => {
  const [a, b] = [lng, lat].map((degrees) => (degrees * Math.PI) / 180);
  camera.position.set(Math.cos(b) * Math.sin(a), Math.sin(b), Math.cos(b) * Math.cos(a)).multiplyScalar(1 + height);
  camera.near = height / 4;
  camera.far = height * 4 + 3;
  camera.updateProjectionMatrix();
  camera.lookAt(0, 0, 0);
};

// As that, until all is there; pixels RGBA, bottom row first.
const look = async (lng, lat, height) => {
  aim(lng, lat, height);
  await globe.ready();
  do {
    draw();
    await new Promise((resolve) => setTimeout(resolve, 5));
  } while (globe.stats.running);
  return pixels();
};

const read = () => {
  draw();
  const gl = renderer.getContext();
  const data = new Uint8Array(4 * innerWidth * innerHeight);
  gl.readPixels(0, 0, innerWidth, innerHeight, gl.RGBA, gl.UNSIGNED_BYTE, data);
  return data;
};

// How many pixels of the next frame have a colour.
const count = async (...color) => {
  await new Promise((resolve) => requestAnimationFrame(resolve));
  const data = read();
  let found = 0;
  for (let at = 0; at < data.length; at += 4) found += color.every((part, c) => data[at + c] === part);
  return found;
};

const pixels = () => {
  const data = read();
  let text = '';
  for (let at = 0; at < data.length; at += 4096) text += String.fromCharCode(...data.subarray(at, at + 4096));
  return btoa(text);
};

Object.assign(window, { globe, aim, look, count, pixels, camera, scene, replace, replaceRenderer, textureSource, THREE });
