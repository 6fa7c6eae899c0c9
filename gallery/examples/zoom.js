import * as THREE from 'three';
import { VectorMaterial, VectorTextureLoader } from 'vexture';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const label = document.createElement('output');
label.style.cssText = 'position: fixed; left: 1rem; bottom: 1rem; padding: 0 .6rem; border-radius: 1rem; background: #fffc';
document.body.append(renderer.domElement, label);

// One square fills the view. Where in the drawing it lies is the business of its transform: so no camera, and no
// corner of a mesh, comes near the limits of 32-bit floats.
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xcfd8dc); // beside the postcard
const camera = new THREE.OrthographicCamera(0, 1, 1, 0, -1, 1);
const texture = await new VectorTextureLoader().loadAsync('postcard.ktx2');
const material = new VectorMaterial({ texture, mode: 'paint', flat: true });
const plane = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
plane.position.set(0.5, 0.5, 0);
scene.add(plane);

// The stamp's stamp's stamp ... is here; near a corner of the unit square floats are finest, 4e-9 of it.
const [NEST, DEEPEST, SECONDS] = [0.03 / 0.9, 10000, 24];
let zoom = 1;

function look() {
  const near = 1 - 1 / zoom; // the middle goes to the nest as it comes nearer
  const at = 0.5 + (NEST + 0.25 / zoom - 0.5) * near;
  const [width, height] = [Math.max(1, innerWidth / innerHeight), Math.max(1, innerHeight / innerWidth)].map((n) => (1.1 * n) / zoom);
  material.mask.transform.setUvTransform(at - width / 2, at - height / 2, width, height, 0, 0, 0);
  label.textContent = `${zoom < 10 ? zoom.toFixed(1) : Math.round(zoom).toLocaleString('en')} times`;
}
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
let [begun, playing] = [performance.now(), !isStill];
const set = (next) => ((zoom = Math.min(Math.max(next, 1), DEEPEST)), (playing = false));
addEventListener('wheel', ({ deltaY }) => set(zoom * Math.exp(-deltaY / 300)));
addEventListener('pointermove', ({ buttons, movementY }) => buttons && set(zoom * Math.exp(-movementY / 60)));
addEventListener('keydown', ({ key }) => set(zoom * ({ '+': 1.5, '-': 1 / 1.5 }[key] ?? 1)));
addEventListener('dblclick', () => ([begun, playing] = [performance.now(), true]));
function fit() {
  renderer.setSize(innerWidth, innerHeight);
}
addEventListener('resize', fit);
fit();
renderer.domElement.style.touchAction = 'none';
renderer.setAnimationLoop((now) => {
  const part = (((now - begun) / 1000 / SECONDS) * 2) % 2; // there and back
  if (playing) zoom = DEEPEST ** (0.5 - 0.5 * Math.cos(Math.PI * part));
  look();
  renderer.render(scene, camera);
});
