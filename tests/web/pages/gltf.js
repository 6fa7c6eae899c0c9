// The floor of a model, seen straight from above, as GLTFLoader and the plugin load it.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VectorTextureLoader, applyVectorMaskToScene, gltfTransform } from 'vexture';
import { VectorTexturePlugin } from 'vexture/gltf';

const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(512, 512);
document.body.append(renderer.domElement);
const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
camera.position.z = 5;

function pixels() {
  const gl = renderer.getContext();
  const data = new Uint8Array(4 * 512 * 512);
  gl.readPixels(0, 0, 512, 512, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let text = '';
  for (let i = 0; i < data.length; i += 4096) text += String.fromCharCode(...data.subarray(i, i + 4096));
  return btoa(text);
}

async function draw(file, { clone = false, texture = null, options = {} } = {}) {
  const loader = new GLTFLoader().register((parser) => new VectorTexturePlugin(parser));
  const { scene: loaded } = await loader.loadAsync(file);
  if (texture) {
    const loadedTexture = await new VectorTextureLoader().loadAsync(texture);
    applyVectorMaskToScene(loaded, loadedTexture, { ...options, transform: gltfTransform() });
  }
  const model = clone ? loaded.clone() : loaded;
  model.getObjectByName('Box').visible = false;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xffffff);
  scene.add(model);
  renderer.render(scene, camera);
  return { picture: pixels() };
}

window.page = { draw };
