import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorGlobe } from 'vexture/globe';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x05070d);
const camera = new THREE.PerspectiveCamera(35, 1, 1, 100);
camera.position.set(0.6, 1.4, 1.9);

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
Object.assign(controls, { enableDamping: true, enablePan: false, minDistance: 1.02, maxDistance: 8, autoRotateSpeed: 0.4 });
const panel = addPanel();
const line = panel.text('Point at a country');
const show = (log) => `${Number((6371 * 10 ** log).toPrecision(2)).toLocaleString('en')} km`;
const height = panel.slider('Height', { min: -1.7, max: 0.8, value: innerWidth > 480 ? 0.45 : 0.66, show }, (log) =>
  camera.position.setLength(1 + 10 ** log));
panel.color('Sea', '#1f4a6b', (color) => sea.material.color.set(color));
const turn = panel.toggle('Turn', moves, (isOn) => (controls.autoRotate = isOn));
controls.addEventListener('start', () => (turn.value = controls.autoRotate = false));

const pointer = new THREE.Vector2(9, 9); // beside the picture
const point = ({ clientX, clientY }) => pointer.set((2 * clientX) / innerWidth - 1, 1 - (2 * clientY) / innerHeight);
for (const type of ['pointermove', 'pointerdown']) renderer.domElement.addEventListener(type, point);
let hovered = null;
function highlight() {
  const id = globe.featureUnder(pointer, camera)?.id ?? null;
  if (id === hovered) return;
  globe.setPaint({ ...(hovered && { [hovered]: undefined }), ...(id && { [id]: '#ff5c4c' }) }); // undefined: as before
  hovered = id;
  line.textContent = id ?? 'Point at a country';
}
fillWindow(renderer, camera);
renderer.setAnimationLoop(() => {
  const above = controls.getDistance() - 1;
  height.value = Math.log10(above); // it follows the wheel
  controls.rotateSpeed = controls.zoomSpeed = Math.min(1, above);
  controls.update();
  camera.near = above / 4;
  camera.updateProjectionMatrix();
  highlight();
  globe.update(camera, innerHeight); // chooses the tiles for what the camera sees
  renderer.render(scene, camera);
});
