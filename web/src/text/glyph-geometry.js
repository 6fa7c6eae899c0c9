// The geometry of glyphs: one instance for each.
import { Box3, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, IntType, BufferAttribute, Sphere, Vector3 } from 'three';
import { GLYPH } from '../glyph-shader.js';

/**
 * @typedef {object} Glyphs Where glyphs are.
 * @property {Uint32Array} shapes of each the index of its shape
 * @property {Float32Array} places left, bottom and side of the unit square of its shape
 *
 * @typedef {[number, number, number, number]} Rectangle left, bottom, right and top
 *
 * @typedef {object} Arrangement What else there is to say about glyphs.
 * @property {(shape: number) => [number, number]} boxOf part of its unit square that a shape fills
 * @property {Rectangle | null} clip what is outside is not shown
 * @property {Float32Array | null} colors red, green and blue of each glyph, linear
 * @property {((x: number, y: number) => Frame) | null} bend puts glyphs elsewhere
 * @property {number} z
 *
 * @typedef {object} Frame A place, and a rotation as a quaternion.
 * @property {[number, number, number]} position
 * @property {[number, number, number, number]} rotation
 */

/** Number of glyphs for which there is room at first. */
const ROOM = 16;

/** Ranges that are sent one by one; more are sent as one. */
const MOST_RANGES = 32;

/** Corners of the unit square. */
const CORNERS = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]);

const NORMALS = new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]);

const UVS = new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]);

/** Items of each attribute. */
const SIZES = Object.freeze({ [GLYPH.root]: 1, [GLYPH.place]: 4, [GLYPH.box]: 4, [GLYPH.turn]: 4 });

/** One rectangle for each glyph. */
export class GlyphGeometry extends InstancedBufferGeometry {
  #room = 0;
  /** Whether glyphs are not in one plane. */
  isBent = false;

  /** @param {Record<string, number>} [more] further attributes, and the items of each */
  constructor(more = {}) {
    super();
    this.more = more;
    this.setIndex([0, 1, 2, 2, 1, 3]);
    this.setAttribute('position', new BufferAttribute(CORNERS, 3));
    this.setAttribute('normal', new BufferAttribute(NORMALS, 3));
    this.setAttribute('uv', new BufferAttribute(UVS, 2));
    this.boundingBox = new Box3();
    this.boundingSphere = new Sphere(new Vector3(), -1);
    this.makeRoom(ROOM, false);
    this.instanceCount = 0;
  }

  /** Its bounds are those of the glyphs, which it is told. */
  computeBoundingBox() {}

  computeBoundingSphere() {}

  /**
   * Show other glyphs.
   *
   * @param {Glyphs} glyphs
   * @param {Arrangement} arrangement
   */
  setGlyphs(glyphs, arrangement) {
    this.makeRoom(glyphs.shapes.length, arrangement.colors !== null);
    this.isBent = arrangement.bend !== null;
    const bounds = /** @type {Box3} */ (this.boundingBox).makeEmpty();
    this.instanceCount = this.write(0, glyphs, arrangement, bounds);
    for (const name of [...Object.keys(SIZES), 'color']) {
      /** @type {InstancedBufferAttribute | undefined} */ (this.attributes[name])?.clearUpdateRanges?.();
      this.send(name, 0, this.instanceCount);
    }
    bounds.getBoundingSphere(/** @type {Sphere} */ (this.boundingSphere));
  }

  /**
   * Write glyphs to the attributes.
   *
   * @protected
   * @param {number} first place of the first
   * @param {Glyphs} glyphs
   * @param {Arrangement} arrangement
   * @param {Box3} bounds are widened by those of the glyphs
   * @returns {number} how many there are, without those that are clipped
   */
  write(first, { shapes, places }, { boxOf, clip, colors, bend, z }, bounds) {
    const [roots, at, boxes, turns] = Object.keys(SIZES).map((name) => this.arrayOf(name));
    const tint = colors && this.arrayOf('color');
    let end = first;
    for (let k = 0; k < shapes.length; k++) {
      const left = places[3 * k], bottom = places[3 * k + 1], side = places[3 * k + 2];
      const [width, height] = boxOf(shapes[k]);
      const box = clip ? clipped(left, bottom, side, [0, 0, width, height], clip) : [0, 0, width, height];
      if (!box) continue;
      const x = left + 0.5 * width * side;
      const frame = bend?.(x, bottom);
      roots[end] = shapes[k];
      at.set(frame ? moved(frame, left - x, 0) : [left, bottom, z], 4 * end);
      at[4 * end + 3] = side;
      boxes.set(box, 4 * end);
      turns.set(frame ? frame.rotation : [0, 0, 0, 1], 4 * end);
      if (tint) tint.set(/** @type {Float32Array} */ (colors).subarray(3 * k, 3 * k + 3), 3 * end);
      widen(bounds, at, end, side * Math.max(width, height), frame !== undefined, side * width, side * height);
      end++;
    }
    return end - first;
  }

  /**
   * Send values of glyphs to the GPU.
   *
   * @protected
   * @param {string} name of an attribute
   * @param {number} first
   * @param {number} count of glyphs
   */
  send(name, first, count) {
    const attribute = /** @type {InstancedBufferAttribute | undefined} */ (this.attributes[name]);
    if (!attribute) return;
    const { itemSize } = attribute;
    if ((attribute.updateRanges?.length ?? 0) < MOST_RANGES) attribute.addUpdateRange?.(first * itemSize, count * itemSize);
    else {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, this.#room * itemSize);
    }
    attribute.needsUpdate = true;
  }

  /** @protected @param {string} name of an attribute @returns {Float32Array | Uint32Array} */
  arrayOf(name) {
    return /** @type {any} */ (this.attributes[name].array);
  }

  /** Number of glyphs for which there is room. */
  get room() {
    return this.#room;
  }

  /**
   * @protected
   * @param {number} count of glyphs
   * @param {boolean} isColored
   */
  makeRoom(count, isColored) {
    if (count > this.#room) {
      this.#room = Math.max(count, 2 * this.#room, ROOM);
      this.dispose(); // three.js gives the buffers of attributes back with their geometry
      this.deleteAttribute('color');
      for (const [name, size] of Object.entries({ ...SIZES, ...this.more })) this.#allocate(name, size);
    }
    if (isColored && !this.attributes.color) this.#allocate('color', 3);
    if (!isColored && this.attributes.color) this.deleteAttribute('color');
  }

  /** @param {string} name @param {number} size */
  #allocate(name, size) {
    const isWhole = name === GLYPH.root || name === GLYPH.label;
    const values = isWhole ? new Uint32Array(this.#room) : new Float32Array(size * this.#room);
    const attribute = new InstancedBufferAttribute(values, size).setUsage(DynamicDrawUsage);
    if (isWhole) attribute.gpuType = IntType;
    const before = /** @type {any} */ (this.attributes[name])?.array;
    if (before) values.set(before);
    this.setAttribute(name, attribute);
  }
}

/**
 * The part of a box of the unit square of a glyph that is in a rectangle, as `GLYPH.box` has it; null if none is.
 *
 * @param {number} left
 * @param {number} bottom
 * @param {number} side
 * @param {Rectangle} box
 * @param {Rectangle} clip
 * @returns {Rectangle | null}
 */
function clipped(left, bottom, side, [x0, y0, x1, y1], [a, b, c, d]) {
  /** @type {Rectangle} */
  const part = [
    Math.max(x0, (a - left) / side), Math.max(y0, (b - bottom) / side),
    Math.min(x1, (c - left) / side), Math.min(y1, (d - bottom) / side),
  ];
  if (part[0] >= part[2] || part[1] >= part[3]) return null;
  if (part[2] < x1) part[2] *= -1; // see `GLYPH.box`
  if (part[3] < y1) part[3] *= -1;
  return part;
}

/** A point of a frame. @param {Frame} frame @param {number} x @param {number} y */
function moved({ position, rotation }, x, y) {
  const at = new Vector3(x, y, 0).applyQuaternion(/** @type {any} */ ({ x: rotation[0], y: rotation[1], z: rotation[2], w: rotation[3] }));
  return [position[0] + at.x, position[1] + at.y, position[2] + at.z];
}

const POINT = new Vector3();

/**
 * @param {Box3} bounds
 * @param {Float32Array | Uint32Array} at
 * @param {number} glyph
 * @param {number} reach longest side of the glyph
 * @param {boolean} isTurned
 * @param {number} width
 * @param {number} height
 */
function widen(bounds, at, glyph, reach, isTurned, width, height) {
  const [x, y, z] = at.subarray(4 * glyph, 4 * glyph + 3);
  if (isTurned) {
    bounds.expandByPoint(POINT.set(x - 1.5 * reach, y - 1.5 * reach, z - 1.5 * reach));
    bounds.expandByPoint(POINT.set(x + 1.5 * reach, y + 1.5 * reach, z + 1.5 * reach));
  } else {
    bounds.expandByPoint(POINT.set(x, y, z));
    bounds.expandByPoint(POINT.set(x + width, y + height, z));
  }
}
