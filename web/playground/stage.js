// The stage: the drawing on a turning mug, on a floor that runs away, and under a magnifier; left of the split as a PNG.
import {
  CircleGeometry, Color, CylinderGeometry, DirectionalLight, DoubleSide, Group, HemisphereLight, LinearFilter,
  LinearMipmapLinearFilter, Mesh, MeshBasicMaterial, MeshStandardMaterial, OrthographicCamera, PerspectiveCamera, PlaneGeometry,
  RepeatWrapping, SRGBColorSpace, Scene, CanvasTexture, TorusGeometry, WebGLRenderer,
} from 'three';
import { applyVectorMask } from '../src/index.js';

/** @import { Material, Object3D } from 'three' */
/** @import { VectorTexture } from '../src/index.js' */

/** Papers under the drawing: a dark one for drawings that are light. */
const PAPERS = { light: '#ffffff', dark: '#1c2733' };

const FLOOR_REPEATS = 12;
const MOST_ZOOM = 1e5;
const FIRST_ZOOM = 14;

/** Part of the mug's circumference and height that the drawing takes. */
const DECAL = { angle: 1.7, height: 1.64 };

/** @typedef {{ left: number, top: number, width: number, height: number }} Area in CSS pixels */

export class Stage {
  /** Share of each view that shows the PNG. */
  split = 0.5;
  /** The magnifier: its middle in the unit square, and how many times the drawing is enlarged. */
  magnifier = { x: 0.5, y: 0.5, zoom: 1 };

  #canvas;
  #renderer;
  #asked = 0;
  #views;
  /** @type {Mesh[]} */
  #drawn = [];
  /** @type {{ png: Material[], vector: Material[] } | null} */
  #materials = null;
  #glaze = new MeshStandardMaterial({ roughness: 0.35, side: DoubleSide });
  #isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true });
    this.#renderer.autoClear = false;
    this.#renderer.setClearColor('#d1402f');
    this.#views = [this.#makeMagnifier(), this.#makeMug(), this.#makeFloor()];
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /**
   * Show a drawing.
   *
   * @param {VectorTexture} texture
   * @param {HTMLCanvasElement} picture the PNG's pixels
   * @param {'light' | 'dark'} paper
   * @param {{ x: number, y: number }} subject point on an outline
   */
  show(texture, picture, paper, subject) {
    const before = this.#materials;
    const map = this.#asTexture(picture, PAPERS[paper]);
    const color = new Color(PAPERS[paper]);
    const plain = { color, side: DoubleSide };
    const lit = { ...plain, roughness: 0.35 };
    const png = [
      new MeshBasicMaterial({ map: magnified(map) }),
      new MeshStandardMaterial({ ...lit, map, color: 0xffffff }),
      new MeshBasicMaterial({ map: repeated(map) }),
    ];
    this.#glaze.color.set(color);
    const vector = [new MeshBasicMaterial(plain), new MeshStandardMaterial(lit), new MeshBasicMaterial(plain)];
    vector.forEach((material, k) => {
      const mask = applyVectorMask(material, texture, { mode: 'paint', linear: false, wrap: k === 2 ? 'repeat' : 'none' });
      if (k === 2) mask.transform.setUvTransform(0, 0, FLOOR_REPEATS, FLOOR_REPEATS, 0, 0, 0);
    });
    this.#materials = { png, vector };
    this.magnifier = { ...subject, zoom: FIRST_ZOOM };
    for (const material of before ? [...before.png, ...before.vector] : []) {
      /** @type {MeshBasicMaterial} */ (material).map?.dispose();
      material.dispose();
    }
    this.draw();
  }

  /** Draw a frame soon; the mug turns on. */
  draw() {
    this.#asked ||= requestAnimationFrame((time) => {
      this.#asked = 0;
      this.#frame(time);
      if (this.#materials && !this.#isStill && document.visibilityState === 'visible') this.draw();
    });
  }

  /** @param {number} time in ms */
  #frame(time) {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (!width || !height || !this.#materials) return;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.#renderer.setScissorTest(true);
    areasOf(width, height).forEach((area, k) => {
      const { scene, camera, fit } = this.#views[k];
      fit(area, time);
      this.#renderer.setViewport(area.left, height - area.top - area.height, area.width, area.height);
      const middle = Math.round(area.width * this.split);
      this.#half(scene, camera, 'png', { ...area, width: middle }, height);
      this.#half(scene, camera, 'vector', { ...area, left: area.left + middle, width: area.width - middle }, height);
      if (middle <= 0 || middle >= area.width) return;
      this.#renderer.setScissor(area.left + middle - 1, height - area.top - area.height, 2, area.height);
      this.#renderer.clear();
    });
  }

  /**
   * @param {Scene} scene
   * @param {PerspectiveCamera | OrthographicCamera} camera
   * @param {'png' | 'vector'} kind
   * @param {Area} area
   * @param {number} height of the canvas
   */
  #half(scene, camera, kind, { left, top, width, height: own }, height) {
    if (width <= 0) return;
    this.#drawn.forEach((mesh, k) => (mesh.material = /** @type {any} */ (this.#materials)[kind][k]));
    this.#renderer.setScissor(left, height - top - own, width, own);
    this.#renderer.clear();
    this.#renderer.render(scene, camera);
  }

  /**
   * Area of the magnifier, for its gestures.
   *
   * @returns {Area}
   */
  get lens() {
    return areasOf(this.#canvas.clientWidth, this.#canvas.clientHeight)[0];
  }

  /**
   * Zoom the magnifier at a point of it.
   *
   * @param {number} factor
   * @param {{ x: number, y: number }} [point] in CSS pixels of the canvas; its middle by default
   */
  zoom(factor, point) {
    const { left, top, width, height } = this.lens;
    const before = this.magnifier.zoom;
    const after = Math.min(Math.max(before * factor, 0.5), MOST_ZOOM);
    const side = Math.min(width, height);
    const dx = point ? (point.x - left - width / 2) / side : 0;
    const dy = point ? (point.y - top - height / 2) / side : 0;
    this.magnifier.x += dx / before - dx / after;
    this.magnifier.y -= dy / before - dy / after;
    this.magnifier.zoom = after;
    this.draw();
  }

  /** @param {number} dx @param {number} dy in CSS pixels */
  move(dx, dy) {
    const side = Math.min(this.lens.width, this.lens.height) * this.magnifier.zoom;
    this.magnifier.x -= dx / side;
    this.magnifier.y += dy / side;
    this.draw();
  }

  #makeMagnifier() {
    const scene = sceneOf('#cfd6da');
    const camera = new OrthographicCamera();
    scene.add(this.#mesh(new PlaneGeometry(1, 1)));
    const fit = (/** @type {Area} */ { width, height }) => {
      const { x, y, zoom } = this.magnifier;
      const unit = 0.5 / (Math.min(width, height) * zoom);
      Object.assign(camera, { left: -width * unit, right: width * unit, bottom: -height * unit, top: height * unit });
      camera.position.set(x - 0.5, y - 0.5, 1);
      camera.updateProjectionMatrix();
    };
    return { scene, camera, fit };
  }

  #makeMug() {
    const scene = sceneOf('#e9e2d3');
    const camera = new PerspectiveCamera(30);
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(2, 4, 5);
    scene.add(new HemisphereLight(0xffffff, 0xb8a888, 1.8), sun);
    const start = -DECAL.angle / 2;
    const decal = this.#mesh(new CylinderGeometry(1.002, 1.002, DECAL.height, 64, 1, true, start, DECAL.angle));
    const parts = [
      new CylinderGeometry(1, 1, 2, 96, 1, true),
      new CircleGeometry(1, 96).rotateX(Math.PI / 2).translate(0, -0.99, 0),
      new TorusGeometry(0.55, 0.13, 24, 64, Math.PI).rotateZ(-Math.PI / 2).translate(0.98, 0, 0).rotateY(Math.PI * 0.62),
    ];
    const mug = new Group().add(decal, ...parts.map((geometry) => new Mesh(geometry, this.#glaze)));
    scene.add(mug);
    const fit = (/** @type {Area} */ { width, height }, /** @type {number} */ time) => {
      camera.aspect = width / height;
      camera.position.set(0, 1.4, 5.2 * Math.max(1, 1 / camera.aspect));
      camera.lookAt(0, 0, 0);
      camera.updateProjectionMatrix();
      mug.rotation.y = this.#isStill ? -0.35 : 0.7 * Math.sin(time / 4000);
    };
    return { scene, camera, fit };
  }

  #makeFloor() {
    const scene = sceneOf('#b9c4c9');
    const camera = new PerspectiveCamera(40);
    scene.add(this.#mesh(new PlaneGeometry(FLOOR_REPEATS, FLOOR_REPEATS).rotateX(-Math.PI / 2)));
    const fit = (/** @type {Area} */ { width, height }) => {
      camera.aspect = width / height;
      camera.position.set(0.5, 0.42, FLOOR_REPEATS / 2 - 0.3);
      camera.lookAt(0.2, 0, FLOOR_REPEATS / 2 - 3);
      camera.updateProjectionMatrix();
    };
    return { scene, camera, fit };
  }

  /** @param {import('three').BufferGeometry} geometry */
  #mesh(geometry) {
    const mesh = new Mesh(geometry);
    this.#drawn.push(mesh);
    return mesh;
  }

  /**
   * The PNG on its paper, filtered as well as the graphics card can.
   *
   * @param {HTMLCanvasElement} picture
   * @param {string} paper
   */
  #asTexture(picture, paper) {
    const canvas = Object.assign(document.createElement('canvas'), { width: picture.width, height: picture.height });
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.fillStyle = paper;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(picture, 0, 0);
    const texture = new CanvasTexture(canvas);
    Object.assign(texture, {
      colorSpace: SRGBColorSpace, minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter,
      anisotropy: this.#renderer.capabilities.getMaxAnisotropy(),
    });
    return texture;
  }
}

/** @param {CanvasTexture} map @returns {import('three').Texture} without the anisotropic filter, which distorts what is enlarged on some drivers */
function magnified(map) {
  const texture = map.clone();
  texture.anisotropy = 1;
  return texture;
}

/** @param {CanvasTexture} map */
function repeated(map) {
  const texture = map.clone();
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.repeat.set(FLOOR_REPEATS, FLOOR_REPEATS);
  return texture;
}

/** @param {string} background */
function sceneOf(background) {
  const scene = new Scene();
  scene.background = new Color(background);
  return scene;
}

/**
 * Areas of the magnifier, the mug and the floor.
 *
 * @param {number} width
 * @param {number} height
 * @returns {Area[]}
 */
export function areasOf(width, height) {
  const gap = 4;
  if (width > height) {
    const side = Math.round(width * 0.56);
    const half = Math.round((height - gap) / 2);
    const right = { left: side + gap, width: width - side - gap };
    return [
      { left: 0, top: 0, width: side, height },
      { ...right, top: 0, height: half },
      { ...right, top: half + gap, height: height - half - gap },
    ];
  }
  const upper = Math.round(height * 0.5);
  const half = Math.round((width - gap) / 2);
  const lower = { top: upper + gap, height: height - upper - gap };
  return [
    { left: 0, top: 0, width, height: upper },
    { ...lower, left: 0, width: half },
    { ...lower, left: half + gap, width: width - half - gap },
  ];
}
