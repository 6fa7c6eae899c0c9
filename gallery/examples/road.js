import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader, applyVectorMask } from 'vexture';

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
for (const edge of [-1.85, 1.75]) scene.add(new THREE.Mesh(strip(edge, edge + 0.1, 0.005), material(0xf3f0e6)));

// the word lies in the middle of the texture's square, and comes again and again along the road
const words = await new VectorTextureLoader().loadAsync('words.ktx2');
const paint = applyVectorMask(asphalt, words, { mode: 'mix', color: 0xf7f5ee, wrap: 'repeat' });
const times = 5; // stretched along the road, as painted words are
paint.transform.setUvTransform(0, 0, 1, times, 0, 0, 0);

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, maxPolarAngle: 1.5, maxDistance: 30 });
camera.position.copy(middle(-1.5)).add(new THREE.Vector3(0, 1.7, 1));
controls.target.copy(middle(5));
function fit() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', fit);
fit();
renderer.setAnimationLoop(() => controls.update() || renderer.render(scene, camera));
