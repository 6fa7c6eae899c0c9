/** Entry of the page of `vexture flood`: makes and connects its elements, and starts. */
import { Matrix3, SRGBColorSpace, TextureLoader } from 'three';
import { FoldTexture } from '../src/fold-texture.js';
import { SimpleWater, chooseWater } from '../src/water/index.js';
import { element } from '../viewer/dom.js';
import { createBearings } from './bearings.js';
import { still } from './capture.js';
import { createChart } from './chart.js';
import { Notes } from '../viewer/notes.js';
import { bytesOf } from '../viewer/library.js';
import { readLevels } from './levels.js';
import { opennessOver } from './openness.js';
import { hashOf, lookOf } from './link.js';
import { createPanel, creditLines } from './panel.js';
import { createPin } from './pin.js';
import { Places } from './place.js';
import { Player } from './player.js';
import { wholes } from './presets.js';
import { createReadout } from './readout.js';
import { Relief, Surface } from './relief.js';
import { readScene } from './page-data.js';
import { Sea } from './sea.js';
import { Stage } from './stage.js';
import { createShades } from './shade-row.js';
import { Steps, levelsOf } from './steps.js';
import { createTimeBar } from './time-bar.js';
import { createTakeaway } from './takeaway.js';
import { Tray } from './tray.js';

/** @typedef {import('./presets.js').View} View */

const DRY = 'Nothing is under water at this time.';

/** Side of the mirror's image in pixels. */
const MIRROR = 512;

const bare = new URLSearchParams(location.search).has('bare');
const app = /** @type {HTMLElement} */ (document.getElementById('app'));
const canvas = element('canvas', {
  tabindex: 0, role: 'application', 'aria-label':
    'Picture of the flood. Drag to turn it, drag with the right button to move, wheel to zoom; keys 1 to 9 are the '
    + 'views, [ and ] go through the steps.',
});
const notes = new Notes();

/** Transform from the box to the unit square. @param {import('./page-data.js').FrameFacts} frame */
function boxTransform({ box: [u0, v0, u1, v1] }) {
  return new Matrix3().set(u1 - u0, 0, u0, 0, v1 - v0, v0, 0, 0, 1);
}

/** @param {string | null} url */
async function pictureOf(url) {
  if (!url) return null;
  const texture = await new TextureLoader().loadAsync(new URL(url, document.baseURI).href);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

/** How far the camera is from what it looks at, in halves of its size. */
const DISTANCE = 2.2;

/** The page's views. @param {import('./page-data.js').Flood} flood @param {Surface} surface @returns {View[]} */
function viewsOf({ views }, surface) {
  const { places } = surface;
  const found = views.map(({ name, kind, place, toward: [x, y], reach, above }) => ({
    name, kind, place: places.toWorld(...places.fromUnit(...place)), toward: /** @type {[number, number]} */ ([x, -y]),
    away: DISTANCE * reach * places.scale, above: () => above * surface.rise,
  }));
  return [...wholes(found.at(-1)?.toward ?? [0, 1]), ...found];
}

/** The scene's dimensions for the views. @param {Surface} surface */
function standOf(surface) {
  const { places } = surface;
  return {
    width: places.width + 2 * Tray.around, depth: places.depth + 2 * Tray.around,
    height: (/** @type {number} */ px, /** @type {number} */ pz) => surface.height(px, pz),
    ground: (/** @type {number} */ px, /** @type {number} */ pz) => surface.ground(px, pz),
  };
}

/** Note why the last update of a step was refused, until one is accepted. @param {import('./steps.js').Step} step */
function tell({ name, manifest }) {
  notes.keep(`step ${name}`, manifest.note ?? '');
}

/** @param {Stage} stage @param {Player} player */
function follow(stage, player) {
  player.addEventListener('step', () => {
    const { step } = player;
    notes.keep('dry', step?.manifest.facts?.dry ? DRY : '');
    if (step) tell(step);
    stage.requestFrame();
  });
  player.addEventListener('newer', () => notes.say(`There is newer water: ${player.label(player.count - 1)}.`));
  player.addEventListener('failed', (event) => notes.say(/** @type {CustomEvent<Error>} */ (event).detail.message));
  stage.addEventListener('lost', () => notes.keep('driver', 'The graphics driver was reset; waiting for it…'));
  stage.addEventListener('restored', () => notes.keep('driver', ''));
}

/** Note that a server is lost or back, once for each texture. */
function listener() {
  const known = new WeakSet();
  return (/** @type {import('./steps.js').Step} */ step) => {
    const { name, texture } = step;
    if (known.has(texture)) return;
    known.add(texture);
    texture.addEventListener('note', ({ message }) => notes.keep(`step ${name}`, message));
    texture.addEventListener('change', () => tell(step));
    texture.addEventListener('offline', () =>
      notes.keep('server', 'Offline: the server does not answer. The last water stays.'));
    texture.addEventListener('online', () => notes.keep('server', ''));
  };
}

/** @param {View[]} views @param {(view: View) => void} viewed @param {Player} player */
function listenToKeys(views, viewed, player) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement) return;
    const view = views[Number(event.key) - 1];
    if (view) viewed(view);
    else if (event.key === '[' || event.key === ']') {
      player.pause();
      void player.go(player.index + (event.key === ']' ? 1 : -1));
    }
  });
}

/** Share of the page's height that is left for the picture, even if the legend or the scale then stand over it. */
const LEAST_FREE = 0.3;

/**
 * The part of the canvas that nothing covers.
 *
 * @param {Element} panel
 * @param {Element} bar
 * @param {Element[]} above what stands above the bar, where the panel is as wide as the page and enough is left free
 */
function insetOf(panel, bar, above) {
  const over = panel.getBoundingClientRect();
  const { height: bottom } = bar.getBoundingClientRect();
  if (over.width < innerWidth / 2) return { left: over.right, bottom };
  const tops = above.map((one) => one.getBoundingClientRect()).filter(({ height }) => height > 0).map(({ top }) => top);
  const free = tops.filter((top) => top - over.bottom > LEAST_FREE * innerHeight);
  return { top: over.bottom, bottom: Math.max(bottom, ...free.map((top) => innerHeight - top)) };
}

async function start() {
  const scene = readScene();
  const { flood } = scene;
  document.title = flood.title;
  const places = new Places(flood.frame);
  const surface = new Surface(Relief.read(flood.relief, await bytesOf(flood.relief.heights, document.baseURI)), places);
  const picture = await pictureOf(flood.ground);
  const fold = flood.fold ? await FoldTexture.parse(await bytesOf(flood.fold, document.baseURI)) : null;
  const openness = opennessOver(
    surface.relief, flood.openness ? new Uint8Array(await bytesOf(flood.openness, document.baseURI)) : null,
  );
  const Water = matchMedia('(max-width: 720px)').matches ? SimpleWater : chooseWater();
  const views = viewsOf(flood, surface);
  let stage;
  try {
    stage = new Stage(canvas, surface, {
      picture,
      stand: standOf(surface),
      lit: /** @type {View} */ (views.at(-1)),
      sea: (sun) => new Sea(Water, surface, {
        transform: boxTransform(flood.frame), fold, sun, mirror: MIRROR, openness,
      }),
    });
  } catch (error) {
    console.warn(error);
    app.append(element('p', { class: 'fatal', role: 'alert' },
      'This page draws with WebGL 2, which this browser does not offer. Try a newer browser, or switch on hardware '
      + 'acceleration in its settings.'));
    return;
  }
  await run(stage, scene, views, fold);
}

/**
 * @param {Stage} stage @param {import('./page-data.js').Scene} scene @param {View[]} views
 * @param {FoldTexture | null} fold
 */
async function run(stage, scene, views, fold) {
  const { flood } = scene;
  const { surface } = stage;
  const steps = new Steps(scene);
  const heard = listener();
  /** @type {WeakMap<import('./steps.js').Step, import('./levels.js').Levels | null>} */
  const surfaces = new WeakMap();
  const player = new Player(steps, {
    show: (step, fading) => {
      stage.sea.show(step.texture, surfaces.get(step)?.levels ?? null, fading);
      stage.requestFrame();
    },
    prepare: async (step) => {
      heard(step);
      const found = await levelsOf(step);
      surfaces.set(step, found && readLevels(found.png, found.facts, surface.relief));
      for (const texture of Object.values(step.texture.textures)) stage.renderer.initTexture(texture);
    },
  });
  follow(stage, player);
  const viewed = (/** @type {View} */ view, how = {}) => {
    stage.view(view, how);
    shown = view;
    panel.mark(view);
  };
  const named = (/** @type {string} */ name) => /** @type {View} */ (views.find((view) => view.name === name));
  const { region: readout, placeAt } = createReadout(stage, player, surface, fold);
  const levelsAt = async (/** @type {string} */ name) => {
    const step = await steps.open(name);
    const found = await levelsOf(step);
    return { step, surface: found && readLevels(found.png, found.facts, surface.relief) };
  };
  const shades = createShades(stage, player, flood, levelsAt);
  let shown = /** @type {View | null} */ (null);
  const caption = () => ({
    title: flood.title, when: player.count > 1 && !shades.isOfAll ? player.label(player.index) : '', shade: shades.shade,
    credits: creditLines(flood.credits).join(' '),
  });
  const takeaway = createTakeaway(stage, player, {
    name: flood.title.replace(/[^\p{L}\p{N}]+/gu, '-'),
    say: (message) => notes.say(message),
    caption,
    link: () => {
      const { camera, controls } = stage;
      const pose = [camera.position, controls.target].flatMap(({ x, y, z }) => [x, y, z]);
      const where = stage.plan ? { plan: stage.plan } : { camera: pose };
      const hash = hashOf({ step: player.index, view: shown?.name, ...where, colours: shades.value });
      return hash || location.pathname + location.search;
    },
  });
  const panel = createPanel(stage, surface, {
    title: flood.title, credits: flood.credits, notes: flood.notes, readout, shades: shades.row, takeaway, all: views, viewed,
  });
  stage.controls.addEventListener('start', () => {
    shown = null;
    panel.mark(null);
  });
  listenToKeys(views, viewed, player);
  const bar = createTimeBar(player);
  const pin = createPin(stage);
  bar.append(createChart(stage, player, placeAt, levelsAt, pin.mark));
  if (!bare) {
    const above = [shades.legend, createBearings(stage)];
    app.append(pin.element, panel.panel, bar, ...above, notes.element);
    stage.inset = () => insetOf(panel.panel, bar, above);
    new ResizeObserver(() => app.style.setProperty('--bar', `${bar.offsetHeight}px`)).observe(bar);
    new ResizeObserver(() => stage.resize()).observe(shades.legend);
  }
  stage.resize();
  viewed(views[1], { fly: false });
  Object.defineProperties(page, Object.getOwnPropertyDescriptors({
    get camera() {
      return stage.camera;
    },
    views: views.map(({ name }) => name),
    water: stage.sea.water,
    stage,
    player,
    view: (/** @type {string} */ name, how = {}) => viewed(named(name), how),
    pose: (/** @type {string} */ name) => stage.pose(named(name)),
    step: (/** @type {number} */ at) => player.go(at),
    colours: (/** @type {string} */ shade) => shades.choose(shade),
    get offered() {
      return shades.offered;
    },
    frame: async (/** @type {number} */ at, /** @type {number} */ seconds, /** @type {boolean} */ plain) => {
      if (player.index !== at) await player.go(at);
      if (player.index !== at) throw new Error(`Step ${at + 1} cannot be shown.`);
      await shades.settled();
      return still(stage, plain ? null : caption(), seconds);
    },
    freeze: (/** @type {number | null} */ seconds) => stage.freeze(seconds),
    flat: (/** @type {boolean} */ on) => stage.flat(on),
    relief: (/** @type {number} */ times) => stage.relief(times),
    render: () => stage.render(),
  }));
  const look = lookOf(location.hash);
  await player.start(look.step);
  if (look.colours) void shades.choose(look.colours);
  const wanted = views.find(({ name }) => name === look.view);
  if (wanted) viewed(wanted, { fly: false });
  else if (look.camera || look.plan) {
    if (look.plan) stage.standAbove(look.plan);
    else if (look.camera) stage.stand(look.camera);
    shown = null;
    panel.mark(null);
  }
  stage.render();
  steps.follow();
}

app.append(element('main', { class: 'stage' }, canvas));
app.classList.toggle('bare', bare);

/** For tests and for the curious. @type {Record<string, unknown>} */
const page = { ready: null };
Object.assign(window, { vexture: { flood: page } });
page.ready = start().catch((error) => {
  app.append(element('p', { class: 'fatal', role: 'alert' }, `The flood cannot be shown: ${error.message}`));
  throw error;
});
