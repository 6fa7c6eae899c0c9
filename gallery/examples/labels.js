import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { BatchedText } from 'vexture/text';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('#0c1420');
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 600);

// the numbers on a spiral, whose rounds begin near the squares: primes gather along curves
const MOST = 10000;
function factorsOf(number) {
  const found = [];
  for (let k = 2; number > 1; k++) for (; number % k === 0; number /= k) found.push(k);
  return found;
}

// all labels are one draw call; each has a text, a place, a size, a colour and a visibility of its own
const labels = new BatchedText({ fontSize: 0.8, anchorX: 'center', anchorY: 'middle', sprites: true });
const numbers = new Map(Array.from({ length: MOST }, (_, k) => [labels.addLabel({ text: `${k + 1}` }), factorsOf(k + 1)]));
scene.add(labels);
const start = performance.now();
await labels.sync();

const panel = addPanel();
const line = panel.text(`${MOST.toLocaleString('en')} labels were set in ${Math.round(performance.now() - start)} ms. Point at one.`);
const size = panel.slider('Size', { min: 0.3, max: 3, value: 1, show: (value) => `${value.toFixed(1)} ×` });
const wave = panel.slider('Wave', { min: 0, max: 8, value: 2, unit: 'm' });
const [gold, blue, white] = [new THREE.Color(), new THREE.Color(), new THREE.Color('white')];
panel.color('Primes', '#ffd166', (color) => gold.set(color));
panel.color('Others', '#5f86b3', (color) => blue.set(color));
const others = panel.toggle('Show them', true);
const turn = panel.toggle('Move', moves);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 4, maxDistance: 300, autoRotateSpeed: 0.4 });
const [pointer, ray] = [new THREE.Vector2(2, 2), new THREE.Raycaster()];
renderer.domElement.addEventListener('pointermove', ({ offsetX, offsetY }) =>
  pointer.set((2 * offsetX) / innerWidth - 1, 1 - (2 * offsetY) / innerHeight));
fillWindow(renderer, camera);
camera.position.set(0, 70, 90).multiplyScalar(1 / Math.min(1, camera.aspect));
let time = 0;
renderer.setAnimationLoop(() => {
  if (turn.value) time += 0.03;
  for (const [label, factors] of numbers) {
    const radius = Math.sqrt(label.text);
    label.position.setFromCylindricalCoords(radius, 2 * Math.PI * radius, wave.value * Math.sin(radius / 6 - time));
    const isPrime = factors.length === 1;
    Object.assign(label, { scale: size.value, color: isPrime ? gold : blue, visible: isPrime || others.value });
  }
  ray.setFromCamera(pointer, camera);
  for (const { label } of ray.intersectObject(labels).slice(0, 1)) {
    Object.assign(label, { scale: 2.5 * size.value, color: white });
    line.textContent = `${label.text} = ${numbers.get(label).join(' · ') || 1}`;
  }
  controls.autoRotate = turn.value;
  controls.update();
  renderer.render(scene, camera);
});
