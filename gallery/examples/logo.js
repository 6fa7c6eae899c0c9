import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader, applyVectorMask } from 'vexture';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
scene.background = new THREE.Color(0xe9e2d3);
const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
const sun = new THREE.DirectionalLight(0xffffff, 2.2);
sun.position.set(2, 4, 5);
scene.add(new THREE.HemisphereLight(0xffffff, 0xb8a888, 1.8), sun);

// the mug: a cylinder, whose uv go once around it, a bottom, and a handle
const glazed = new THREE.MeshStandardMaterial({ roughness: 0.35, side: THREE.DoubleSide });
const wall = new THREE.Mesh(new THREE.CylinderGeometry(1, 0.9, 2, 96, 1, true), glazed.clone());
const bottom = new THREE.Mesh(new THREE.CircleGeometry(0.9, 96).rotateX(Math.PI / 2).translate(0, -0.99, 0), glazed);
const handle = new THREE.Mesh(new THREE.TorusGeometry(0.55, 0.13, 24, 64, Math.PI).rotateZ(-Math.PI / 2), glazed);
handle.position.x = 0.92;
scene.add(new THREE.Group().add(wall, bottom, handle).rotateY(2.8));

// the drawing, in its own colours, over the colour of the wall
const logo = await new VectorTextureLoader().loadAsync('logo.ktx2');
const mask = applyVectorMask(wall.material, logo, { mode: 'paint' });

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 1.2, maxDistance: 9, autoRotateSpeed: 0.6 });

const panel = addPanel();
panel.slider('Size', { min: 0.3, max: 2, value: 1.5 }, (size) => {
  const [around, up] = [6 / size, 2 / size]; // the mug's sides, in sizes of the drawing
  mask.transform.setUvTransform(0.5 - around / 2, 0.5 - up / 2, around, up, 0, 0, 0);
});
panel.toggle('All around', false, (isOn) => (mask.wrap = isOn ? 'repeat' : 'none'));
panel.color('Mug', '#f7f4ee', (color) => [wall.material, glazed].forEach((material) => material.color.set(color)));
panel.toggle('Turn', moves, (isOn) => (controls.autoRotate = isOn));

fillWindow(renderer, camera);
camera.position.set(1.2, 1, 4.2).multiplyScalar(innerWidth > 480 ? 1 : 1.2);
renderer.setAnimationLoop(() => {
  controls.update();
  renderer.render(scene, camera);
});
