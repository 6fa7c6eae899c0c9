import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VectorTexturePlugin } from 'vexture/gltf';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xcfe0ea);
const camera = new THREE.PerspectiveCamera(35, 1, 0.05, 100);
const sun = new THREE.DirectionalLight(0xfff3e0, 2.6);
sun.position.set(3, 6, 5);
sun.castShadow = true;
sun.shadow.mapSize.set(2048, 2048);
scene.add(sun, new THREE.HemisphereLight(0xffffff, 0x8a8575, 1.6));

// the model holds the drawing: a loader without the plugin shows the plain van
const loader = new GLTFLoader().register((parser) => new VectorTexturePlugin(parser));
const { scene: van } = await loader.loadAsync('van.glb');
van.traverse((mesh) => (mesh.castShadow = mesh.receiveShadow = true));
scene.add(van);
const second = van.clone(); // has its drawing, too
second.position.set(-1.4, 0, -2.6);
second.rotation.y = 0.5;
scene.add(second);
const street = new THREE.Mesh(new THREE.CircleGeometry(14, 64).rotateX(-Math.PI / 2), new THREE.MeshStandardMaterial({ color: 0xb3b6b2 }));
street.receiveShadow = true;
scene.add(street);

const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(-0.2, 0.9, 0);
controls.autoRotate = !matchMedia('(prefers-reduced-motion: reduce)').matches;
Object.assign(controls, { enableDamping: true, maxPolarAngle: 1.5, minDistance: 1.5, maxDistance: 18, autoRotateSpeed: 0.5 });
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
camera.position.set(2.6, 2.2, 7.2).multiplyScalar(camera.aspect > 1 ? 1 : 1.5);
renderer.setAnimationLoop(() => {
  controls.update();
  renderer.render(scene, camera);
});
