import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorMaterial, VectorTextureLoader } from 'vexture';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const label = document.createElement('output');
label.style.cssText = 'position: fixed; left: 1rem; top: 1rem; font-size: 1.1rem; color: #fff';
document.body.append(renderer.domElement, label);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x10161d);
const camera = new THREE.PerspectiveCamera(35, 1, 0.001, 20);

const texture = await new VectorTextureLoader().loadAsync('counties.ktx2');
const material = new VectorMaterial({ texture, mode: 'paint', side: THREE.DoubleSide });
const map = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
material.mask.attach(map); // rays tell which county they meet
scene.add(map);

// an invented rate, and its colour: one list for all counties
const shades = Array.from({ length: 64 }, (_, k) => {
  const { r, g, b } = new THREE.Color().lerpColors(new THREE.Color(0x1b2a6b), new THREE.Color(0xf4dc5a), k / 63);
  return [r ** 0.45, g ** 0.45, b ** 0.45, 1];
});
const names = texture.roots[0].style.elements.map(({ name }) => name);
const rate = (k, time) => 0.5 + 0.3 * Math.sin(k / 160 + time) + 0.2 * Math.sin(7.7 * k);
let hovered = null;
function paint(time) {
  const paints = new Map(names.map((name, k) => [name, shades[Math.round(63 * rate(k, time))]]));
  if (hovered) paints.set(hovered, '#ff5c4c');
  texture.setPaints(paints); // no tree is built: the changed rows are sent to the graphics card
}

const [caster, pointer] = [new THREE.Raycaster(), new THREE.Vector2(9, 9)];
renderer.domElement.addEventListener('pointermove', ({ clientX, clientY }) =>
  pointer.set((2 * clientX) / innerWidth - 1, 1 - (2 * clientY) / innerHeight));
const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, zoomToCursor: true, minDistance: 0.05, maxDistance: 8 });
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
camera.position.set(0, -0.9, Math.max(2.6, 3.1 / camera.aspect));
renderer.setAnimationLoop((now) => {
  caster.setFromCamera(pointer, camera);
  hovered = caster.intersectObject(map)[0]?.element?.name ?? null;
  label.textContent = hovered ?? 'Point at a county';
  paint(isStill ? 0 : now / 1200);
  controls.update();
  renderer.render(scene, camera);
});
