import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorGlobe } from 'vexture/globe';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const label = document.createElement('output');
label.style.cssText = 'position: fixed; left: 1rem; top: 1rem; font-size: 1.1rem; color: #fff';
document.body.append(renderer.domElement, label);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x05070d);
const camera = new THREE.PerspectiveCamera(35, 1, 1, 100);

// stars, all around and far behind
const away = Array.from({ length: 1500 }, () => new THREE.Vector3().randomDirection().setLength(50));
const sky = new THREE.PointsMaterial({ color: 0xffffff, size: 1.5, sizeAttenuation: false, transparent: true, opacity: 0.8 });
const sea = new THREE.Mesh(new THREE.SphereGeometry(0.998, 128, 64), new THREE.MeshBasicMaterial({ color: 0x1f4a6b }));
scene.add(new THREE.Points(new THREE.BufferGeometry().setFromPoints(away), sky), sea);

// the map, whole, as bytes; with an address as its source, a page asks for what it shows
const globe = new VectorGlobe({ source: await (await fetch('countries.pmtiles')).blob() });
const palette = ['#e9c793', '#b7cf95', '#dfa78f', '#a8c3a0', '#dcbf6b', '#c9b6d0'];
const number = (id) => [...id].reduce((sum, letter) => (31 * sum + letter.codePointAt(0)) % 65537, 7);
globe.setPaint((id) => palette[number(id) % palette.length]);
scene.add(globe);

const controls = new OrbitControls(camera, renderer.domElement);
controls.autoRotate = !matchMedia('(prefers-reduced-motion: reduce)').matches;
Object.assign(controls, { enableDamping: true, enablePan: false, minDistance: 1.02, maxDistance: 6, autoRotateSpeed: 0.4 });
controls.addEventListener('start', () => (controls.autoRotate = false));

const pointer = new THREE.Vector2(9, 9); // beside the picture
renderer.domElement.addEventListener('pointermove', ({ clientX, clientY }) =>
  pointer.set((2 * clientX) / innerWidth - 1, 1 - (2 * clientY) / innerHeight));
let hovered = null;
function highlight() {
  const id = globe.featureUnder(pointer, camera)?.id ?? null;
  if (id === hovered) return;
  globe.setPaint({ ...(hovered && { [hovered]: undefined }), ...(id && { [id]: '#ff5c4c' }) }); // undefined: as before
  hovered = id;
  label.textContent = id ?? '';
}
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
}
addEventListener('resize', fit);
fit();
camera.position.set(0.6, 1.4, 1.9).setLength(camera.aspect > 1 ? 3.7 : 6);
renderer.setAnimationLoop(() => {
  const height = controls.getDistance() - 1;
  controls.rotateSpeed = controls.zoomSpeed = Math.min(1, height);
  controls.update();
  camera.near = height / 4;
  camera.updateProjectionMatrix();
  highlight();
  globe.update(camera, innerHeight); // chooses the tiles for what the camera sees
  renderer.render(scene, camera);
});
