/** The wooden box around the ground, and its shadow. */
import { BoxGeometry, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, PlaneGeometry } from 'three';
import { shadowTexture, woodTexture } from './canvas-textures.js';

const THICK = 2.2;
/** Extent of the planks above and below the lower border of the ground. */
const UP = 2.2;
const DOWN = 2.6;
const FLOOR = 1.2;
/** Length of the wood texture in world units. */
const PLANK = 60;

/**
 * A plank whose grain runs along its longest side.
 *
 * @param {number} x @param {number} y @param {number} z sizes
 */
function plank(x, y, z) {
  const geometry = new BoxGeometry(x, y, z);
  const { position, normal, uv } = geometry.attributes;
  for (let at = 0; at < position.count; at++) {
    const [px, py, pz] = [position.getX(at), position.getY(at), position.getZ(at)];
    const [along, across] = x > z ? [px, pz] : [pz, px];
    const end = Math.abs(x > z ? normal.getX(at) : normal.getZ(at)) > 0.5;
    const up = Math.abs(normal.getY(at)) > 0.5;
    uv.setXY(at, end ? across / PLANK : along / PLANK, (up ? across : py) / (UP + DOWN));
  }
  return geometry;
}

export class Tray {
  /** @param {import('./place.js').Places} places */
  constructor({ width, depth }) {
    const map = woodTexture();
    const wood = new MeshLambertMaterial({ map });
    const darker = new MeshLambertMaterial({ map, color: 0xd9cfc4 });
    this.group = new Group();
    /** @typedef {[number, number, number]} Triple */
    const add = (/** @type {Triple} */ size, /** @type {Triple} */ at, material = wood) => {
      const mesh = new Mesh(plank(...size), material);
      mesh.position.set(...at);
      this.group.add(mesh);
    };
    const middle = (UP - DOWN) / 2;
    for (const side of [-1, 1]) {
      add([width + 2 * THICK, UP + DOWN, THICK], [0, middle, (side * (depth + THICK)) / 2]);
      add([THICK, UP + DOWN, depth], [(side * (width + THICK)) / 2, middle, 0], darker);
    }
    add([width + 5 * THICK, FLOOR, depth + 5 * THICK], [0, -DOWN - FLOOR / 2, 0], darker);
    const shadow = new Mesh(
      new PlaneGeometry(3 * (width + 6), 3 * (depth + 6)),
      new MeshBasicMaterial({ map: shadowTexture(), transparent: true, depthWrite: false }),
    );
    shadow.rotation.x = -Math.PI / 2;
    shadow.position.y = -DOWN - FLOOR - 0.05;
    shadow.renderOrder = -1;
    this.group.add(shadow);
  }

  /** Margin around the ground on each side. */
  static get around() {
    return 2.5 * THICK;
  }

  /** Height of its lower end. */
  static get down() {
    return DOWN + FLOOR;
  }
}
