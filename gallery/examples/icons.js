import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorMaterial, VectorTextureLoader, rootAttribute } from 'vexture';
import { addPanel, fillWindow, moves } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x10161d);
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 300);
camera.position.set(0, 14, 62);

// each instance shows another shape of the texture, in one draw call
const MOST = 10000;
const icons = await new VectorTextureLoader().loadAsync('lucide.ktx2');
const material = new VectorMaterial({ texture: icons, mode: 'alpha', instanced: true });
const tiles = new THREE.InstancedMesh(new THREE.PlaneGeometry(1, 1), material, MOST);
const shown = Array.from({ length: MOST }, (_, place) => (37 * place) % icons.roots.length);
tiles.geometry.setAttribute('vextureRoot', rootAttribute(icons, shown));
scene.add(tiles);
const inside = new THREE.Mesh(new THREE.SphereGeometry(29.5, 64, 32), new THREE.MeshBasicMaterial({ color: 0x141d27 }));
scene.add(inside); // hides the icons of the far side

// on a ball, each tile facing outwards
const [tile, color] = [new THREE.Object3D(), new THREE.Color()];
function arrange(count) {
  tiles.count = count;
  for (let place = 0; place < count; place++) {
    const height = 1 - (2 * (place + 0.5)) / count;
    const [angle, radius] = [place * Math.PI * (3 - Math.sqrt(5)), Math.sqrt(1 - height * height)];
    tile.position.set(Math.cos(angle) * radius, height, Math.sin(angle) * radius).multiplyScalar(30);
    tile.lookAt(tile.position.clone().multiplyScalar(2));
    tile.scale.setScalar(85 / Math.sqrt(count)); // fewer are larger
    tile.updateMatrix();
    tiles.setMatrixAt(place, tile.matrix);
    tiles.setColorAt(place, color.setHSL(0.52 + 0.16 * height + 0.03 * Math.sin(3 * angle), 0.75, 0.68));
  }
  tiles.instanceMatrix.needsUpdate = tiles.instanceColor.needsUpdate = true;
}

const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, minDistance: 31.5, maxDistance: 160, autoRotateSpeed: 0.25 });

const panel = addPanel();
panel.slider('Icons', { min: 100, max: MOST, value: MOST, step: 100 }, arrange);
panel.slider('Height', { min: 2, max: 60, value: 30 }, (height) => camera.position.setLength(30 + height));
panel.color('Tint', '#ffffff', (tint) => material.color.set(tint));
panel.toggle('Turn', moves, (isOn) => (controls.autoRotate = isOn));

fillWindow(renderer, camera);
renderer.setAnimationLoop(() => {
  controls.rotateSpeed = Math.min(1, (controls.getDistance() - 30) / 30);
  controls.update();
  renderer.render(scene, camera);
});
