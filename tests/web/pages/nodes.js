// Scenes of node materials on both backends of WebGPURenderer, drawn one at a time as a test describes them.
import * as THREE from 'three/webgpu';
import { uv, vec2, vec4 } from 'three/tsl';
import * as vexture from 'vexture/webgpu';

const textures = {};
const renderers = {};
const loader = new vexture.VectorTextureLoader();
const complaints = [];
for (const how of ['error', 'warn']) {
  const before = console[how];
  console[how] = (...all) => {
    complaints.push(all.join(' '));
    if (how === 'warn') before.apply(console, all);
  };
}

async function textureOf(name) {
  textures[name] ??= await loader.loadAsync(`${name}.ktx2`);
  return textures[name];
}

async function rendererOf(backend) {
  if (!renderers[backend]) {
    const renderer = new THREE.WebGPURenderer({ forceWebGL: backend === 'webgl', antialias: false });
    renderer.setPixelRatio(1);
    renderer.shadowMap.enabled = true;
    renderer.setClearColor(0x000000, 0);
    await renderer.init();
    if ((renderer.backend.isWebGPUBackend === true) === (backend === 'webgl')) throw new Error(`no ${backend}`);
    renderers[backend] = renderer;
  }
  return renderers[backend];
}

function base64(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  let text = '';
  for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return btoa(text);
}

// The pixels of a picture as float32, its top row first.
async function pixelsOf(renderer, scene, camera, [width, height]) {
  const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
  renderer.setRenderTarget(null);
  target.dispose();
  return base64(pixels);
}

// A node over the whole picture: `place` is the part of the unit square that it shows, x, y, width and height.
async function node({ backend, texture, what, options = {}, size = [100, 100], place = [0, 0, 1, 1], turn = 0 }) {
  const renderer = await rendererOf(backend);
  const shape = await textureOf(texture);
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const at = uv().sub(0.5);
  const turned = vec2(at.x.mul(c).sub(at.y.mul(s)), at.x.mul(s).add(at.y.mul(c))).add(0.5);
  const position = turned.mul(vec2(place[2], place[3])).add(vec2(place[0], place[1]));
  const made = vexture[what](shape, { uv: position, ...options });
  const material = new THREE.MeshBasicNodeMaterial();
  material.fragmentNode = what === 'vectorCoverage' ? vec4(made) : made;
  material.blending = THREE.NoBlending;
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1);
  const pixels = await pixelsOf(renderer, scene, camera, size);
  material.dispose();
  return { pixels, complaints: complaints.splice(0) };
}

globalThis.drawn = { node };
