import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader, applyVectorMask } from 'vexture';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x070b12);
const camera = new THREE.PerspectiveCamera(35, 1, 0.001, 100);
const sun = new THREE.DirectionalLight(0xfff4e2, 3);
scene.add(sun, new THREE.AmbientLight(0x8fb4dd, 0.35));

// the sea is the material, and inside the shape it has the colour of land
const sea = new THREE.MeshStandardMaterial({ color: 0x1d5c86, roughness: 0.55 });
const globe = new THREE.Mesh(new THREE.SphereGeometry(1, 256, 128), sea);
scene.add(globe);
const land = await new VectorTextureLoader().loadAsync('land.ktx2');
const mask = applyVectorMask(sea, land, { mode: 'mix', color: 0x8aa05a });

// the drawing is 360 degrees wide and 180 high: it lies in the middle of its square
mask.transform.setUvTransform(0, 0.25, 1, 0.5, 0, 0, 0);

// the air: the inner side of a larger ball, brightest where it is seen edge-on
const air = new THREE.ShaderMaterial({
  side: THREE.BackSide, transparent: true, depthWrite: false,
  vertexShader: `varying vec3 n; varying vec3 p;
    void main() { n = normalMatrix * normal; p = (modelViewMatrix * vec4(position, 1.0)).xyz;
      gl_Position = projectionMatrix * vec4(p, 1.0); }`,
  fragmentShader: `varying vec3 n; varying vec3 p;
    void main() { gl_FragColor = vec4(0.4, 0.7, 1.0, 1.1 * pow(max(dot(normalize(n), normalize(p)), 0.0), 3.0)); }`,
});
scene.add(new THREE.Mesh(new THREE.SphereGeometry(1.08, 96, 48), air));

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, enablePan: false, minDistance: 1.02, maxDistance: 8, autoRotateSpeed: 0.5 });
camera.position.set(1, 0.85, 0.25);

const panel = addPanel();
const show = (log) => `${Number((6371 * 10 ** log).toPrecision(2)).toLocaleString('en')} km`;
const height = panel.slider('Height', { min: -1.7, max: 0.8, value: innerWidth > 480 ? 0.48 : 0.66, show }, (log) =>
  camera.position.setLength(1 + 10 ** log));
const east = panel.slider('Sun', { min: -180, max: 180, value: -20, step: 1, unit: '°' });
panel.color('Land', '#8aa05a', (color) => (mask.color = color));
panel.color('Sea', '#1d5c86', (color) => sea.color.set(color));
panel.toggle('Turn', moves, (isOn) => (controls.autoRotate = isOn));

fillWindow(renderer, camera);
renderer.setAnimationLoop(() => {
  const above = controls.getDistance() - 1;
  height.value = Math.log10(above); // it follows the wheel
  controls.rotateSpeed = controls.zoomSpeed = Math.min(1, above);
  controls.update();
  const angle = Math.atan2(camera.position.x, camera.position.z) + (east.value * Math.PI) / 180; // from the visitor's meridian
  sun.position.setFromSphericalCoords(1, 1.1, angle);
  renderer.render(scene, camera);
});
