/** The rendered scene, its camera and its frames. */
import {
  BackSide, Color, DirectionalLight, HemisphereLight, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene,
  SphereGeometry, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { skyTexture } from './canvas-textures.js';
import { Land } from './land.js';
import { FIELD, between, pose, sunOver } from './presets.js';
import { mostSamples, sharpen } from './sharpness.js';
import { Tray } from './tray.js';

/** @typedef {import('./presets.js').Preset} Preset @typedef {import('./presets.js').Pose} Pose */

const MOST_RATIO = 2;
const FLIGHT = 2600; // ms
const SKY = 900;
/** Least height of the camera above the surface, in world units. */
const CLEARANCE = 0.25;
const MOST_DISTANCE = 420;
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
  /** @type {{start: Pose, end: Pose, begin: number} | null} */
  #flight = null;
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
   *   stand: import('./presets.js').Fixed}} parts
   */
  constructor(canvas, surface, { picture, sea, stand }) {
    super();
    this.canvas = canvas;
    this.surface = surface;
    this.#stand = stand;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.camera = new PerspectiveCamera(FIELD, 1, 0.05, 2 * SKY);
    this.scene = new Scene();
    const { x, y, z } = sunOver(stand);
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
    this.size = { width, height };
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, MOST_RATIO));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    const { left = 0, top = 0, right = 0, bottom = 0 } = this.inset();
    this.camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    this.render();
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

  /** @param {Preset} preset */
  pose(preset) {
    const { width, height } = this.size;
    const { left = 0, top = 0, right = 0, bottom = 0 } = this.inset();
    const free = Math.max(height - top - bottom, 1);
    const low = this.land.floor - Tray.down;
    const high = this.surface.relief.highest * this.surface.rise;
    const aspect = Math.max(width - left - right, 1) / free;
    return pose(preset, { ...this.#stand, low, high, aspect, share: free / height });
  }

  /** @param {Preset} preset @param {{fly?: boolean}} [how] */
  view(preset, { fly = true } = {}) {
    const end = this.pose(preset);
    this.controls.enableDamping = false; // leftover inertia would change the view
    this.controls.update();
    this.controls.enableDamping = !STILL.matches;
    if (fly && !STILL.matches) {
      const start = { from: { ...this.camera.position }, to: { ...this.controls.target } };
      this.#flight = { start, end, begin: performance.now() };
      return this.requestFrame();
    }
    this.#flight = null;
    this.#place(end);
    this.render();
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
      if (share >= 1) this.#flight = null;
    } else this.controls.update();
    const { position, near } = this.camera;
    const { width, depth } = this.surface.places;
    const isOver = Math.abs(position.x) <= width / 2 + 3 && Math.abs(position.z) <= depth / 2 + 3;
    const below = isOver ? this.surface.height(position.x, position.z) : this.land.floor;
    if (position.y < below + CLEARANCE) position.y = below + CLEARANCE;
    const wanted = Math.min(Math.max((position.y - below) / 6, 0.04), 4);
    if (Math.abs(wanted / near - 1) > 0.01) {
      this.camera.near = wanted;
      this.camera.updateProjectionMatrix();
    }
    this.camera.updateMatrixWorld();
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
    this.sea.time = this.seconds;
    this.renderer.render(this.scene, this.camera);
    this.dispatchEvent(new Event('frame'));
  }
}
