import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTexture, VectorTextureLoader, applyVectorMask } from 'vexture';
import { addPanel, fillWindow } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xf1ebe0);
const camera = new THREE.PerspectiveCamera(38, 1, 0.1, 50);
const lamp = new THREE.DirectionalLight(0xffffff, 2.2);
lamp.position.set(1.5, 3, 4);
lamp.castShadow = true;
lamp.shadow.mapSize.set(2048, 2048);
scene.add(lamp, new THREE.HemisphereLight(0xffffff, 0xb9a98a, 1.6));

// With a server this is `await LiveVectorTexture.connect('https://example.org/shapes/weather')`, which replaces its data
// when somebody types `vexture push weather.svg`. Here a timer does.
const loader = new VectorTextureLoader();
const weather = ['sunny', 'cloudy', 'pouring', 'lightning'];
const drawings = await Promise.all(weather.map((name) => loader.loadData(`weather-${name}.ktx2`)));
const texture = new VectorTexture(drawings[0]);

// three materials, each of which follows the texture
const signs = [-1, 0, 1].map((k) => {
  const material = new THREE.MeshStandardMaterial({ side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1.7, 1.7), material);
  mesh.position.set(1.6 * k, 0, -0.3 * Math.abs(k));
  mesh.rotation.y = -0.4 * k;
  mesh.castShadow = true;
  applyVectorMask(material, texture, { mode: 'cut' }).attach(mesh);
  scene.add(mesh);
  return material;
});
const wall = new THREE.Mesh(new THREE.PlaneGeometry(30, 20), new THREE.MeshStandardMaterial({ color: 0xe9dfcc }));
wall.position.z = -1.2;
wall.receiveShadow = true;
scene.add(wall);

const panel = addPanel();
const show = (name) => texture.replace(drawings[weather.indexOf(name)]); // all at once, between two frames
const choice = panel.choice('Drawing', weather, show);
const period = panel.slider('Every', { min: 0.1, max: 3, value: 1, unit: 's' });
const plays = panel.toggle('Play', true);
['#1d6f8a', '#e8a200', '#c8473a'].forEach((first, k) => panel.color(`Sign ${k + 1}`, first, (color) => signs[k].color.set(color)));

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 1.5, maxDistance: 14 });
fillWindow(renderer, camera);
camera.position.set(0, 0.2, Math.max(4.6, 7.6 / camera.aspect));
let last = 0;
renderer.setAnimationLoop((now) => {
  if (plays.value && now - last > 1000 * period.value) {
    choice.value = weather[(weather.indexOf(choice.value) + 1) % weather.length];
    show(choice.value);
    last = now;
  }
  controls.update();
  renderer.render(scene, camera);
});
