/** The rendered scene, its camera and its frames. */
import {
  BackSide, Color, DirectionalLight, HemisphereLight, MOUSE, Mesh, MeshBasicMaterial, OrthographicCamera,
  PerspectiveCamera, Scene, SphereGeometry, TOUCH, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { skyTexture } from './canvas-textures.js';
import { Land } from './land.js';
import { FIELD, between, planHeight, pose, sunOver } from './presets.js';
import { mostSamples, sharpen } from './sharpness.js';
import { Tray } from './tray.js';

/** @typedef {import('./presets.js').View} View @typedef {import('./presets.js').Pose} Pose */

const MOST_RATIO = 2;
const FLIGHT = 2600; // ms
const SKY = 900;
/** Least height of the camera above the surface, in world units. */
const CLEARANCE = 0.25;
const MOST_DISTANCE = 420;
/** Height of the camera of a plan. */
const ALOFT = 2000;
/** Colours of the flat picture, for measurements: the ground and all around it, the water. */
const FLAT = Object.freeze({ ground: 0x000000, water: 0xffffff });

const STILL = matchMedia('(prefers-reduced-motion: reduce)');

/**
 * Events: `frame` after each frame, `relief` when the exaggeration changes, `lost` and `restored` for the context.
 */
export class Stage extends EventTarget {
  #stand;
  #sky;
  #background = new Color(FLAT.ground);
  #wanted = false;
  #isFlat = false;
  /** @type {{start: Pose, end: Pose, begin: number, isPlan: boolean} | null} */
  #flight = null;
  #perspective = new PerspectiveCamera(FIELD, 1, 0.05, 2 * SKY);
  #plan = new OrthographicCamera(-1, 1, 1, -1, 1, 2 * ALOFT);
  /** @type {number | null} */
  #frozen = null;
  #seconds = 0;
  #last = 0;
  /** Whether waves move. */
  #waving = !STILL.matches;
  size = { width: 1, height: 1 };

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import('./relief.js').Surface} surface
   * @param {{picture: import('three').Texture | null, sea: (sun: Vector3) => import('./sea.js').Sea,
   *   stand: import('./presets.js').Fixed, lit: View}} parts the view in which the sun glitters on the water
   */
  constructor(canvas, surface, { picture, sea, stand, lit }) {
    super();
    this.canvas = canvas;
    this.surface = surface;
    this.#stand = stand;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    /** @type {PerspectiveCamera | OrthographicCamera} */
    this.camera = this.#perspective;
    this.scene = new Scene();
    const { x, y, z } = sunOver(lit, stand);
    const sun = new Vector3(x, y, z);
    this.#sky = new Mesh(
      new SphereGeometry(SKY, 32, 24),
      new MeshBasicMaterial({ map: skyTexture(sun), side: BackSide, depthWrite: false }),
    );
    this.#sky.renderOrder = -2;
    const light = new DirectionalLight(0xfff1d8, 2.5);
    light.position.copy(sun).multiplyScalar(100);
    this.scene.add(this.#sky, light, new HemisphereLight(0xd6e6f5, 0xb09a78, 1.35));
    this.land = new Land(surface, picture);
    this.sea = sea(sun);
    this.tray = new Tray(surface.places);
    this.scene.add(this.land.group, this.tray.group, this.sea.group);
    sharpen(this.scene, mostSamples(this.renderer));
    this.controls = this.#control(canvas);
    this.#settle();
    this.#watch();
  }

  /** @param {HTMLCanvasElement} canvas */
  #control(canvas) {
    const controls = new OrbitControls(this.camera, canvas);
    controls.enableDamping = !STILL.matches;
    controls.dampingFactor = 0.09;
    controls.maxPolarAngle = Math.PI * 0.497;
    controls.minDistance = 1;
    controls.maxDistance = MOST_DISTANCE;
    controls.zoomToCursor = true;
    controls.addEventListener('start', () => {
      this.#flight = null;
      this.requestFrame();
    });
    controls.addEventListener('change', () => this.requestFrame());
    return controls;
  }

  #watch() {
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.dispatchEvent(new Event('lost'));
    });
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.dispatchEvent(new Event('restored'));
      this.requestFrame();
    });
    document.addEventListener('visibilitychange', () => this.requestFrame());
    new ResizeObserver(() => this.resize()).observe(/** @type {Element} */ (this.canvas.parentElement));
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = /** @type {Element} */ (this.canvas.parentElement);
    if (width === 0 || height === 0) return;
    Object.assign(this.canvas.style, { width: '100%', height: '100%' });
    this.#shape(width, height, Math.min(devicePixelRatio, MOST_RATIO));
  }

  /** Give the cameras the shape of the picture, and render. */
  #frame() {
    const { width, height } = this.size;
    this.#perspective.aspect = width / height;
    const { left = 0, top = 0, right = 0, bottom = 0 } = this.inset();
    for (const camera of [this.#perspective, this.#plan]) {
      camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    }
    this.#spread();
    this.render();
  }

  /**
   * Render at another size, with nothing before it, act, and render as before.
   *
   * @param {[number, number]} size in pixels
   * @param {() => void} act
   */
  renderedAt([width, height], act) {
    const [before, inset] = [{ ...this.size }, this.inset];
    const ratio = this.renderer.getPixelRatio();
    this.inset = () => ({});
    this.#shape(width, height, 1);
    act();
    this.inset = inset;
    this.#shape(before.width, before.height, ratio);
  }

  /** @param {number} width @param {number} height @param {number} ratio of pixels to those of the page */
  #shape(width, height, ratio) {
    this.size = { width, height };
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.#frame();
  }

  /** Let the plan show the box. */
  #spread() {
    const { width, height } = this.size;
    const half = planHeight(this.#dimensions());
    const sides = { left: (-half * width) / height, right: (half * width) / height, top: half, bottom: -half };
    Object.assign(this.#plan, sides).updateProjectionMatrix();
  }

  /** Look through one of the two cameras. @param {boolean} isPlan */
  #look(isPlan) {
    const camera = isPlan ? this.#plan : this.#perspective;
    if (this.camera === camera) return;
    this.camera = this.controls.object = camera;
    const { controls } = this;
    controls.enableRotate = !isPlan;
    controls.mouseButtons.LEFT = isPlan ? MOUSE.PAN : MOUSE.ROTATE; // a plan is moved, not turned
    controls.touches.ONE = isPlan ? TOUCH.PAN : TOUCH.ROTATE;
    if (isPlan) {
      this.#plan.position.set(0, ALOFT, 0);
      this.#plan.up.set(0, 0, -1);
      this.#plan.zoom = 1;
      this.controls.target.set(0, 0, 0);
      this.#plan.lookAt(0, 0, 0);
      this.#spread();
    }
  }

  /** Pixels at the borders that something stands over: the middle of the picture is between. */
  inset = () => /** @type {{left?: number, top?: number, right?: number, bottom?: number}} */ ({});

  /** Follow the surface's exaggeration. */
  #settle() {
    this.land.raise();
    this.sea.raise();
    this.tray.group.position.y = this.land.floor;
  }

  /** Set the vertical exaggeration. @param {number} times */
  relief(times) {
    this.surface.exaggeration = times;
    this.#settle();
    this.dispatchEvent(new Event('relief'));
    this.requestFrame();
  }

  /** @returns {import('./presets.js').Stand} */
  #dimensions() {
    const { width, height } = this.size;
    const { left = 0, top = 0, right = 0, bottom = 0 } = this.inset();
    const free = Math.max(height - top - bottom, 1);
    const low = this.land.floor - Tray.down;
    const high = this.surface.range.high * this.surface.rise;
    const aspect = Math.max(width - left - right, 1) / free;
    return { ...this.#stand, low, high, aspect, share: free / height };
  }

  /** @param {View} view */
  pose(view) {
    return pose(view, this.#dimensions());
  }

  /** @param {View} view @param {{fly?: boolean}} [how] */
  view(view, { fly = true } = {}) {
    const end = this.pose(view);
    const isPlan = view.kind === 'plan';
    if (this.camera === this.#plan) {
      if (isPlan) fly = false;
      this.#look(false);
      this.#place(this.pose({ ...view, kind: 'plan' }));
    }
    this.controls.enableDamping = false; // leftover inertia would change the view
    this.controls.update();
    this.controls.enableDamping = !STILL.matches;
    if (fly && !STILL.matches) {
      const start = { from: { ...this.camera.position }, to: { ...this.controls.target } };
      this.#flight = { start, end, begin: performance.now(), isPlan };
      return this.requestFrame();
    }
    this.#flight = null;
    this.#place(end);
    this.#look(isPlan);
    this.render();
  }

  /** Stand somewhere and look somewhere, in the world. @param {number[]} numbers position and target of the camera */
  stand([x, y, z, toX, toY, toZ]) {
    this.#flight = null;
    this.#look(false);
    this.#place({ from: { x, y, z }, to: { x: toX, y: toY, z: toZ } });
  }

  /** What is in the middle of a plan, x and z, and how much larger it is; null in perspective. */
  get plan() {
    const { x, z } = this.controls.target;
    return this.camera === this.#plan ? [x, z, this.#plan.zoom] : null;
  }

  /** Look straight down, as `plan` says. @param {number[]} numbers */
  standAbove([x, z, zoom]) {
    this.#flight = null;
    this.#look(true);
    this.#plan.position.set(x, ALOFT, z);
    this.controls.target.set(x, 0, z);
    this.#plan.zoom = zoom;
    this.#plan.updateProjectionMatrix();
  }

  /** @param {Pose} pose */
  #place({ from, to }) {
    this.camera.position.set(from.x, from.y, from.z);
    this.controls.target.set(to.x, to.y, to.z);
    this.camera.lookAt(this.controls.target);
  }

  /** Keep the camera within its limits. */
  #move() {
    const flight = this.#flight;
    if (flight) {
      const share = (performance.now() - flight.begin) / FLIGHT;
      this.#place(between(flight.start, flight.end, share));
      if (share >= 1) {
        this.#flight = null;
        this.#look(flight.isPlan);
      }
    } else this.controls.update();
    if (this.camera === this.#perspective) this.#clear();
    this.camera.updateMatrixWorld();
  }

  /** Keep the camera off the ground, and its nearest plane as far away as it can be. */
  #clear() {
    const { position, near } = this.#perspective;
    const { width, depth } = this.surface.places;
    const isOver = Math.abs(position.x) <= width / 2 + 3 && Math.abs(position.z) <= depth / 2 + 3;
    const below = isOver ? this.surface.height(position.x, position.z) : this.land.floor;
    if (position.y < below + CLEARANCE) position.y = below + CLEARANCE;
    const wanted = Math.min(Math.max((position.y - below) / 6, 0.04), 4);
    if (Math.abs(wanted / near - 1) > 0.01) {
      this.#perspective.near = wanted;
      this.#perspective.updateProjectionMatrix();
    }
  }

  /** Stop or start the waves. @param {boolean} moving */
  set waving(moving) {
    this.#waving = moving;
    this.#last = 0;
    this.requestFrame();
  }

  get waving() {
    return this.#waving;
  }

  /** Stop the clock of waves and folds at a time, or with null let it run. @param {number | null} seconds */
  freeze(seconds) {
    this.#frozen = seconds;
    this.#last = 0;
    this.render();
  }

  /** Time of waves and folds, in seconds. */
  get seconds() {
    return this.#frozen ?? this.#seconds;
  }

  /** Draw the water in one colour and all else in another. @param {boolean} wanted */
  flat(wanted) {
    this.#isFlat = wanted;
    this.scene.background = wanted ? this.#background : null;
    this.#sky.visible = this.tray.group.visible = !wanted;
    this.land.flat = wanted;
    this.sea.flat = wanted ? new Color(FLAT.water) : null;
    this.render();
  }

  get isFlat() {
    return this.#isFlat;
  }

  requestFrame() {
    if (this.#wanted || document.hidden) return;
    this.#wanted = true;
    requestAnimationFrame((now) => {
      this.#wanted = false;
      if (document.hidden) {
        this.#last = 0;
        return;
      }
      const isRunning = this.#waving && this.#frozen === null;
      if (isRunning && this.#last > 0) this.#seconds += Math.min((now - this.#last) / 1000, 0.25);
      this.#last = isRunning ? now : 0;
      this.render();
      if (isRunning || this.#flight) this.requestFrame();
    });
  }

  render() {
    this.#move();
    if (this.sea.advance()) this.requestFrame();
    this.sea.mirrorAt(...this.surface.places.toBox(this.controls.target.x, this.controls.target.z));
    this.sea.time = this.seconds;
    this.renderer.render(this.scene, this.camera);
    this.dispatchEvent(new Event('frame'));
  }
}
