import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Text } from 'vexture/text';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('#bcd8e6');
const camera = new THREE.PerspectiveCamera(36, 1, 0.05, 100);
const sun = new THREE.DirectionalLight('#fff2dd', 2.8);
scene.add(sun, new THREE.HemisphereLight('#ffffff', '#6b7a55', 1.5));

// the text of a sign is bent around the same axis as its sheet, and is lit as the sheet is
const paint = new THREE.MeshStandardMaterial({ roughness: 0.6, transparent: true, depthWrite: false });
const words = new Text({ material: paint, fontSize: 0.7, anchorX: 'center', anchorY: 'middle', textAlign: 'center' });
const sheets = ['#f4f4ef', '#12603a'].map((color) =>
  new THREE.Mesh(undefined, new THREE.MeshStandardMaterial({ color, roughness: 0.6, side: THREE.DoubleSide })));
function bendSign(radius) {
  words.curveRadius = -radius;
  sheets.forEach(({ geometry }, k) => {
    const [own, height, width] = [radius - 0.03 + 0.015 * k, 2 - 0.12 * k, (6 - 0.12 * k) / radius];
    geometry.copy(new THREE.CylinderGeometry(own, own, height, 96, 1, true, -width / 2, width).translate(0, 0, -radius));
  });
}
const sign = new THREE.Group().add(...sheets, words);
sign.position.y = 2.3;
scene.add(sign);

// the words on the road run along a curve; they lie in the plane of the ground
const curve = new THREE.EllipseCurve(0, 0, 4.1, 4.1, Math.PI / 2, 2.5 * Math.PI);
const lane = new Text({ material: paint, text: 'slow · Coast Road', curve, depthOffset: -1 });
const flat = (geometry, color, height) => {
  const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color, roughness: 0.95 }));
  mesh.position.z = height;
  return mesh;
};
const ground = new THREE.Group();
ground.rotation.x = -Math.PI / 2;
ground.add(flat(new THREE.CircleGeometry(30, 64), '#7f9a5b', -0.02), flat(new THREE.RingGeometry(3.6, 6, 128), '#3b3f44', -0.01));
ground.add(lane, flat(new THREE.BoxGeometry(0.2, 0.2, 6).translate(0, 0.3, 0), '#8b9298', 0)); // and a post
scene.add(ground);

const panel = addPanel();
const texts = ['Coast Road\nHarbour 2', 'Πειραιάς\nPiraeus 8', 'Скоро порт\nPort 3'];
panel.choice('Sign', texts.map((text) => text.split('\n')[0]), (first) => (words.text = texts.find((text) => text.startsWith(first))));
panel.slider('Radius', { min: 1.5, max: 20, value: 3, unit: 'm' }, bendSign);
panel.slider('Outline', { min: 0, max: 12, value: 0, step: 0.5, unit: '%' }, (width) => (words.outlineWidth = `${width}%`));
const way = panel.slider('Way', { min: 0, max: 25, value: 9.3, unit: 'm' }, (metres) => (lane.anchorX = -metres));
panel.slider('Letters', { min: 0.3, max: 1.8, value: 1, unit: 'm' }, (size) => (lane.fontSize = size));
panel.color('Paint', '#f7f5ee', (color) => (words.color = lane.color = color));
const turn = panel.toggle('Sun moves', moves);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 2, maxDistance: 25, maxPolarAngle: 1.5 });
controls.target.set(0, 1.5, 0);
fillWindow(renderer, camera);
camera.position.set(2, 4, 10).multiplyScalar(1.1 / Math.min(1, camera.aspect));
renderer.setAnimationLoop((now) => {
  sun.position.set(8 * Math.sin(turn.value ? now / 2000 : 0.6), 4, 6);
  controls.update();
  renderer.render(scene, camera);
});
