import * as THREE from 'three';
import { VectorTextureLoader, applyVectorMask } from 'vexture';
import { addPanel, fillWindow } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xbfdcf0);
scene.fog = new THREE.Fog(0xbfdcf0, 20, 60);
const camera = new THREE.PerspectiveCamera(50, 1, 0.05, 200);
const sun = new THREE.DirectionalLight(0xfff2dd, 2);
sun.position.set(-4, 6, 3);
scene.add(new THREE.HemisphereLight(0xffffff, 0x6b7a55, 1.6), sun);

// the middle of the road, which winds and climbs; a strip along it, u across and v along
const middle = (s) => new THREE.Vector3(4 * Math.sin(s / 9), 1.2 * (1 - Math.cos(s / 8)), -s);
const [WIDTH, LENGTH, STEPS] = [4, 60, 400];
const strip = (from, to, lift) => {
  const geometry = new THREE.PlaneGeometry(1, 1, 8, STEPS);
  const { position, uv } = geometry.attributes;
  for (let i = 0; i < position.count; i++) {
    const s = LENGTH * uv.getY(i) - 4;
    const ahead = middle(s + 0.01).sub(middle(s)).normalize();
    const right = new THREE.Vector3(-ahead.z, 0, ahead.x).normalize();
    const at = middle(s).addScaledVector(right, from + (to - from) * uv.getX(i));
    position.setXYZ(i, at.x, at.y + lift, at.z);
  }
  geometry.computeVertexNormals();
  return geometry;
};
const material = (color) => new THREE.MeshStandardMaterial({ color, roughness: 0.95, side: THREE.DoubleSide });
const asphalt = material(0x3b3f44);
scene.add(new THREE.Mesh(strip(-30, 30, -0.03), material(0x7f9a5b)));
scene.add(new THREE.Mesh(strip(-WIDTH / 2, WIDTH / 2, -0.005), material(0x3b3f44)));
scene.add(new THREE.Mesh(strip(-1.5, 1.5, 0), asphalt));
const lines = [-1.85, 1.75].map((edge) => new THREE.Mesh(strip(edge, edge + 0.1, 0.005), material(0xf3f0e6)));
scene.add(...lines);

// the word lies in the middle of the texture's square, and comes again and again along the road
const loader = new VectorTextureLoader();
const names = ['slow', 'bus', 'school'];
const words = await Promise.all(names.map((word) => loader.loadAsync(`${word}.ktx2`)));
const paint = applyVectorMask(asphalt, words[0], { mode: 'mix', wrap: 'repeat' });

const panel = addPanel();
panel.choice('Word', names, (word) => (paint.texture = words[names.indexOf(word)]));
panel.slider('Times', { min: 3, max: 30, value: 5, step: 1 }, (times) => paint.transform.setUvTransform(0, 0, 1, times, 0, 0, 0));
panel.color('Paint', '#f7f5ee', (color) => (paint.color = color));
const way = panel.slider('Way', { min: 0, max: 42, value: 0, unit: 'm' });
const height = panel.slider('Eyes', { min: 0.5, max: 8, value: 1.7, unit: 'm' });
const drive = panel.toggle('Drive', false);

fillWindow(renderer, camera);
let last = 0;
renderer.setAnimationLoop((now) => {
  if (drive.value) way.value = (way.value + (now - last) / 250) % 42;
  last = now;
  camera.position.copy(middle(way.value - 2.5)).y += height.value;
  camera.lookAt(middle(way.value + 5));
  renderer.render(scene, camera);
});
