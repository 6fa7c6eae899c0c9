import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader, applyVectorMask } from 'vexture';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x27313b);
const camera = new THREE.PerspectiveCamera(38, 1, 0.1, 60);
const lamp = new THREE.SpotLight(0xfff0d8, 160, 0, 0.7, 0.5);
lamp.position.set(2.5, 4.5, 5);
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
const decal = applyVectorMask(wall.material, texture, { root: 'thumb', mode: 'mix', color: 0x2f6f8f });
decal.transform.setUvTransform(-2.2, -0.7, 12 / 1.8, 6 / 1.8, 0, 0, 0);

// cut out: the shape is lit, and its shadow has its outline
function cutOut(root, color, x) {
  const material = new THREE.MeshStandardMaterial({ color, roughness: 0.4, side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1.9, 1.9), material);
  applyVectorMask(material, texture, { root, mode: 'cut' }).attach(mesh);
  mesh.position.set(x, 0.05, 0.7);
  mesh.castShadow = mesh.receiveShadow = true;
  scene.add(mesh);
  return mesh;
}
const shapes = [cutOut('duck', 0xe8b100, -1.1), cutOut('cake', 0xc8553d, 1.2)];

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 2, maxDistance: 12, maxPolarAngle: 1.6 });
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
camera.position.set(-0.6, 1.2, camera.aspect > 1 ? 6 : 9);
renderer.setAnimationLoop((now) => {
  shapes.forEach((mesh, k) => (mesh.rotation.y = isStill ? 0.3 : 0.5 * Math.sin(now / 1500 + 2 * k)));
  controls.update();
  renderer.render(scene, camera);
});
