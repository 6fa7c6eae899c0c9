import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTexture, VectorTextureLoader, applyVectorMask } from 'vexture';

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
scene.add(lamp, new THREE.HemisphereLight(0xffffff, 0xb9a98a, 1.6));

// With a server this is `await LiveVectorTexture.connect('https://example.org/shapes/logo')`, which replaces its data
// when somebody types `vexture push logo.svg`. Here a timer does.
const loader = new VectorTextureLoader();
const drawings = await Promise.all(['duck', 'cake', 'flame', 'thumb'].map((name) => loader.loadData(`${name}.ktx2`)));
const texture = new VectorTexture(drawings[0]);
let shown = 0;
const show = () => texture.replace(drawings[shown++ % drawings.length]); // all at once, between two frames
show();
setInterval(show, 1000);

// three materials, each of which follows the texture
const colors = [0x1d6f8a, 0xe8a200, 0xc8473a];
colors.forEach((color, k) => {
  const material = new THREE.MeshStandardMaterial({ color, side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1.6, 1.6), material);
  mesh.position.set(1.5 * (k - 1), 0, -0.4 * Math.abs(k - 1));
  mesh.rotation.y = -0.5 * (k - 1);
  mesh.castShadow = true;
  applyVectorMask(material, texture, { mode: 'cut' }).attach(mesh);
  scene.add(mesh);
});
const wall = new THREE.Mesh(new THREE.PlaneGeometry(30, 20), new THREE.MeshStandardMaterial({ color: 0xe9dfcc }));
wall.position.z = -1.2;
wall.receiveShadow = true;
scene.add(wall);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 1.5, maxDistance: 14 });
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
camera.position.set(0, 0.2, Math.max(4.4, 6.4 / camera.aspect));
renderer.setAnimationLoop(() => {
  controls.update();
  renderer.render(scene, camera);
});
