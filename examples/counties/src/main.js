// The page: a map of all counties on a bent sheet, which gets other colours in each frame.
import { Color, PerspectiveCamera, Raycaster, Scene, Vector2, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { VectorTextureLoader } from 'vexture';
import bordersFile from 'converted/borders.ktx2';
import countiesFile from 'converted/counties.ktx2';
import facts from 'converted/facts.json';
import { SHADES, ownOf, rateAt, shadeOf } from './rate.js';
import { surfaceOf } from './surface.js';

const HOVERED = [1, 1, 1, 1];
const PICKED = [1, 0.36, 0.3, 1];
const FADING = 0.6; // distance below which the lines between states fade, as they would be wide
const STILL = 5; // pixels that the pointer may move in a click

const byId = (id) => document.getElementById(id);

async function start() {
  const loader = new VectorTextureLoader();
  const [texture, borders] = await Promise.all([countiesFile, bordersFile].map((file) => loader.loadAsync(file)));
  const page = makePage(texture, borders);
  page.fit();
  page.whole();
  addEventListener('resize', page.fit);
  window.counties = page; // for measurements and tests
  page.renderer.setAnimationLoop(page.frame);
}

function makePage(texture, borders) {
  // counties too small for the map have no element
  const ids = texture.roots[0].style.elements.map(({ name }) => name);
  const own = new Map(ids.map((id) => [id, ownOf(id)]));
  const paints = new Map(ids.map((id) => [id, SHADES[0]]));
  const view = makeView(surfaceOf(texture, borders));
  const state = { seconds: 0, playing: !matchMedia('(prefers-reduced-motion: reduce)').matches, hovered: null, picked: null };
  const rateOf = (id) => rateAt(facts[id][2], facts[id][3], own.get(id), state.seconds);
  const paintOf = (id) => (id === state.picked ? PICKED : id === state.hovered ? HOVERED : shadeOf(rateOf(id)));

  /** New colours for all counties. */
  function recolor() {
    for (const id of ids) paints.set(id, paintOf(id));
    texture.setPaints(paints);
    view.change();
  }

  /** Another county hovered or picked: the two that change. */
  function mark(what, id) {
    const before = state[what];
    if (id === before) return;
    state[what] = id;
    texture.setPaints(new Map([before, id].filter((one) => one !== null).map((one) => [one, paintOf(one)])));
    view.change();
  }

  const pointer = watchPointer(view, (id) => mark('picked', id));
  const show = makePanel(state, view, rateOf);
  let last = 0;

  function frame(now) {
    const spent = Math.min(now - last, 100); // a hidden page stands still
    last = now;
    mark('hovered', view.countyAt(pointer));
    const begun = performance.now();
    if (state.playing) {
      state.seconds += spent / 1000;
      recolor();
    }
    show(pointer, performance.now() - begun, spent);
    view.draw();
  }

  recolor();
  return { texture, state, recolor, frame, ...view };
}

/** The canvas, and what of the map is seen there. */
function makeView([map, lines]) {
  const renderer = new WebGLRenderer({ antialias: true });
  document.body.prepend(renderer.domElement);
  const scene = new Scene();
  scene.background = new Color(0x10161d);
  scene.add(map, lines);
  const camera = new PerspectiveCamera(32, 1, 0.001, 20);
  const controls = Object.assign(new OrbitControls(camera, renderer.domElement), {
    enableDamping: true, zoomToCursor: true, minDistance: 0.02, maxDistance: 9, maxAzimuthAngle: 1, minAzimuthAngle: -1,
    minPolarAngle: 0.6, maxPolarAngle: 2.2,
  });
  const caster = new Raycaster();
  let isChanged = true;
  const change = () => (isChanged = true);
  controls.addEventListener('change', change);

  function whole() {
    controls.target.set(0, 0, -0.15);
    const halfHeight = Math.tan((camera.fov * Math.PI) / 360);
    const distance = Math.max(0.98 / (halfHeight * camera.aspect), 0.82 / halfHeight); // for the width, or for the height
    camera.position.set(0, -0.5 * distance, 0.87 * distance).add(controls.target);
    controls.update();
  }

  function fit() {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    change();
  }

  /** Id of the county at a place of the window, or null. */
  function countyAt({ x, y, isOver }) {
    if (!isOver) return null;
    caster.setFromCamera(new Vector2((2 * x) / innerWidth - 1, 1 - (2 * y) / innerHeight), camera);
    return caster.intersectObject(map)[0]?.element?.name ?? null;
  }

  /** Draw what has changed; a page that stands still costs nothing. */
  function draw() {
    controls.update();
    if (!isChanged) return;
    isChanged = false;
    lines.material.opacity = Math.min(1, controls.getDistance() / FADING);
    renderer.render(scene, camera);
  }

  return { renderer, camera, controls, change, whole, fit, countyAt, draw };
}

/** Where the pointer is, kept up to date; a click calls `pick`. */
function watchPointer({ renderer, countyAt }, pick) {
  const pointer = { x: 0, y: 0, isOver: false };
  const canvas = renderer.domElement;
  let from = null;
  const move = ({ clientX, clientY }) => Object.assign(pointer, { x: clientX, y: clientY, isOver: true });
  canvas.addEventListener('pointermove', move);
  canvas.addEventListener('pointerdown', (event) => {
    move(event);
    from = [event.clientX, event.clientY];
  });
  canvas.addEventListener('pointerup', ({ clientX, clientY, pointerType }) => {
    if (from && Math.hypot(clientX - from[0], clientY - from[1]) <= STILL) pick(countyAt(pointer));
    from = null;
    pointer.isOver = pointerType === 'mouse';
  });
  canvas.addEventListener('pointerleave', () => (pointer.isOver = false));
  return pointer;
}

/** The legend, the buttons and the texts; returns what updates the texts. */
function makePanel(state, { whole }, rateOf) {
  const context = byId('legend').querySelector('canvas').getContext('2d');
  SHADES.forEach(([r, g, b], step) => {
    context.fillStyle = `rgb(${255 * r} ${255 * g} ${255 * b})`;
    context.fillRect(step, 0, 1, 1);
  });
  const play = byId('play');
  const tell = () => (play.textContent = state.playing ? 'Pause' : 'Play');
  play.addEventListener('click', () => {
    state.playing = !state.playing;
    tell();
  });
  tell();
  byId('whole').addEventListener('click', whole);
  const [label, cost] = [byId('label'), byId('cost')];
  const [name, rate] = byId('picked').children;
  const percent = (id) => `${(100 * rateOf(id)).toFixed(1)} %`;
  const mean = { colors: 0, frame: 0 };

  return ({ x, y }, colors, spent) => {
    const { hovered, picked } = state;
    label.hidden = hovered === null;
    if (hovered !== null) {
      label.textContent = `${facts[hovered][0]}, ${facts[hovered][1]}: ${percent(hovered)}`;
      const left = Math.max(8, Math.min(x + 14, innerWidth - label.offsetWidth - 8));
      label.style.transform = `translate(${left}px, ${y > 60 ? y - 44 : y + 20}px)`;
    }
    name.textContent = picked === null ? '' : `${facts[picked][0]}, ${facts[picked][1]}`;
    rate.textContent = picked === null ? 'no county picked' : percent(picked);
    mean.colors += (colors - mean.colors) / 30;
    mean.frame += (spent - mean.frame) / 30;
    cost.textContent = state.playing ? `colours ${mean.colors.toFixed(1)} ms of a frame's ${mean.frame.toFixed(0)} ms` : '';
  };
}

start();
