import * as THREE from 'three';
import { Text } from 'vexture/text';
import { addPanel, fillWindow, moves } from './helpers.js';

// a HUD is a scene of its own: its unit is a pixel, and its origin the top left corner
const hud = new THREE.Scene();
const screen = new THREE.OrthographicCamera(0, 1, 0, -1, -1, 1);
const style = { anchorY: 'top', outlineColor: '#0b1a33', outlineWidth: '8%' };
const score = new Text({ ...style, anchorX: 'right' });
const time = new Text({ ...style, color: '#ffd75e' });
hud.add(score, time);

// below it, a ball runs round a ring of coins
const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('#6fb7e8');
const camera = new THREE.PerspectiveCamera(45, 1, 0.1, 100);
const sun = new THREE.DirectionalLight('#fff3dd', 2.6);
sun.position.set(3, 6, 2);
const solid = (geometry, color) => new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color, roughness: 0.5 }));
const island = solid(new THREE.CylinderGeometry(5, 4.2, 1, 64).translate(0, -0.52, 0), '#5d9b5b');
const track = solid(new THREE.RingGeometry(3.2, 4.4, 96).rotateX(-Math.PI / 2), '#e8d9ae');
const ball = solid(new THREE.SphereGeometry(0.35, 32, 16), '#d8433b');
const gain = new Text({ text: '+250', fontSize: 0.8, anchorX: 'center', color: '#fff3b0', outlineWidth: '8%' });
scene.add(sun, new THREE.HemisphereLight('#ffffff', '#8d9a72', 2), island, track, ball, gain);
const along = (coin, height) => new THREE.Vector3().setFromCylindricalCoords(3.8, (2 * Math.PI * coin) / 16, height);
const coins = Array.from({ length: 16 }, (_, k) => {
  const coin = solid(new THREE.CylinderGeometry(0.3, 0.3, 0.08, 32).rotateX(Math.PI / 2), '#ffc933');
  coin.position.copy(along(k, 0.5));
  return coin;
});
scene.add(...coins);

const panel = addPanel();
const speed = panel.slider('Speed', { min: 0.5, max: 12, value: 3, unit: 'coins a second' });
panel.slider('Size', { min: 16, max: 80, value: 44, step: 1, unit: 'px' }, (size) => (score.fontSize = time.fontSize = size));
panel.slider('Outline', { min: 0, max: 20, value: 8, unit: '%' }, (width) => (score.outlineWidth = time.outlineWidth = `${width}%`));
panel.color('Colour', '#ffffff', (color) => (score.color = color));
const runs = panel.toggle('Run', moves);

fillWindow(renderer, camera);
let [way, points, seconds, last] = [16.5, 0, 0, 0];
renderer.setAnimationLoop((now) => {
  const step = runs.value ? Math.min(now - last, 100) / 1000 : 0;
  [last, seconds, way] = [now, seconds + step, way + speed.value * step];
  points += 997 * speed.value * step;
  ball.position.copy(along(way, 0.35));
  coins.forEach((coin, k) => coin.rotateY(2 * step).visible = (way - k) % 16 > 3);
  gain.position.copy(along(Math.floor(way), 0.8 + (way % 1)));
  gain.fillOpacity = gain.outlineOpacity = 1 - (way % 1);
  camera.position.copy(along(way / 3 + 1, 0)).setLength(9.5 / Math.min(1, camera.aspect)).setY(5);
  camera.lookAt(0, 0.4, 0);
  gain.quaternion.copy(camera.quaternion);

  score.text = Math.floor(points).toLocaleString('en'); // other texts in each frame
  time.text = `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(2).padStart(5, '0')}`;
  [score.position.x, time.position.x] = [innerWidth - 20, 20];
  Object.assign(screen, { right: innerWidth, bottom: -innerHeight }).updateProjectionMatrix();
  renderer.autoClear = true;
  renderer.render(scene, camera);
  renderer.autoClear = false;
  renderer.render(hud, screen);
});
