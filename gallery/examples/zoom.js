import * as THREE from 'three';
import { VectorMaterial, VectorTextureLoader } from 'vexture';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);

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
const [NEST, DEEPEST, SECONDS] = [0.03 / 0.9, 4, 24];

function look(zoom) {
  const near = 1 - 1 / zoom; // the middle goes to the nest as it comes nearer
  const at = 0.5 + (NEST + 0.25 / zoom - 0.5) * near;
  const { fullWidth, fullHeight } = camera.view;
  const [width, height] = [fullWidth, fullHeight].map((side) => (1.1 * side) / Math.min(fullWidth, fullHeight) / zoom);
  material.mask.transform.setUvTransform(at - width / 2, at - height / 2, width, height, 0, 0, 0);
}

const panel = addPanel();
const show = (log) => `${log < 1 ? (10 ** log).toFixed(1) : Math.round(10 ** log).toLocaleString('en')} ×`;
const zoom = panel.slider('Nearer', { min: 0, max: DEEPEST, value: 0, show });
const plays = panel.toggle('Play', moves);
const canvas = renderer.domElement;
canvas.style.touchAction = 'none';
canvas.addEventListener('wheel', ({ deltaY }) => (zoom.value -= deltaY / 700), { passive: true });
canvas.addEventListener('pointermove', ({ buttons, movementY }) => buttons && (zoom.value -= movementY / 140));

fillWindow(renderer, camera);
let [last, shown, part] = [0, 0, 0];
renderer.setAnimationLoop((now) => {
  if (zoom.value !== shown) plays.value = false; // the visitor zooms
  if (plays.value) zoom.value = DEEPEST * (0.5 - 0.5 * Math.cos(2 * Math.PI * (part += Math.min(now - last, 100) / 1000 / SECONDS)));
  [last, shown] = [now, zoom.value];
  look(10 ** shown);
  renderer.render(scene, camera);
});
