import * as THREE from 'three/webgpu';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { color, mix, positionLocal, sin, time, uv } from 'three/tsl';
import { VectorTextureLoader, vectorColor } from 'vexture/webgpu';

const renderer = new THREE.WebGPURenderer({ antialias: true }); // of itself it takes WebGL 2 where there is no WebGPU
await renderer.init();
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const label = document.createElement('output');
label.style.cssText = 'position: fixed; left: 1rem; top: 1rem; color: #fff';
label.textContent = renderer.backend.isWebGPUBackend ? 'This is WebGPU.' : 'There is no WebGPU here: this is WebGL 2.';
document.body.append(renderer.domElement, label);

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x16222d);
const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 50);
const sun = new THREE.DirectionalLight(0xffffff, 2.5);
sun.position.set(2, 3, 4);
scene.add(sun, new THREE.HemisphereLight(0xffffff, 0x506070, 1.5));

// the drawing is a node: here it lies over cloth, and the cloth waves
const logo = await new VectorTextureLoader().loadAsync('logo.ktx2');
const place = uv().sub(0.5).mul(1.15).add(0.5);
const drawing = vectorColor(logo, { uv: place });
const stripes = mix(color(0xe7dcc4), color(0xd8c9a8), sin(uv().y.mul(250)).mul(0.5).add(0.5));
const cloth = new THREE.MeshStandardNodeMaterial({ roughness: 0.8, side: THREE.DoubleSide });
cloth.colorNode = mix(stripes, drawing.rgb, drawing.a);
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
const wave = sin(positionLocal.x.mul(3).add(isStill ? 1 : time.mul(2))).mul(uv().x).mul(0.15);
cloth.positionNode = positionLocal.add(wave.mul(new THREE.Vector3(0, 0.15, 1)));
scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2.4, 2.4, 96, 32), cloth));

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 0.3, maxDistance: 9 });
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
camera.position.set(0.9, 0.4, Math.max(3.8, 4.2 / camera.aspect));
renderer.setAnimationLoop(() => {
  controls.update();
  renderer.render(scene, camera);
});
