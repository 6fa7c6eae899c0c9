import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VectorTexturePlugin } from 'vexture/gltf';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xe4dccb);
scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.02).texture; // what glass mirrors
scene.environmentIntensity = 0.55;
const camera = new THREE.PerspectiveCamera(30, 1, 0.005, 100);
const lamp = new THREE.DirectionalLight(0xfff3e0, 1.5);
lamp.position.set(3, 6, 4);
lamp.castShadow = true;
lamp.shadow.mapSize.set(2048, 2048);
scene.add(lamp);

// the model holds the drawing: a loader without the plugin shows a plain label
const loader = new GLTFLoader().register((parser) => new VectorTexturePlugin(parser));
const { scene: bottle } = await loader.loadAsync('bottle.glb');
bottle.traverse((mesh) => (mesh.castShadow = mesh.receiveShadow = true));
const glass = bottle.getObjectByName('Glass').material;
const table = new THREE.Mesh(new THREE.CircleGeometry(9, 64).rotateX(-Math.PI / 2), new THREE.MeshStandardMaterial({ color: 0xb98f63 }));
table.receiveShadow = true;
scene.add(bottle, table);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, maxPolarAngle: 1.55, minDistance: 0.03, maxDistance: 12 });

// from the whole bottle to the last line of the label, each step as many times nearer
const [middle, print, away] = [new THREE.Vector3(0, 1.5, 0), new THREE.Vector3(0, 0.372, 0.424), 7];
function come(times) {
  controls.target.lerpVectors(print, middle, 1 / times);
  camera.position.set(0.28, 0.1, 1).setLength(away / times).add(controls.target);
}
const panel = addPanel();
const show = (log) => `${(10 ** log).toFixed(log < 1 ? 1 : 0)} ×`;
panel.slider('Nearer', { min: 0, max: 2.3, value: 0, show }, (log) => come(10 ** log));
panel.slider('Gloss', { min: 0, max: 1, value: 0.92 }, (gloss) => (glass.roughness = 1 - gloss));
panel.color('Glass', '#31502f', (color) => glass.color.set(color));
const turn = panel.toggle('Turn', moves);

fillWindow(renderer, camera);
renderer.setAnimationLoop((now) => {
  bottle.rotation.y = turn.value ? 0.5 * Math.sin(now / 3000) : 0;
  controls.update();
  renderer.render(scene, camera);
});
