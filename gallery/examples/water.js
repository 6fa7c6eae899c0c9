import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader } from 'vexture';
import { SimpleWater } from 'vexture/water';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xd5e2ea);
const camera = new THREE.PerspectiveCamera(45, 1, 0.1, 1000);

// sand, which is seen where there is no water
const sand = new THREE.MeshBasicMaterial({ color: 0xcdb98a });
const ground = new THREE.Mesh(new THREE.PlaneGeometry(100, 100).rotateX(-Math.PI / 2), sand);
scene.add(ground);

// the water is where the drawing is, with foam along its outline
const sea = await new VectorTextureLoader().loadAsync('ocean.ktx2');
const water = new SimpleWater(new THREE.PlaneGeometry(100, 100), sea, {
  sunDirection: new THREE.Vector3(-0.5, 0.42, -0.75).normalize(),
  waterColor: 0x1f6f86,
  shallow: 0x6fc5bd,
  foam: { width: 0.02 },
  distortionScale: 3,
});
water.rotation.x = -Math.PI / 2;
water.position.y = 0.1;
scene.add(water);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, maxPolarAngle: 1.5, minDistance: 3, maxDistance: 160 });
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
camera.position.set(22, 9, 34);
controls.target.set(-8, 0, 2);
renderer.setAnimationLoop((now) => {
  water.time = isStill ? 1 : now / 1000;
  controls.update();
  renderer.render(scene, camera);
});
