import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorMaterial, VectorTextureLoader } from 'vexture';
import { addPanel, fillWindow } from './helpers.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xe9edf0);
const camera = new THREE.PerspectiveCamera(35, 1, 0.001, 20);

const texture = await new VectorTextureLoader().loadAsync('counties.ktx2');
const material = new VectorMaterial({ texture, mode: 'paint', side: THREE.DoubleSide });
const map = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
material.mask.attach(map); // rays tell which county they meet
scene.add(map);

// percentages of each county: unemployment of 2009 (Bureau of Labor Statistics), habitats (U.S. Geological Survey)
const { figures, counties } = await (await fetch('figures.json')).json();
const names = texture.roots[0].style.elements.map(({ name }) => name);
const [COLORS, UNKNOWN] = [['#fff7d6', '#fed98e', '#fe9929', '#d95f0e', '#a63603', '#6b1d04'], '#b9c1c8'];
let [figure, steps, colors, hovered] = [0, [], new Map(), null];

/** Show one of the figures: six classes of equally many counties, and their legend. */
function show(name) {
  figure = figures.indexOf(name);
  const sorted = names.map((one) => counties[one][figure]).filter((value) => value !== null).sort((a, b) => a - b);
  steps = COLORS.map((_, k) => sorted[Math.floor((k * sorted.length) / COLORS.length)]);
  const classOf = (value) => (value === null ? -1 : steps.findLastIndex((from) => value >= from));
  colors = new Map(names.map((one) => [one, COLORS[classOf(counties[one][figure])] ?? UNKNOWN]));
  texture.setPaints(colors); // no tree is built: the changed rows are sent to the graphics card
  legend([...COLORS.map((color, k) => [color, `from ${steps[k]} %`]), [UNKNOWN, 'no figure']]);
}
function hover(name) {
  if (name === hovered) return;
  texture.setPaints({ ...(hovered && { [hovered]: colors.get(hovered) }), ...(name && { [name]: '#2b7fff' }) });
  hovered = name;
  line.textContent = name ? `${name}: ${counties[name][figure] ?? 'no figure'} %` : 'Point at a county';
}

const panel = addPanel('Share in per cent');
const legend = panel.legend();
panel.choice('Of', figures, show);
const line = panel.text('Point at a county');
panel.slider('Tilt', { min: 0, max: 75, value: 15, step: 1, unit: '°' }, (tilt) => (map.rotation.x = (-tilt * Math.PI) / 180));

const [caster, pointer] = [new THREE.Raycaster(), new THREE.Vector2(9, 9)];
const point = ({ clientX, clientY }) => pointer.set((2 * clientX) / innerWidth - 1, 1 - (2 * clientY) / innerHeight);
for (const type of ['pointermove', 'pointerdown']) renderer.domElement.addEventListener(type, point);
const controls = new OrbitControls(camera, renderer.domElement);
Object.assign(controls, { enableDamping: true, zoomToCursor: true, minDistance: 0.05, maxDistance: 8 });
fillWindow(renderer, camera);
camera.position.set(0, 0, Math.max(2.7, 3.2 / camera.aspect));
renderer.setAnimationLoop(() => {
  caster.setFromCamera(pointer, camera);
  hover(caster.intersectObject(map)[0]?.element?.name ?? null);
  controls.update();
  renderer.render(scene, camera);
});
