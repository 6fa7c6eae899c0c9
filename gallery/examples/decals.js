import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader, applyVectorMask } from 'vexture';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x27313b);
const camera = new THREE.PerspectiveCamera(38, 1, 0.1, 60);
const lamp = new THREE.SpotLight(0xfff0d8, 190, 0, 1, 0.6);
lamp.castShadow = true;
lamp.shadow.mapSize.set(2048, 2048);
lamp.shadow.normalBias = 0.04;
scene.add(lamp, new THREE.HemisphereLight(0xbfd4ea, 0x4a4038, 1.2));

const plaster = new THREE.MeshStandardMaterial({ color: 0xcfc6b8, roughness: 0.9 });
const wall = new THREE.Mesh(new THREE.PlaneGeometry(12, 6).translate(0, 2, -1.2), plaster.clone());
const floor = new THREE.Mesh(new THREE.PlaneGeometry(12, 8).rotateX(-Math.PI / 2).translate(0, -1, 2.8), plaster);
for (const mesh of [wall, floor]) mesh.receiveShadow = true;
scene.add(wall, floor);

const texture = await new VectorTextureLoader().loadAsync('shapes.ktx2');

// a decal: the wall itself has another colour inside the shape
const decal = applyVectorMask(wall.material, texture, { root: 'weather-night', mode: 'mix', color: 0x2f6f8f });

// cut out: the shape is lit, and its shadow has its outline
function cutOut(root, color, x, size) {
  const material = new THREE.MeshStandardMaterial({ color, roughness: 0.4, side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(size, size), material);
  applyVectorMask(material, texture, { root, mode: 'cut' }).attach(mesh);
  mesh.position.set(x, size / 2 - 1.05, 0.7);
  mesh.castShadow = mesh.receiveShadow = true;
  scene.add(mesh);
  return mesh;
}
const [cat, tree] = [cutOut('cat', 0xe8b100, -0.6, 1.7), cutOut('pine-tree', 0x3d8a5a, 1.2, 2.4)];

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 2, maxDistance: 12, maxPolarAngle: 1.6 });

const panel = addPanel();
panel.slider('Lamp', { min: -70, max: 70, value: 25, step: 1, unit: '°' }, (angle) =>
  lamp.position.set(6 * Math.sin((angle * Math.PI) / 180), 3.6, 6 * Math.cos((angle * Math.PI) / 180)));
panel.slider('Size', { min: 0.5, max: 4, value: 1.9, unit: 'm' }, (size) => // the wall's sides in sizes of the decal, its middle
  decal.transform.setUvTransform(0.5 - 4.5 / size, 0.5 - 2.2 / size, 12 / size, 6 / size, 0, 0, 0));
panel.color('Decal', '#2f6f8f', (color) => (decal.color = color));
const turn = panel.toggle('Turn', moves);

fillWindow(renderer, camera);
camera.position.set(-0.4, 1.1, innerWidth > 480 ? 6 : 8.5);
renderer.setAnimationLoop((now) => {
  [cat, tree].forEach((mesh, k) => (mesh.rotation.y = turn.value ? 0.5 * Math.sin(now / 1500 + 2 * k) : 0.2));
  controls.update();
  renderer.render(scene, camera);
});
