import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader, applyVectorMask } from 'vexture';
import { SimpleWater } from 'vexture/water';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xcfe4f2);
scene.fog = new THREE.Fog(0xcfe4f2, 30, 120);
const camera = new THREE.PerspectiveCamera(45, 1, 0.1, 300);

// two shapes, the sea, and the same with its beaches; the land is green, and sand within the second
const coast = await new VectorTextureLoader().loadAsync('coast.ktx2');
const square = new THREE.PlaneGeometry(100, 100, 80, 80).rotateX(-Math.PI / 2);
const shades = Array.from({ length: 81 * 81 }, () => 0.85 + 0.25 * Math.random()).flatMap((shade) => [shade, shade, 0.9 * shade]);
square.setAttribute('color', new THREE.Float32BufferAttribute(shades, 3));
const grass = new THREE.MeshBasicMaterial({ color: 0x7fa056, vertexColors: true });
applyVectorMask(grass, coast, { root: 'beach', mode: 'mix', color: 0xf0dcae });
scene.add(new THREE.Mesh(square, grass));

// the water is where the first shape is, with shallows and foam along its outline
const sun = new THREE.Vector3();
const water = new SimpleWater(new THREE.PlaneGeometry(100, 100), coast, {
  root: 'sea', sunDirection: sun, sunColor: 0xfff1d0, sky: 0x4f97d8, horizon: 0xcfe4f2, fog: true,
});
water.rotation.x = -Math.PI / 2;
water.position.y = 0.02;
scene.add(water);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, maxPolarAngle: 1.5, minDistance: 3, maxDistance: 110 });

const { uniforms } = water.material;
const panel = addPanel();
panel.slider('Sun', { min: 3, max: 80, value: 24, step: 1, unit: '°' }, (height) =>
  sun.setFromSphericalCoords(1, THREE.MathUtils.degToRad(90 - height), THREE.MathUtils.degToRad(200)));
panel.slider('Waves', { min: 0.3, max: 6, value: 0.9 }, (size) => (uniforms.size.value = 12 / size));
panel.slider('Foam', { min: 0, max: 40, value: 14 }, (width) => (water.foam = { width: width / 1000 }));
panel.color('Water', '#146a8c', (color) => uniforms.waterColor.value.set(color));
panel.color('Shallows', '#5fd0c4', (color) => (water.shallow = color));
const flows = panel.toggle('Flow', moves);

fillWindow(renderer, camera);
camera.position.set(16, 9, 30);
controls.target.set(1, 0, 8);
let last = 0;
renderer.setAnimationLoop((now) => {
  if (flows.value) water.time += (now - last) / 1000;
  last = now;
  controls.update();
  renderer.render(scene, camera);
});
