import * as THREE from 'three/webgpu';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { positionLocal, sin, time, uniform, uv, vec3 } from 'three/tsl';
import { VectorTextureLoader, vectorColor } from 'vexture/webgpu';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGPURenderer({ antialias: true }); // of itself it takes WebGL 2 where there is no WebGPU
await renderer.init();
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const panel = addPanel();
panel.text(renderer.backend.isWebGPUBackend ? 'This is WebGPU.' : 'There is no WebGPU here: this is WebGL 2.');

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x9cc3de);
const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 50);
const sun = new THREE.DirectionalLight(0xffffff, 2.5);
sun.position.set(2, 3, 4);
scene.add(sun, new THREE.HemisphereLight(0xffffff, 0x506070, 1.5));

// the drawing is a node: here it is mixed with the threads of a cloth, and the cloth waves
const loader = new VectorTextureLoader();
const names = ['Wales', 'Bhutan', 'Brazil'];
const flags = await Promise.all(['gb-wls', 'bt', 'br'].map((code) => loader.loadAsync(`${code}.ktx2`)));
const place = uv().mul(vec3(1, 0.75, 0).xy).add(vec3(0, 0.125, 0).xy); // a flag is 4 to 3, in the middle of its square
const [wind, threads] = [uniform(1), uniform(0)];
const weave = sin(uv().x.mul(320)).mul(sin(uv().y.mul(240))).mul(threads).add(1);
const phase = positionLocal.x.mul(3.5).sub(moves ? time.mul(wind).mul(3) : 1);
const wave = sin(phase).add(sin(phase.mul(0.6).add(positionLocal.y)).mul(0.6)).mul(uv().x).mul(wind).mul(0.14);
const cloth = (flag) => {
  const material = new THREE.MeshStandardNodeMaterial({ roughness: 0.8, side: THREE.DoubleSide });
  material.colorNode = vectorColor(flag, { uv: place }).rgb.mul(weave);
  material.positionNode = positionLocal.add(vec3(0, 0.1, 1).mul(wave));
  return material;
};
const flag = new THREE.Mesh(new THREE.PlaneGeometry(2.4, 1.8, 96, 32));
const steel = new THREE.MeshStandardMaterial({ color: 0xb9bec4, roughness: 0.4 });
const pole = new THREE.Mesh(new THREE.CylinderGeometry(0.03, 0.03, 3.4), steel);
pole.position.set(-1.23, -0.7, 0);
scene.add(flag, pole);

panel.choice('Flag', names, (name) => (flag.material = cloth(flags[names.indexOf(name)])));
panel.slider('Wind', { min: 0, max: 2, value: 1 }, (speed) => (wind.value = speed));
panel.slider('Threads', { min: 0, max: 0.5, value: 0.08 }, (depth) => (threads.value = depth));

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 0.3, maxDistance: 9 });
fillWindow(renderer, camera);
camera.position.set(0.5, 0.1, Math.max(3.6, 4.1 / camera.aspect));
renderer.setAnimationLoop(() => {
  controls.update();
  renderer.render(scene, camera);
});
