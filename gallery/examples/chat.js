import * as THREE from 'three';
import { Glyphs, Text } from 'vexture/text';
import { addPanel, fillWindow, moves } from './helpers.js';

// fonts in order of preference: of each character the first that has it
const scripts = ['latin', 'georgian', 'arabic', 'hebrew', 'devanagari', 'thai', 'korean', 'japanese'];
const font = [...scripts.map((script) => `${script}.woff`), 'emoji.woff'];
const messages = await (await fetch('messages.json')).json();

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('#101826');
scene.fog = new THREE.Fog('#101826', 14, 42);
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);

// the wall is tilted; its list of messages moves up, the newest at its lower end
const [WIDTH, HEIGHT] = [9, 30];
const [wall, list, lines] = [new THREE.Group(), new THREE.Group(), []];
wall.add(list);
scene.add(wall);
const [card, grey] = [new THREE.PlaneGeometry(1, 1).translate(0, -0.5, 0), new THREE.MeshBasicMaterial({ color: '#1d2a3d' })];
let [length, count] = [0, 0];

async function say([name, words]) {
  const text = new Text({
    font, text: `${name}\n${words}`, fontSize: size.value, maxWidth: WIDTH, lineHeight: 1.4, color: 'white', anchorY: 'top',
    colorRanges: { 0: new THREE.Color().setHSL((0.618 * count++) % 1, 0.8, 0.7), [name.length]: 'white' },
  });
  await text.sync();
  const height = text.layout.blockBounds[3] - text.layout.blockBounds[1];
  const back = new THREE.Mesh(card, grey);
  back.scale.set(WIDTH + 0.6, height + 0.3, 1);
  back.position.set(WIDTH / 2, 0.15, -0.02);
  text.position.set(-WIDTH / 2, -length, 0);
  list.add(text.add(back));
  lines.push(text);
  length += height + 0.5;
  line.textContent = `${count} messages, ${Glyphs.shared.characters.length} different characters so far`;
}

const panel = addPanel();
const line = panel.text();
const period = panel.slider('Every', { min: 0.1, max: 4, value: 1, unit: 's' });
const size = panel.slider('Size', { min: 0.25, max: 1.2, value: 0.6 });
panel.slider('Tilt', { min: 0, max: 80, value: 42, step: 1, unit: '°' }, (angle) => (wall.rotation.x = (-angle * Math.PI) / 180));
const runs = panel.toggle('Live', moves);

for (const message of messages.slice(0, 12)) await say(message);
list.position.y = length;
fillWindow(renderer, camera);
let [last, before] = [0, 0];
renderer.setAnimationLoop((now) => {
  if (runs.value && now - last > 1000 * period.value) {
    last = now;
    say(messages[count % messages.length]);
  }
  list.position.y = THREE.MathUtils.damp(list.position.y, length, 6, (now - before) / 1000);
  before = now;
  while (lines[0].position.y + list.position.y > HEIGHT) lines.shift().removeFromParent().dispose();
  camera.position.set(0, 4.2, 14 / Math.min(1, camera.aspect));
  renderer.render(scene, camera);
});
