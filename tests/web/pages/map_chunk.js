// Loads textures one at a time, as a test asks for them, and draws them.
import * as THREE from 'three';
import { VectorMaterial, VectorTextureLoader } from 'vexture';

const renderer = new THREE.WebGLRenderer();
renderer.setPixelRatio(1);
renderer.setSize(64, 64);
document.body.append(renderer.domElement);
const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
camera.position.z = 5;

// What is known of a texture, and the colour of its middle as drawn, as soon as the loader hands it out.
window.show = async (file, paints) => {
  const loaded = await new VectorTextureLoader().loadAsync(file).catch((error) => `${error.name} ${error.message}`);
  if (typeof loaded === 'string') return loaded;
  const texture = loaded;
  if (paints) texture.setPaints(paints);
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new VectorMaterial({ texture, mode: 'paint' })));
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  const pixel = new Uint8Array(4);
  gl.readPixels(32, 32, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  const element = paints ? texture.elementAt(0.5, 0.5)?.name : null;
  return { pixel: [...pixel], contains: texture.contains(0.5, 0.5), color: texture.colorAt(0.5, 0.5).color, element };
};
